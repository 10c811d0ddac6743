// The machine: everything that the program needs from the computer it runs on, and nothing else.
//
// There is one interface with two implementations; the linker chooses one of them. src/dos is a PC under DOS (mode 13h,
// PIT, BIOS keyboard, int 33h mouse, DOS files). src/host is a machine without devices (no display, a clock that can
// stand still, frames written to files). No other file knows which implementation it calls. A port to a third machine
// starts from src/host and fills in the devices.
#ifndef FB_MACHINE_H
#define FB_MACHINE_H

#include <stddef.h>
#include <stdint.h>

// A half-open range of columns, from <= x < to, of one row; empty when from >= to. Where rows are cleared, searched or presented
// both ends are multiples of 4.
struct Span {
    int16_t from;
    int16_t to;
};

namespace machine {

// The screen of mode 13h, in pixels.
constexpr int WIDTH = 320;
constexpr int HEIGHT = 200;

// Ticks of clock() per second: the input frequency of the PC's interval timer.
constexpr uint32_t CLOCK_HZ = 1193182;

// Codes that key() returns for keys that are not characters: 0x100 + the scan code of the BIOS. The keys from Backspace on
// have the codes of control characters.
constexpr int KEY_F1 = 0x13b;
constexpr int KEY_F2 = 0x13c;
constexpr int KEY_F3 = 0x13d;
constexpr int KEY_F4 = 0x13e;
constexpr int KEY_HOME = 0x147;
constexpr int KEY_END = 0x14f;
constexpr int KEY_UP = 0x148;
constexpr int KEY_DOWN = 0x150;
constexpr int KEY_LEFT = 0x14b;
constexpr int KEY_RIGHT = 0x14d;
constexpr int KEY_PGUP = 0x149;
constexpr int KEY_PGDN = 0x151;
constexpr int KEY_INS = 0x152;
constexpr int KEY_DEL = 0x153;
constexpr int KEY_BACKSPACE = 8;
constexpr int KEY_TAB = 9;
constexpr int KEY_ENTER = 13;
constexpr int KEY_ESC = 27;

// --- Start and end

// Sets up the clock and the handling of breaks and crashes; it does not touch the video mode. Returns null, or one line that
// says what is missing. To be called once, before all functions below except out(), err() and those for files.
const char* start();

// Restores everything as start() found it: text mode, interrupt vectors, timer mode. A second call is harmless.
void stop();

// Calls stop(), writes `line` and a newline to standard error, and ends the program with exit status `status`.
[[noreturn]] void fail(int status, const char* line);

// Returns true once Ctrl-C or Ctrl-Break was pressed; on the PC a Ctrl-C counts only when key() meets it. The keys set this flag
// only; the program itself asks for it and ends.
bool broken();

// Write text to standard output and to standard error. "\n" ends a line on every machine. Allowed in text mode only.
void out(const char* text);
void err(const char* text);

// --- Video

// Switches to mode 13h. Returns null, or one line that says why this failed (no VGA).
const char* openVideo();

// Restores the text mode that openVideo() found. Harmless when openVideo() has not switched the mode.
void closeVideo();

// Sets the 256 colours: three bytes each (red, green, blue) in 0..63, as the DAC of the VGA expects them.
void setPalette(const uint8_t rgb[768]);

// Copies a part of `frame` (320x200 bytes, top row first) to the screen: from each of the 200 rows the pixels of its span.
void present(const uint8_t* frame, const Span rows[HEIGHT]);

// Waits for the start of the next vertical retrace, but at most about 1/20 s, because some cards do not report it.
void waitRetrace();

// --- Clock

// Returns the time since start() in ticks of 1/CLOCK_HZ s. It never decreases and is accurate to a few ticks.
uint64_t clock();

// Stops the clock for a reproducible run: while `still` is set, clock() of the host returns 0, so that a run depends on
// its switches only. The PC ignores this call.
void standStill(bool still);

// Write the date and time of day ("2026-11-21 22:14:05"), and a short description of the machine without commas
// ("DOS 5.0 80486"). `size` is at least 64 bytes for both.
void date(char* to, int size);
void describe(char* to, int size);

// --- Keyboard and mouse

// Returns the next key in the keyboard buffer without waiting: a character, one of the KEY_ codes above, or 0 when no key is
// there. Caps Lock has no effect: a letter is a capital only when Shift was held.
int key();

// Looks for a mouse. Returns false when there is none; mouse() then always reports that nothing happened.
bool openMouse();

// What the mouse did since the last call: its movement in mickeys (right and down are positive), how often the left button
// was pressed, and which buttons are held now.
struct Mouse {
    int dx;
    int dy;
    int presses;
    bool left;
    bool right;
};
Mouse mouse();

// --- Files. A handle is 0 or more; -1 means failure. After a failure fileTrouble() gives the reason in a few words
// ("disk full").

int createFile(const char* name);
int openFile(const char* name);
// Opens a file for writing at its end, and creates the file when it does not exist; `*fresh` tells whether it was created.
int appendFile(const char* name, bool* fresh);
// Return the number of bytes read or written, or -1 on failure. A write that does not fit on the disk is a failure
// ("disk full").
int32_t readFile(int file, void* to, uint32_t bytes);
int32_t writeFile(int file, const void* from, uint32_t bytes);
// Returns false when the data written could not be stored.
bool closeFile(int file);
// Moves to the first byte of a file that is open for writing.
bool rewindFile(int file);
// Lists the files of a directory ("" is the current one) whose names end in `ending` (".FB", in any case), sorted. At most
// `room` names are stored; names too long for FileName are left out. Returns the number of names stored, 0 also when the
// directory does not exist.
struct FileName {
    char text[32];
};
int listFiles(const char* directory, const char* ending, FileName* to, int room);
// Returns the length of an open file in bytes, or -1 on failure.
int32_t fileBytes(int file);
// Truncates a file that is open for writing to its first `bytes` bytes.
bool cutFile(int file, uint32_t bytes);
// Removes an ordinary file; returns false when the name is anything else (a device, a directory) or on failure.
bool removeFile(const char* name);
// Saving that never loses the old file: beginSave() opens a temporary file beside `name`; endSave() closes it and replaces
// `name` by it. When `good` is false or the replacement fails, endSave() removes the temporary file and the old file stays. Only
// on DOS, when the old file was removed already and renaming then fails, the temporary file stays, for it holds the only copy.
// Only one file can be saved at a time.
int beginSave(const char* name);
bool endSave(int file, bool good);
// Creates a directory; returns true also when the directory exists already.
bool makeDirectory(const char* name);
const char* fileTrouble();

}  // namespace machine

#endif
