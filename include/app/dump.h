// Dumped frames (/D): picture, depth and scene of every frame as files, so that a frame can be tested.
#ifndef FB_DUMP_H
#define FB_DUMP_H

#include "model/anim.h"
#include "model/model.h"
#include "picture/palette.h"
#include "picture/view.h"

class Dump {
public:
    // Makes the directory, tries whether it can be written to, and removes the frames of an older dump. Null, or one line that
    // says why not.
    const char* open(const char* directory);

    // Writes F%07d.PPM, .Z and .TXT of one frame. Null, or one line that says why not.
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
