// The machine without devices: no display, no mouse, no keyboard, a clock that can stand still, and the files and
// standard streams of a POSIX host. On it the whole program can run, dump frames and be tested without DOS. A port to
// another machine starts from a copy of this file.
//
// Tests replace the user by a script: the environment variable FB_INPUT names a text file with one event per line,
//
//     FRAME key NAME            a key: one character, or ESC, F1..F4, UP, DOWN, LEFT, RIGHT, PGUP, PGDN, INS, DEL,
//                               HOME, END, SPACE, ENTER, TAB, BACKSPACE, BREAK (Ctrl-C)
//     FRAME mouse DX DY BUTTONS mickeys moved, and the buttons held from then on: L, R, LR or -
//
// where FRAME is the number of frames presented before the event (0: before the first frame). The events are in ascending
// order. FRAME.N (4.3) is an event while the next frame is drawn: after key() has returned 0 N times. Lines that begin
// with '#' and empty lines are skipped. A line that cannot be understood makes start() fail, because a test must not pass
// with half a script. openMouse() finds a mouse if the script has mouse lines.
//
// FB_LOG names a log file. It gets one line for each call of setPalette() (`palette`) and present() (`present`), and for
// each call of key() that finds no key (`key`).

// For 32-bit builds: stat() and readdir() would fail on file systems with numbers of files that need more bits.
#define _FILE_OFFSET_BITS 64
#include "machine.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

