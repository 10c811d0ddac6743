// Dump (/D): writes picture, depths and scene of every frame to files, so that a test can examine the frame.
#ifndef FB_DUMP_H
#define FB_DUMP_H

#include "model/anim.h"
#include "model/model.h"
#include "picture/palette.h"
#include "picture/view.h"

class Dump {
public:
    // Creates the directory, tests that files can be written to it, and removes the frames of an older dump. Returns null, or
    // one line that says what is wrong.
    const char* open(const char* directory);

    // Writes one frame as F%07d.PPM, .Z and .TXT. Returns null, or one line that says what is wrong.
    const char* frame(int number, Time time, int rate, const Model& model, const View& view, const Palette& palette,
                      bool grey);

private:
    bool picture(int number, const View& view, const Palette& palette);
    bool distances(int number, const View& view);
    bool scene(int number, Time time, int rate, const Model& model, const Camera& camera, bool grey);
    int create(int number, const char* extension);
    const char* complain();

    const char* directory_ = nullptr;
    char name_[160];
    char problem_[200];
};

#endif
