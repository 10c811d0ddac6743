// Rate: holds a frame rate (/F) by choosing the spacing of each object's seeds. Usually one object at a time gets new seeds,
// with a spacing about a fifth finer or coarser, so that the picture does not jump.
#ifndef FB_RATE_H
#define FB_RATE_H

#include "model/model.h"

class Rate {
public:
    // Sets the number of frames per second to be held from now on; 0 switches this off.
    void hold(int frames);
    int frames() const { return frames_; }

    // Reports a frame: `ticks` is how long it took, in ticks of machine::clock().
    void add(uint64_t ticks, const Model& model);

    // Returns the index of an object that must get new seeds before the next frame, and its new spacing in `*spacing`; -1
    // when nothing is left to do. `camera` is the one that the model is seen by. The caller calls it until it returns -1.
    int next(const Model& model, const Camera& camera, Real* spacing);

    // The caller reports that there was no memory for the last change: from now on no object becomes finer.
    void refused() { finest_ = true; }

private:
    // The finest object that can become coarser and the coarsest one that can become finer: their indices (-1: there is
    // none) and their coarseness.
    struct Extremes {
        int fine, coarse;
        Real least, most;
    };
    Extremes findExtremes(const Model& model, const Camera& camera) const;

    int frames_ = 0;
    uint64_t ticks_ = 0;    // length of all frames since the last decision
    uint32_t counted_ = 0;  // number of these frames
    int32_t load_ = 0;      // expected length of a frame after the changes so far, over the wanted length; 1.0 = 256
    int left_ = 0;          // objects that may still be changed before the next frame
    bool finest_ = false;   // no object may become finer: memory ran out
};

#endif