namespace machine {
namespace {

// The picture and palette that a video card would show, for a debugger to look at.
uint8_t screen[WIDTH * HEIGHT];
uint8_t palette[768];

bool still = false;
timespec started;

volatile sig_atomic_t breakSeen = 0;
bool catching = false;
struct sigaction oldInterrupt;
struct sigaction oldTerminate;

const char* trouble = "";

void onBreak(int)
{
    breakSeen = 1;
}

// ---- The script

struct Event {
    unsigned long frame;
    unsigned long polls;  // the N of FRAME.N
    int key;              // 0: a mouse event, -1: a break
    int dx;
    int dy;
    bool left;
    bool right;
};

Event* events = nullptr;
int eventCount = 0;
int nextKey = 0;    // index of the next event for key()
int nextMouse = 0;  // index of the next event for mouse()
bool scriptHasMouse = false;
unsigned long framesShown = 0;
unsigned long emptyPolls = 0;  // how often key() has returned 0 since the last frame
FILE* log = nullptr;
bool leftHeld = false;
bool rightHeld = false;
char scriptTrouble[160];

// Returns the code of key() for the name of a key in a script; 0 for an unknown name, -1 for BREAK.
int keyNamed(const char* name)
{
    static const struct {
        const char* name;
        int code;
    } names[] = {
        {"ESC", KEY_ESC}, {"F1", KEY_F1},       {"F2", KEY_F2},       {"F3", KEY_F3},     {"F4", KEY_F4},
        {"UP", KEY_UP},   {"DOWN", KEY_DOWN},   {"LEFT", KEY_LEFT},   {"RIGHT", KEY_RIGHT}, {"PGUP", KEY_PGUP},
        {"PGDN", KEY_PGDN}, {"INS", KEY_INS},   {"DEL", KEY_DEL},     {"SPACE", ' '},     {"ENTER", KEY_ENTER},
        {"TAB", KEY_TAB}, {"HOME", KEY_HOME}, {"END", KEY_END},   {"BACKSPACE", KEY_BACKSPACE}, {"BREAK", -1},
    };
    if (name[0] != '\0' && name[1] == '\0')
        return static_cast<unsigned char>(name[0]);
    for (const auto& known : names)
        if (strcmp(name, known.name) == 0)
            return known.code;
    return 0;
}

// Reads one line of the script into `event`; returns false when it cannot be understood.
bool parseEvent(const char* line, Event* event)
{
    *event = Event{};
    char word[16];
    int used = 0;
    if (sscanf(line, "%lu%n", &event->frame, &used) != 1)
        return false;
    const char* rest = line + used;
    if (*rest == '.' && sscanf(rest, ".%lu%n", &event->polls, &used) == 1)
        rest += used;
    if (sscanf(rest, "%15s%n", word, &used) != 1)
        return false;
    rest += used;
    if (strcmp(word, "key") == 0) {
        char name[16];
        if (sscanf(rest, "%15s", name) != 1)
            return false;
        event->key = keyNamed(name);
        return event->key != 0;
    }
    if (strcmp(word, "mouse") == 0) {
        char held[16];
        if (sscanf(rest, "%d %d %15s", &event->dx, &event->dy, held) != 3)
            return false;
        event->left = strchr(held, 'L') != nullptr;
        event->right = strchr(held, 'R') != nullptr;
        scriptHasMouse = true;
        return true;
    }
    return false;
}

// Tells whether the time of an event has come.
bool isDue(const Event& event)
{
    return event.frame < framesShown || (event.frame == framesShown && event.polls <= emptyPolls);
}

bool comesBefore(const Event& a, const Event& b)
{
    return a.frame != b.frame ? a.frame < b.frame : a.polls < b.polls;
}

void note(const char* what)
{
    if (log != nullptr)
        fprintf(log, "%s\n", what);
}

// Reads the whole script. Returns null, or what is wrong with the script.
const char* readScript(const char* name)
{
    FILE* file = fopen(name, "r");
    if (file == nullptr) {
        snprintf(scriptTrouble, sizeof scriptTrouble, "FB_INPUT: cannot open %.100s", name);
        return scriptTrouble;
    }
    char line[256];
    int number = 0;
    int room = 0;
    while (fgets(line, sizeof line, file) != nullptr) {
        ++number;
        if (line[0] == '#' || line[strspn(line, " \t\r\n")] == '\0')
            continue;
        if (eventCount == room) {
            room = room * 2 + 16;
            Event* more = static_cast<Event*>(realloc(events, room * sizeof(Event)));
            if (more == nullptr) {
                fclose(file);
                return "FB_INPUT: out of memory";
            }
            events = more;
        }
        Event* event = &events[eventCount];
        if (!parseEvent(line, event) || (eventCount > 0 && comesBefore(*event, events[eventCount - 1]))) {
            fclose(file);
            snprintf(scriptTrouble, sizeof scriptTrouble, "FB_INPUT: %.100s line %d: not an event", name, number);
            return scriptTrouble;
        }
        ++eventCount;
    }
    fclose(file);
    return nullptr;
}

// Returns a text for errno; errors that DOS has too get the same text as there.
const char* words(int error)
{
    switch (error) {
        case ENOENT:
            return "no such file or directory";
        case EACCES:
        case EPERM:
        case EISDIR:
        case EROFS:
            return "access denied";
        case EMFILE:
        case ENFILE:
            return "too many open files";
        case ENOSPC:
        case EDQUOT:
        case EFBIG:
            return "disk full";
        case EEXIST:
            return "exists already";
        default:
            return strerror(error);
    }
}

int failed()
{
    trouble = words(errno);
    return -1;
}

// The file that will be replaced, and the temporary file of beginSave(); both null while nothing is being saved.
char* savedAs = nullptr;
char* saving = nullptr;

void put(int stream, const char* text)
{
    size_t left = strlen(text);
    while (left > 0) {
        ssize_t done = write(stream, text, left);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return;
        text += done;
        left -= static_cast<size_t>(done);
    }
}

}  // namespace

const char* start()
{
    clock_gettime(CLOCK_MONOTONIC, &started);
    const char* script = getenv("FB_INPUT");
    if (script != nullptr && script[0] != '\0' && events == nullptr) {
        const char* wrong = readScript(script);
        if (wrong != nullptr)
            return wrong;
    }
    const char* told = getenv("FB_LOG");
    if (told != nullptr && told[0] != '\0' && log == nullptr) {
        log = fopen(told, "w");
        if (log == nullptr)
            return "FB_LOG: cannot be written";
    }
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = onBreak;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, &oldInterrupt);
    sigaction(SIGTERM, &action, &oldTerminate);
    catching = true;
    return nullptr;
}

