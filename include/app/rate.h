// Rate: holds a number of frames a second by choosing the spacing of each object's seeds (/F). One object is laid out anew at
// a time, a step of a fifth finer or coarser, so that nothing jumps.
#ifndef FB_RATE_H
#define FB_RATE_H

#include "model/model.h"

class Rate {
public:
    // How many frames a second are held from now on; 0: none.
    void hold(int frames);
    int frames() const { return frames_; }

    // Told of a frame: how long it took, in ticks of the machine's clock.
    void add(uint64_t ticks, const Model& model);

    // What is to be done before the next frame: an object that is laid out anew, and `*spacing` for it. To be asked until it
    // says -1, nothing more.
    int next(const Model& model, Real* spacing);

    // There was no memory for the last one: from now on nothing becomes finer.
    void refused() { finest_ = true; }

private:
    // Numbers of objects, -1 where there is none, and how coarse they are.
    struct Extremes {
        int fine, coarse;
        Real least, most;
    };
    Extremes findExtremes(const Model& model) const;

    int frames_ = 0;
    uint64_t ticks_ = 0;    // of the frames since the last decision
    uint32_t counted_ = 0;
    int32_t load_ = 0;      // length of a frame as it would be now, over the wanted one, 1.0 = 256
    int left_ = 0;          // objects that may still be changed before the next frame
    bool finest_ = false;
};

#endif
