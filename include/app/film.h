// Film: what is played, in one file (/A): Autodesk's FLI, which is made for 320x200 pixels and the colours of a VGA. A
// picture is stored as what differs from the one before.
#ifndef FB_FILM_H
#define FB_FILM_H

#include "model/anim.h"

class Film {
public:
    // The format counts time in 1/70 s and frames in 16 bits.
    static constexpr int JIFFIES = 70;
    static constexpr int FRAMES_MOST = 65535;
    // A run in real time is filmed at 35 frames a second, whatever its own rate.
    static constexpr int REAL_TIME_JIFFIES = 2;

    ~Film();

    // Begins a file. `rate` is how many frames make a second, as with /N; each frame of the run is then one of the film,
    // for the nearest whole number of 1/70 s. 0: frames come when they come, and the film keeps to the time. Null, or one
    // line that says why not.
    const char* open(const char* name, int rate);
    bool isOpen() const { return file_ >= 0; }

    // Adds a picture (320x200 palette indices) that is seen from `now` on, with the colours it is shown in (768 bytes,
    // 0..63). Null, or one line.
    const char* add(const uint8_t* picture, const uint8_t* dac, Time now);

    // Ends the file. Null, or one line. Harmless when none is open.
    const char* close();

private:
    const char* complain();
    bool write(const uint8_t* from, uint32_t bytes);
    bool writeHeader();
    bool writeFrame(const uint8_t* picture, const uint8_t* dac);
    bool writeSame();
    void put8(int value) { *at_++ = static_cast<uint8_t>(value); }
    void put16(uint32_t value);
    void put32(uint32_t value);
    void putRow(const uint8_t* row);
    int putChanges(const uint8_t* row, const uint8_t* before);
    void endChunk(uint8_t* start, int kind);

    int file_ = -1;
    bool realTime_ = false;
    int jiffies_ = 0;   // a frame
    int frames_ = 0;
    uint32_t bytes_ = 0;
    uint8_t* before_ = nullptr;  // the picture stored last
    uint8_t* first_ = nullptr;
    uint8_t* room_ = nullptr;    // where a frame is put together
    uint8_t* at_ = nullptr;
    uint8_t dac_[768], firstDac_[768];
    char name_[100];
    char problem_[160];
};

#endif