void stop()
{
    closeVideo();
    if (catching) {
        catching = false;
        sigaction(SIGINT, &oldInterrupt, nullptr);
        sigaction(SIGTERM, &oldTerminate, nullptr);
    }
    if (log != nullptr) {
        fclose(log);
        log = nullptr;
    }
    free(events);
    events = nullptr;
    eventCount = 0;
}

void fail(int status, const char* line)
{
    stop();
    err(line);
    err("\n");
    exit(status);
}

bool broken()
{
    return breakSeen != 0;
}

void out(const char* text)
{
    put(1, text);
}

void err(const char* text)
{
    put(2, text);
}

const char* openVideo()
{
    memset(screen, 0, sizeof screen);
    return nullptr;
}

void closeVideo() {}

void setPalette(const uint8_t rgb[768])
{
    memcpy(palette, rgb, sizeof palette);
    note("palette");
}

void present(const uint8_t* frame, const Span rows[HEIGHT])
{
    for (int y = 0; y < HEIGHT; ++y) {
        if (rows[y].from < rows[y].to) {
            const int at = y * WIDTH + rows[y].from;
            memcpy(screen + at, frame + at, static_cast<size_t>(rows[y].to - rows[y].from));
        }
    }
    ++framesShown;
    emptyPolls = 0;
    note("present");
}

void waitRetrace() {}

uint64_t clock()
{
    if (still)
        return 0;
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    int64_t seconds = static_cast<int64_t>(now.tv_sec) - started.tv_sec;
    int64_t nanoseconds = static_cast<int64_t>(now.tv_nsec) - started.tv_nsec;
    if (nanoseconds < 0) {
        nanoseconds += 1000000000;
        --seconds;
    }
    return static_cast<uint64_t>(seconds) * CLOCK_HZ + static_cast<uint64_t>(nanoseconds) * CLOCK_HZ / 1000000000u;
}

void standStill(bool wish)
{
    still = wish;
}

void date(char* to, int size)
{
    const time_t now = time(nullptr);
    tm local;
    if (localtime_r(&now, &local) == nullptr || strftime(to, static_cast<size_t>(size), "%Y-%m-%d %H:%M:%S", &local) == 0)
        to[0] = '\0';
}

void describe(char* to, int size)
{
    utsname names;
    if (uname(&names) != 0) {
        snprintf(to, static_cast<size_t>(size), "host");
        return;
    }
    snprintf(to, static_cast<size_t>(size), "%.24s %.24s", names.sysname, names.machine);
}

int key()
{
    while (nextKey < eventCount && isDue(events[nextKey])) {
        const int code = events[nextKey++].key;
        if (code > 0)
            return code;
        if (code < 0)
            breakSeen = 1;
    }
    ++emptyPolls;
    note("key");
    return 0;
}

bool openMouse()
{
    return scriptHasMouse;
}

Mouse mouse()
{
    Mouse now = {0, 0, 0, false, false};
    while (nextMouse < eventCount && isDue(events[nextMouse])) {
        const Event& event = events[nextMouse++];
        if (event.key != 0)
            continue;
        now.presses += event.left && !leftHeld;
        now.dx += event.dx;
        now.dy += event.dy;
        leftHeld = event.left;
        rightHeld = event.right;
    }
    now.left = leftHeld;
    now.right = rightHeld;
    return now;
}

int createFile(const char* name)
{
    const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    return file < 0 ? failed() : file;
}

