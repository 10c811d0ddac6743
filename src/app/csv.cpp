// A file of records: one run per line, fields separated by commas.
#include "app/csv.h"

#include "machine.h"
#include "math/text.h"
#include "rt.h"

namespace {

constexpr int RECORD_ROOM = 1400;

// Tells whether a file is empty or begins with our line of field names. Returns false for a file that cannot be read.
bool isOurs(const char* name)
{
    char header[RECORD_ROOM], there[RECORD_ROOM];
    Stats::formatHeader(header, sizeof header);
    const uint32_t length = static_cast<uint32_t>(strlen(header));
    const int file = machine::openFile(name);
    if (file < 0)
        return false;
    const int32_t got = machine::readFile(file, there, length);
    machine::closeFile(file);
    return got == 0 || (got == static_cast<int32_t>(length) && memcmp(there, header, length) == 0);
}

bool write(int file, const char* text)
{
    return machine::writeFile(file, text, static_cast<uint32_t>(strlen(text))) >= 0;
}

bool writeHeader(int file)
{
    char text[RECORD_ROOM];
    Stats::formatHeader(text, sizeof text);
    return write(file, text);
}

// Writes the switches that influence the statistics of a run, but for /R.
void formatSettings(char* to, size_t size, const Options& options, Real spacing)
{
    char number[24], held[16] = "";
    formatReal(number, sizeof number, spacing);
    if (options.holds())
        snprintf(held, sizeof held, " F:%d", static_cast<int>(options.hold));
    snprintf(to, size, "S:%s%s%s%s%s%s%s", number, held, options.interactive ? " I" : "", options.grey ? " G" : "",
             options.report98 ? " P" : "", options.retrace ? " V" : "", options.noPresent ? " X" : "");
}

// Writes a field in quotation marks, with quotation marks inside it doubled. A text that is too long is cut off.
void quote(char* to, int size, const char* text)
{
    char plain[128];
    plainText(plain, sizeof plain, text);
    int length = 0;
    to[length++] = '"';
    for (const char* c = plain; *c != 0 && length + 4 < size; ++c) {
        if (*c == '"')
            to[length++] = '"';
        to[length++] = *c;
    }
    to[length++] = '"';
    to[length] = 0;
}

}  // namespace

const char* Csv::complain(const char* why)
{
    char plain[160];
    snprintf(problem_, sizeof problem_, "%s: %s", plainText(plain, sizeof plain, name_), why);
    return problem_;
}

const char* Csv::check(const char* name, int* status)
{
    name_ = name;
    *status = 1;
    bool fresh;
    const int file = machine::appendFile(name, &fresh);
    if (file < 0)
        return complain(machine::fileTrouble());
    if (!fresh) {
        machine::closeFile(file);
        if (isOurs(name))
            return nullptr;
        *status = 2;
        return complain("this is no file of records; /O appends to its own files only, or makes a new one");
    }
    // A full disk still accepts a new file's name, but not a line of text: so one is written as a test.
    bool good = writeHeader(file);
    const char* why = machine::fileTrouble();
    if (!machine::closeFile(file) && good) {
        good = false;
        why = machine::fileTrouble();
    }
    machine::removeFile(name);
    return good ? nullptr : complain(why);
}

const char* Csv::append(const Options& options, Real spacing, const Stats& stats)
{
    char text[RECORD_ROOM], settings[64], scene[160], date[64], computer[64];
    formatSettings(settings, sizeof settings, options, spacing);
    quote(scene, sizeof scene, options.modelFile == nullptr ? "" : options.modelFile);
    machine::date(date, sizeof date);
    machine::describe(computer, sizeof computer);
    stats.formatRecord(text, sizeof text, settings, scene, date, computer);

    bool fresh;
    const int file = machine::appendFile(name_, &fresh);
    if (file < 0)
        return complain(machine::fileTrouble());
    const int32_t before = machine::fileBytes(file);
    bool good = before >= 0 && (before > 0 || writeHeader(file)) && write(file, text);
    const char* why = machine::fileTrouble();
    // After a failure neither half a record nor an empty file may remain.
    if (!good && before >= 0)
        machine::cutFile(file, static_cast<uint32_t>(before));
    if (!machine::closeFile(file) && good) {
        good = false;
        why = machine::fileTrouble();
    }
    if (!good && fresh)
        machine::removeFile(name_);
    return good ? nullptr : complain(why);
}
