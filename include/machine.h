// The machine: everything the program needs from the computer it runs on, and nothing else.
//
// One interface, two implementations, chosen when the program is linked: src/dos is a PC under DOS (mode 13h, PIT,
// BIOS keyboard, int 33h mouse, DOS files), src/host is a machine with nothing behind it (no display, a clock that can
// stand still, frames to files). No other file knows which one it talks to. A port to a third machine starts from
// src/host and fills it in.
#ifndef FB_MACHINE_H
#define FB_MACHINE_H

#include <stddef.h>
#include <stdint.h>

// The pixels of one row that were touched: columns from <= x < to, both multiples of 4, 0..320; from >= to: none.
struct Span {
    int16_t from;
    int16_t to;
};

namespace machine {

// The screen of mode 13h, in pixels.
constexpr int WIDTH = 320;
constexpr int HEIGHT = 200;

// Ticks of clock() in a second: the input frequency of the PC's interval timer.
constexpr uint32_t CLOCK_HZ = 1193182;

// Keys that are no characters, as key() returns them: 0x100 + the scan code of the BIOS.
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

// Makes the clock, break and crash handling ready; the video mode is not touched. Null, or one line that says what is
// missing. Call once, before anything else below but out(), err() and the files.
const char* start();

// Puts everything back as start() found it: text mode, interrupt vectors, timer mode. Harmless when called twice.
void stop();

// stop(), then `line` and a newline to standard error, then the end of the program with `status`.
[[noreturn]] void fail(int status, const char* line);

// True once Ctrl-C or Ctrl-Break was pressed. The program ends at the next frame; nothing ends it in between.
bool broken();

// Text to standard output and standard error. "\n" ends a line on every machine. Only while in text mode.
void out(const char* text);
void err(const char* text);

// --- Video

// Switches to mode 13h. Null, or one line that says why not (no VGA).
const char* openVideo();

// Back to the text mode found by openVideo(). Harmless when no mode was set.
void closeVideo();

// The 256 colours, three bytes each (red, green, blue), every one 0..63 as the VGA's DAC takes them.
void setPalette(const uint8_t rgb[768]);

// Shows a part of `frame` (320x200 bytes, top row first): in each of the 200 rows the pixels of its span.
void present(const uint8_t* frame, const Span rows[HEIGHT]);

// Waits for the start of the next vertical retrace, but never longer than about 1/20 s (a card may not tell).
void waitRetrace();

// --- Clock

// Ticks of 1/CLOCK_HZ s since start(). Never goes back; good to a few ticks.
uint64_t clock();

// Host only matters: with `still` clock() stands still at 0, so that a run depends on nothing but its switches. A PC
// ignores it.
void standStill(bool still);

// The date and the time of day, "2026-11-21 22:14:05", and the machine in a few words without a comma ("DOS 5.0 80486").
// Both take at least 64 bytes.
void date(char* to, int size);
void describe(char* to, int size);

// --- Keyboard and mouse

// The next key pressed, or 0: a character, or one of the KEY_ codes above. Does not wait. Letters come as they would
// without Caps Lock: capital with Shift and no other way.
int key();

// Looks for a mouse. False: there is none, and mouse() says nothing moved.
bool openMouse();

// What the mouse did since the last call: mickeys (right and down are positive), how often the left button went down, and
// the buttons now held.
struct Mouse {
    int dx;
    int dy;
    int presses;
    bool left;
    bool right;
};
Mouse mouse();

// --- Files. Handles are 0 or more; -1 is failure, and fileTrouble() then says why in a few words ("disk full").

int createFile(const char* name);
int openFile(const char* name);
// Opens for writing at the end, making the file when there is none; `*fresh` tells whether it was made.
int appendFile(const char* name, bool* fresh);
// Bytes read or written, -1 on failure. A write that does not fit on the disk is a failure ("disk full").
int32_t readFile(int file, void* to, uint32_t bytes);
int32_t writeFile(int file, const void* from, uint32_t bytes);
// False when what was written could not be kept.
bool closeFile(int file);
// Goes back to the first byte of a file that is being written.
bool rewindFile(int file);
// The names of files in a directory ("" is the current one) that end in `ending` (".FB", either case), sorted, as many as
// there is room for; longer names than fit are left out. Returns how many; 0 too when there is no such directory.
struct FileName {
    char text[32];
};
int listFiles(const char* directory, const char* ending, FileName* to, int room);
// How many bytes an open file has; -1 on failure.
int32_t fileBytes(int file);
// Cuts a file that is open for writing off behind its first `bytes` bytes.
bool cutFile(int file, uint32_t bytes);
// Removes a plain file; false for anything else.
bool removeFile(const char* name);
// Saving that never loses what was there: what is written to the handle goes to a file of another name beside `name`,
// which endSave() closes and puts in the place of `name`; with `good` false, or when that fails, it removes it, and what
// was there before stays. One file at a time.
int beginSave(const char* name);
bool endSave(int file, bool good);
// Makes a directory; true too when it is there already.
bool makeDirectory(const char* name);
const char* fileTrouble();

}  // namespace machine

#endif
