// Demo: one run of the program. demo.cpp has its loop and the frame, keys.cpp what keys and mouse do, screen.cpp what is
// written on top of the picture, scenes.cpp saving and loading while it runs.
#ifndef FB_LOOP_H
#define FB_LOOP_H

#include "app/ask.h"
#include "app/csv.h"
#include "app/dump.h"
#include "app/edit.h"
#include "app/film.h"
#include "app/options.h"
#include "app/orbit.h"
#include "app/overlay.h"
#include "app/pace.h"
#include "app/rate.h"
#include "app/stats.h"
#include "machine.h"
#include "picture/palette.h"
#include "surface/engine.h"

class Demo {
public:
    // `directory` is where the program lies, with its final slash or colon; empty for the current directory.
    Demo(const Options& options, const char* directory);
    ~Demo();

    int run();

private:
    // --- The loop (demo.cpp)
    SurfaceMaker surfaceMaker() const { return options_.printed ? makeReport98 : makeEngine; }
    void begin();
    const char* prepare(int* status);
    void tellSeeds();
    [[noreturn]] void fail(int status, const char* line);
    bool finished() const;
    void findTime();
    bool interrupted();
    bool stopped();
    bool frame();
    void placeEye();
    bool drawModel();
    bool drawObject(SoftObject& object, const FrameContext& frame);
    const uint8_t* pulseRamp(const uint8_t* ramp);
    void showFrame();
    const char* keepFrame();
    void countFrames();
    void holdRate(uint64_t began);
    void resample(Real spacing);
    void changed();
    void sayResults(uint64_t ticks);

    // --- Keys and mouse (keys.cpp)
    void takeKeys();
    void key(int code);
    bool eyeKey(int code);
    void hold();
    void letGo();
    void playKey(int code);
    void handKey(int code);
    bool editKey(int code);
    void mouse();
    void pointAt(const machine::Mouse& m);
    int objectAt(int x, int y) const;
    void push(Real x, Real y, Real z);
    void selected();

    // --- Scenes and screenshots (scenes.cpp)
    void askSave();
    void askLoad();
    void answer(int code);
    void load(const char* name, bool undoable);
    void nextScene();
    void shoot();

    // --- On top of the picture (screen.cpp)
    void say(const char* text);
    void busy(const char* text);
    void drawOverlay();
    void drawHands();
    void drawHelp();
    void drawAsk();
    void mark(int index, void (Overlay::*shape)(int, int));

    const Options& options_;
    Model model_;
    View view_;
    Palette palette_;
    bool paletteStale_ = false;  // the card has another one: it is set with the next frame
    Csv csv_;
    Dump dump_;
    Film film_;
    Stats stats_;
    VoxelList* voxels_ = nullptr;
    Counts counts_;
    Real spacing_{2};
    uint64_t layTicks_ = 0;      // how long laying out the seeds took the last time
    Rate rate_;
    uint64_t started_ = 0;
    Time time_ = 0;              // of the run
    Pace pace_;
    Time shown_ = 0;             // of the animation
    int frames_ = 0;
    bool ended_ = false;

    // Keys that were pressed while a frame was drawn.
    static constexpr int KEYS_MOST = 64;
    int keys_[KEYS_MOST];
    int waiting_ = 0;
    bool escapeWaits_ = false;
    int nextKey_ = 0;            // while they are taken: the one to be taken next
    bool takingKeys_ = false;

    Orbit orbit_;

    // Hands on.
    Editor editor_;
    Time selectedAt_ = 0;
    bool pointing_ = false;      // the mouse moves a pointer
    bool dragging_ = false;
    int pointerX_, pointerY_;    // in half pixels

    // On the screen.
    Overlay overlay_;
    bool greets_;                // tells for a while which keys to begin with
    char message_[320] = "";
    Time messageEnd_ = 0;
    bool help_ = false;
    bool fps_ = false;
    uint64_t fpsSince_ = 0;      // ticks
    int fpsFrames_ = 0;
    uint32_t fpsTicks_ = 0;      // of the frames counted last
    int fpsCounted_ = 0;

    // Scenes.
    Ask ask_;
    int listedHere_ = 0;         // of the names that ask_ lists, those in the current directory; the others lie beside us
    char directory_[128];
    char scene_[160];            // the file that was loaded last; empty: none
    char saved_[Ask::LINE_ROOM + 4] = "";     // the file that was saved last
    char replaces_[Ask::LINE_ROOM + 4] = "";  // the file that the user was told is there
    int shots_ = 0;              // up to which number screenshots are taken
    bool shotWanted_ = false;
};

#endif
