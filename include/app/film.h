// Film: records the animation in one file (/A). The format is Autodesk's FLI, which is made for 320x200 pixels and the
// colours of a VGA. Each picture is stored as its differences from the picture before.
#ifndef FB_FILM_H
#define FB_FILM_H

#include "model/anim.h"

class Film {
public:
    // The format measures time in jiffies of 1/70 s and counts frames with 16 bits.
    static constexpr int JIFFIES = 70;
    static constexpr int FRAMES_MOST = 65535;
    // A run in real time is filmed at 35 frames per second, whatever its own frame rate.
    static constexpr int REAL_TIME_JIFFIES = 2;

    ~Film();

    // Begins a file. With `rate` > 0 (frames per second of animation, as with /N) each frame of the run is one frame of the
    // film and lasts the nearest whole number of jiffies. With `rate` 0 frames arrive at irregular times, and the film
    // repeats or skips frames to keep to the clock. An older film is replaced, any other file is not. Returns null, or one line
    // that says what is wrong; `*status` is then the program's exit status. `name` must last as long as the film.
    const char* open(const char* name, int rate, int* status);
    bool isOpen() const { return file_ >= 0; }

    // Adds a picture (320x200 palette indices) that is shown from time `now` on, with its palette (768 bytes, 0..63).
    // Returns null, or one line that says what is wrong.
    const char* add(const uint8_t* picture, const uint8_t* dac, Time now);

    // Ends the file. Returns null, or one line that says what is wrong. Harmless when no file is open.
    const char* close();

private:
    const char* complain(const char* why);
    bool write(const uint8_t* from, uint32_t bytes);
    bool writeHeader();
    bool writeFrame(const uint8_t* picture, const uint8_t* dac);
    bool writeSame();
    void put8(int value) { *at_++ = static_cast<uint8_t>(value); }
    void put16(uint32_t value);
    void put32(uint32_t value);
    void putRow(const uint8_t* row);
    int putChanges(const uint8_t* row, const uint8_t* before);
    int putColours(const uint8_t* dac);
    int putWhole(const uint8_t* picture);
    int putDifference(const uint8_t* picture);
    uint8_t* beginChunk();
    void endChunk(uint8_t* start, int kind);

    int file_ = -1;
    bool realTime_ = false;
    int jiffies_ = 0;   // length of a frame
    int frames_ = 0;
    uint32_t bytes_ = 0;
    bool failed_ = false;  // a write has failed, after which nothing more is added
    uint8_t* before_ = nullptr;  // the picture stored last
    uint8_t* first_ = nullptr;   // the first picture: a film ends with the changes that lead back to it
    uint8_t* room_ = nullptr;    // buffer in which a frame is assembled
    uint8_t* at_ = nullptr;      // where the next byte goes in `room_`
    uint8_t dac_[768], firstDac_[768];
    const char* name_ = nullptr;
    char problem_[160];
};

#endif
