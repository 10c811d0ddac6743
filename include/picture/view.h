// View: the camera, the frame buffer and the Z-buffer (report, The Rendering Technique and Appendix A). show() makes
// scales of voxels by a perspective transformation and draws them: most by the loop of scales.h, the rest one by one.
//
// A point p from the eye, in the axes of the view, falls on column centreX + focalX p.x / p.z and row
// centreY - focalY p.y / p.z; pixel i covers [i, i + 1). Mode 13h shows 320x200 pixels on a 4:3 screen, so a pixel is
// 5 wide to 6 high and focalX = 1.2 focalY.
#ifndef FB_VIEW_H
#define FB_VIEW_H

#include "model/surface.h"
#include "picture/palette.h"
#include "picture/scales.h"

class View : public Hider {
public:
    // Rows of the frame below the screen. They are empty: what looks for something below a pixel need not ask where the screen
    // ends.
    static constexpr int ROWS_BELOW = 6;

    ~View();

    // Makes the buffers. False: no memory.
    bool open();

    // Takes on a camera. 64 <= focal <= 500 pixels. One that has only moved or turned costs nothing.
    void setCamera(const Camera& camera);
    const Camera& camera() const { return camera_; }

    // Scales or single pixels (the report's '*' key).
    void setPixels(bool pixels) { pixels_ = pixels; }
    bool pixels() const { return pixels_; }

    // Whether scales are placed as they were in the first versions, large and clipped ones by their exact depth and others by steps
    // of 1/8 unit: the report's method is compared byte for byte from version to version.
    void setPrinted(bool printed)
    {
        printed_ = printed;
        if (factors_ != nullptr)
            makeLens();
    }

    // Starts a frame: clears what the last one touched.
    void begin();

    // Draws the voxels of an object; those before the near plane (1 unit), behind 511 units or off the screen are left
    // out. Returns the number of scales drawn.
    int show(const VoxelList& list);

    // Text and lines on top of the picture: marks a rectangle of pixels as touched and gives the frame to draw into.
    uint8_t* overlay(int left, int top, int width, int height);

    // True also for what lies beside the screen. What is nearer than 76 units is never hidden.
    bool hides(const int32_t place[3], int32_t radius) const override;

    // Closes the gaps between scales: empty pixels take over colour and depth of the drawn ones beside them, where an
    // opening is small (the limits stand in gaps.cpp) or ends between drawn pixels. `spacing` of the seeds, units. For when
    // all objects are drawn, before anything is written over them; single pixels are left alone. With a model, what is open
    // stays so: a gap wider than two pixels half way across which there is no surface within about a unit. With the model's
    // colours too, what is filled between two objects has the colour of the one whose field is the stronger there.
    // Returns the number of pixels that were drawn before.
    int closeGaps(Real spacing, const Model* model = nullptr, const Palette* palette = nullptr);

    // The place in the world of a pixel (row * WIDTH + column) that was drawn; or of any, were it so far away (1/128 unit).
    Point pointAt(int at) const { return pointAt(at, zbuffer_[at]); }
    Point pointAt(int at, int depth) const;

    // Of the frame as it is so far: a pixel (row * WIDTH + column) is given a depth (1/128 unit) and a colour, or what
    // another one has; and between which columns of a row anything may be drawn.
    void setPixel(int at, int depth, uint8_t colour)
    {
        // What was empty may lie beyond all that was touched.
        if (zbuffer_[at] == Z_EMPTY)
            touchPixel(at);
        zbuffer_[at] = static_cast<uint16_t>(depth);
        frame_[at] = colour;
    }
    void copyPixel(int at, int from)
    {
        frame_[at] = frame_[from];
        zbuffer_[at] = zbuffer_[from];
    }
    const Span& touched(int row) const { return touched_[row]; }

    // Ends a frame; rows() then tells what differs from the frame before.
    void end();

    const uint8_t* frame() const { return frame_; }
    const uint16_t* zbuffer() const { return zbuffer_; }
    const Span* rows() const { return present_; }

private:
    // Where a scale lies: the depth of its centre, 1/256 unit; the centre on the screen and half its sides, pixels with 12 bits of
    // fraction.
    struct Placed {
        int32_t z, column, row, halfWide, halfHigh;
    };

    void makeLens();
    void touchPixel(int at);
    void mark(int left, int top, int right, int bottom);
    bool prepareLoop(const VoxelList& list);
    int showRun(const uint8_t* ramp, const Voxel* from, const Voxel* to, bool loop);
    bool ordinary(const Voxel& voxel) const;
    bool place(const Voxel& voxel, Placed* at) const;
    static bool clip(const Placed& at, FineScale* scale);
    void tilt(const Voxel& voxel, const Placed& at, int32_t* across, int32_t* down) const;
    bool project(const Voxel& voxel, FineScale* scale) const;

    Camera camera_;
    int32_t focalX_ = 0, focalY_ = 0, centreX_ = 0, centreY_ = 0;  // pixels, 12 bits of fraction
    Lens lens_{};
    bool pixels_ = false;
    bool printed_ = false;
    uint8_t* frame_ = nullptr;
    uint16_t* zbuffer_ = nullptr;
    Factors* factors_ = nullptr;
    Span touched_[machine::HEIGHT];
    Span last_[machine::HEIGHT];
    Span present_[machine::HEIGHT];
};

#endif
