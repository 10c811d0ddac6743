// Demo: one run of the program. demo.cpp has the main loop and draws the frames, keys.cpp handles keys and mouse, screen.cpp
// writes on top of the picture, and scenes.cpp saves and loads scenes during the run.
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
    // `directory` is the directory of the program, with its final slash or colon; empty for the current directory.
    Demo(const Options& options, const char* directory);
    ~Demo();

    int run();

private:
    // --- The loop (demo.cpp)
    SurfaceMaker surfaceMaker() const { return options_.report98 ? makeReport98 : makeEngine; }
    void begin();
    const char* prepare(int* status);
    const char* openFiles(int* status);
    void tellSeeds();
    [[noreturn]] void fail(int status, const char* line);
    bool finished() const;
    void findTime();
    bool interrupted();
    bool stopped();
    bool frame();
    void placeEye();
    bool drawModel();
    void sortObjects(const FrameContext& frame);
    bool drawObjects(FrameContext& frame);
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
    bool load(const char* name, bool undoable);
    void nextScene();
    void shoot();

    // --- Text on top of the picture (screen.cpp)
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
    bool paletteStale_ = false;  // the video card still has an older palette: it gets `palette_` with the next frame
    Csv csv_;
    Dump dump_;
    Film film_;
    Stats stats_;
    VoxelList* voxels_ = nullptr;
    int order_[Model::OBJECTS_MOST];  // indices of the objects, in the order in which they were drawn last
    int ordered_ = 0;                 // how many objects are in it
    Counts counts_;
    Real spacing_{2};
    uint64_t layTicks_ = 0;      // how long the last layout of all seeds took, in ticks of machine::clock()
    Rate rate_;
    bool wasHeld_ = false;       // objects have spacings that a held rate has given them, and none is held any more
    uint64_t started_ = 0;       // ticks
    Time time_ = 0;              // time of the run
    Pace pace_;
    Time shown_ = 0;             // time of the animation
    int frames_ = 0;
    bool ended_ = false;

    // Keys that were pressed while a frame was drawn.
    static constexpr int KEYS_MOST = 64;
    int keys_[KEYS_MOST];
    int waiting_ = 0;            // number of these keys
    bool escapeWaits_ = false;   // ESC is one of them
    int nextKey_ = 0;            // index of the key that takeKeys() handles next
    bool takingKeys_ = false;

    Orbit orbit_;

    // Editing (/I).
    Editor editor_;
    Time selectedAt_ = 0;        // when the selected object was selected: it pulses for a while
    bool pointing_ = false;      // the mouse moves a pointer, not the object
    bool dragging_ = false;      // the object follows the pointer
    int pointerX_, pointerY_;    // half pixels

    // Text on the screen.
    Overlay overlay_;
    bool greets_;                // show the hint about the help key at the start
    char message_[320] = "";
    Time messageEnd_ = 0;        // time of the run until which the message is shown
    bool help_ = false;          // the page of keys is shown
    bool fps_ = false;           // the frame rate is shown
    uint64_t fpsSince_ = 0;      // start of the interval that is being counted, ticks
    int fpsFrames_ = 0;          // frames in this interval so far
    uint32_t fpsTicks_ = 0;      // length of the last complete interval
    int fpsCounted_ = 0;         // frames in the last complete interval

    // Scenes.
    Ask ask_;
    int listedHere_ = 0;         // how many names in ask_ come from the current directory; the rest are from `directory_`
    char directory_[128];        // the directory of the program
    char scene_[160];            // the file that was last to be loaded, whether it could be or not; empty: none
    char saved_[Ask::LINE_ROOM + 4] = "";     // the file that was saved last
    char replaces_[Ask::LINE_ROOM + 4] = "";  // the existing file that the user was asked about
    int shots_ = 0;              // the highest number of a screenshot tried so far
    bool shotWanted_ = false;    // the next frame is to be written as a screenshot
};

#endif
