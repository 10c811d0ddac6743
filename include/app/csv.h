// Csv: the file of /O, to which every run appends its statistics as one record.
#ifndef FB_CSV_H
#define FB_CSV_H

#include "app/options.h"
#include "app/stats.h"

class Csv {
public:
    // Finds out before a run whether its record can be kept: the file is a file of records, or can be made. It leaves
    // no file that was not there. Null, or one line that says why not; `*status` is then the exit status.
    const char* check(const char* name, int* status);

    // Appends the record of a run, with a line of names when the file is new. A record that does not fit is taken back.
    // Null, or one line that says why not.
    const char* append(const Options& options, Real spacing, const Stats& stats);

private:
    const char* complain(const char* why);

    const char* name_ = nullptr;
    char problem_[300];
};

#endif
