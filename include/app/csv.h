// Csv: the file named by /O, to which every run appends its statistics as one record.
#ifndef FB_CSV_H
#define FB_CSV_H

#include "app/options.h"
#include "app/stats.h"

class Csv {
public:
    // Checks before a run that its record can be stored: either the file is a file of records, or it can be created. A
    // file created for this test is removed again. Returns null, or one line that says what is wrong; `*status` is then
    // the exit status.
    const char* check(const char* name, int* status);

    // Appends the record of a run, preceded by the line of field names when the file is new. A record that does not fit on
    // the disk is removed again. Returns null, or one line that says what is wrong.
    const char* append(const Options& options, Real spacing, const Stats& stats);

private:
    const char* complain(const char* why);

    const char* name_ = nullptr;
    char problem_[300];
};

#endif