int openFile(const char* name)
{
    const int file = open(name, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return failed();
    // A directory can be opened here, but not on DOS; it must not look like a file.
    struct stat facts;
    if (fstat(file, &facts) == 0 && S_ISDIR(facts.st_mode)) {
        close(file);
        errno = EISDIR;
        return failed();
    }
    return file;
}

int appendFile(const char* name, bool* fresh)
{
    *fresh = true;
    int file = open(name, O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) {
        *fresh = false;
        file = open(name, O_WRONLY | O_APPEND | O_CLOEXEC);
    }
    return file < 0 ? failed() : file;
}

int32_t readFile(int file, void* to, uint32_t bytes)
{
    uint32_t done = 0;
    while (done < bytes) {
        const ssize_t got = read(file, static_cast<char*>(to) + done, bytes - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return failed();
        if (got == 0)
            break;
        done += static_cast<uint32_t>(got);
    }
    return static_cast<int32_t>(done);
}

int32_t writeFile(int file, const void* from, uint32_t bytes)
{
    uint32_t done = 0;
    while (done < bytes) {
        const ssize_t put = write(file, static_cast<const char*>(from) + done, bytes - done);
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return failed();
        done += static_cast<uint32_t>(put);
    }
    return static_cast<int32_t>(done);
}

bool closeFile(int file)
{
    if (close(file) != 0) {
        failed();
        return false;
    }
    return true;
}

bool rewindFile(int file)
{
    if (lseek(file, 0, SEEK_SET) < 0) {
        failed();
        return false;
    }
    return true;
}

int32_t fileBytes(int file)
{
    struct stat facts;
    if (fstat(file, &facts) != 0)
        return failed();
    return static_cast<int32_t>(facts.st_size);
}

bool cutFile(int file, uint32_t bytes)
{
    if (ftruncate(file, bytes) != 0) {
        failed();
        return false;
    }
    return true;
}

int listFiles(const char* directory, const char* ending, FileName* to, int room)
{
    DIR* open = opendir(directory[0] == '\0' ? "." : directory);
    if (open == nullptr)
        return 0;
    int count = 0;
    const size_t behind = strlen(ending);
    for (const dirent* entry = readdir(open); entry != nullptr && count < room; entry = readdir(open)) {
        const size_t length = strlen(entry->d_name);
        if (length <= behind || length >= sizeof to->text || strcasecmp(entry->d_name + length - behind, ending) != 0)
            continue;
        int at = count++;
        for (; at > 0 && strcmp(to[at - 1].text, entry->d_name) > 0; --at)
            to[at] = to[at - 1];
        strcpy(to[at].text, entry->d_name);
    }
    closedir(open);
    return count;
}

bool removeFile(const char* name)
{
    // Only ordinary files are removed: no devices and no symbolic links.
    struct stat facts;
    if (lstat(name, &facts) == 0 && !S_ISREG(facts.st_mode)) {
        errno = EPERM;
        failed();
        return false;
    }
    if (unlink(name) != 0) {
        failed();
        return false;
    }
    return true;
}

int beginSave(const char* name)
{
    struct stat facts;
    const bool there = stat(name, &facts) == 0;
    if (there && !S_ISREG(facts.st_mode)) {
        // A device or a pipe is written directly; it cannot be replaced by a file.
        return createFile(name);
    }
    if (there && access(name, W_OK) != 0)
        return failed();
    // With a symbolic link, the file that it points to is replaced.
    savedAs = there ? realpath(name, nullptr) : strdup(name);
    saving = savedAs == nullptr ? nullptr : static_cast<char*>(malloc(strlen(savedAs) + sizeof ".XXXXXX"));
    if (saving != nullptr) {
        strcpy(saving, savedAs);
        strcat(saving, ".XXXXXX");
        const int file = mkstemp(saving);
        if (file >= 0) {
            const mode_t mask = umask(0);
            umask(mask);
            fchmod(file, there ? facts.st_mode & 0777 : 0666 & ~mask);
            return file;
        }
    }
    failed();
    free(saving);
    free(savedAs);
    saving = savedAs = nullptr;
    return -1;
}

bool endSave(int file, bool good)
{
    const char* why = trouble;
    const bool closed = closeFile(file);
    if (saving == nullptr) {
        trouble = good ? trouble : why;
        return good && closed;
    }
    if (good && closed && rename(saving, savedAs) != 0) {
        failed();
        good = false;
    } else if (!good) {
        trouble = why;
    }
    good = good && closed;
    if (!good)
        unlink(saving);
    free(saving);
    free(savedAs);
    saving = savedAs = nullptr;
    return good;
}

bool makeDirectory(const char* name)
{
    if (mkdir(name, 0777) == 0)
        return true;
    const int error = errno;
    struct stat facts;
    if (stat(name, &facts) == 0 && S_ISDIR(facts.st_mode))
        return true;
    errno = error;
    failed();
    return false;
}

const char* fileTrouble()
{
    return trouble;
}

}  // namespace machine
