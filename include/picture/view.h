// View: the camera, the frame buffer and the Z-buffer (report, The Rendering Technique and Appendix A). show() projects voxels
// to scales and draws them: most with the loop of scales.h, the rest one by one.
//
// A point p relative to the eye, in the axes of the view, is projected to column centreX + focalX p.x / p.z and row
// centreY - focalY p.y / p.z; pixel i covers the half-open range [i, i + 1). Mode 13h shows 320x200 pixels on a 4:3 screen, so
// the width of a pixel is to its height as 5 to 6, and focalX = 1.2 focalY.
#ifndef FB_VIEW_H
#define FB_VIEW_H

#include "model/surface.h"
#include "picture/palette.h"
#include "picture/scales.h"

// A pixel on a border between two objects, and the surface's depth there, 1/128 unit. `outwards` leads to the pixel across the
// border, where the surface must go on as that of the other object.
struct Crossing {
    uint16_t pixel, depth;
    int16_t outwards;
};

class View : public Hider {
public:
    // The frame has this many more rows below the screen, which stay empty, so that a search for drawn pixels below a pixel need
    // not test for the end of the screen.
    static constexpr int ROWS_BELOW = 6;

    ~View();

    // Allocates the buffers. With `report98` scales are projected as in the first versions: large and clipped ones with their exact
    // depth, all others with depths in steps of 1/8 unit. The pictures of the report's method are compared byte for byte between
    // versions. Returns false when there is no memory.
    bool open(bool report98 = false);

    // Sets the camera, with focal lengths of FOCAL_LEAST..FOCAL_MOST pixels (model/scene.h); below about 15, steep scales get wrong
    // depths. A camera that has only moved or turned costs nothing, because the table of factors stays valid.
    void setCamera(const Camera& camera);
    const Camera& camera() const { return camera_; }

    // Whether each voxel is drawn as a single pixel instead of a scale (the report's '*' key).
    void setPixels(bool pixels) { pixels_ = pixels; }
    bool pixels() const { return pixels_; }

    // Starts a frame: clears the pixels that the last frame touched.
    void begin();

    // Draws the voxels of an object, except those nearer than 1 unit, farther than 511 units or off the screen. Returns the
    // number of scales drawn.
    int show(const VoxelList& list);

    // For text and lines on top of the picture: marks a rectangle of pixels as touched and returns the frame to draw into.
    uint8_t* overlay(int left, int top, int width, int height);

    // Also returns true for a ball beside the screen, unless it lies far aside. A ball that comes nearer than 76 units is never
    // reported as hidden.
    bool hides(const int32_t place[3], int32_t radius) const override;

    // Closes the gaps between scales: empty pixels get the colour and the depth of the drawn pixels beside them where an opening
    // is small (see the limits in gaps.cpp) or ends between drawn pixels. `spacing` is that of the seeds, units. To be called
    // when all objects are drawn and before anything is drawn over them. Does nothing when voxels are drawn as single pixels.
    // With a model, real openings stay open: gaps wider than two pixels where the model has no surface within about a unit of the
    // place half way across, nor within two and on the ray through the pixel beside the farther end. Where scales have missed the
    // model's surface it is drawn (missed.h), also in gaps wider than two pixels between different surfaces. Where one surface ends
    // before another, each pixel gets the one that its ray meets first (outlines.h). With a palette, pixels filled between two
    // shades of one ramp get a shade between them; and with both, pixels beside borders of colours get the colour of the model's
    // surface there (borders.h), and pixels at creases its brightness, too (creases.h).
    void closeGaps(Real spacing, const Model* model = nullptr, const Palette* palette = nullptr);

    // The point of the world that a pixel (row * WIDTH + column) shows: at its own depth, or at a given one (1/128 unit).
    Point pointAt(int pixel) const { return pointAt(pixel, zbuffer_[pixel]); }
    Point pointAt(int pixel, int depth) const;
    // How far the ray of sight through a pixel goes over one unit of depth, axes of the world.
    Vector rayAt(int pixel) const;

    // Sets the depth (1/128 unit) and the colour of a pixel (row * WIDTH + column) of the frame at hand.
    void setPixel(int pixel, int depth, uint8_t colour)
    {
        // An empty pixel may lie outside of the touched columns.
        if (zbuffer_[pixel] == Z_EMPTY)
            touchPixel(pixel);
        zbuffer_[pixel] = static_cast<uint16_t>(depth);
        frame_[pixel] = colour;
    }
    void copyPixel(int pixel, int from)
    {
        frame_[pixel] = frame_[from];
        zbuffer_[pixel] = zbuffer_[from];
    }
    // The crossings of this frame's scales, as far as those scales were seen when their object was drawn. Those beyond
    // CROSSINGS_MOST are left out.
    static constexpr int CROSSINGS_MOST = 2048;
    const Crossing* crossings() const { return crossings_; }
    int crossingCount() const { return crossingCount_; }
    // The columns of a row outside of which nothing has been drawn, multiples of 4. setTouched() sets them from the runs of drawn
    // pixels, which must be all that the row has, from left to right.
    const Span& touched(int row) const { return touched_[row]; }
    void setTouched(int row, const Span* runs, const Span* end)
    {
        touched_[row] = {machine::WIDTH, 0};
        if (runs < end)
            touched_[row] = {static_cast<int16_t>(runs->from & ~3), static_cast<int16_t>((end[-1].to + 3) & ~3)};
    }

    // The columns of a row outside of which no list with borders to other objects has been drawn.
    const Span& bordered(int row) const { return bordered_[row]; }
    // The columns of a row outside of which no list of voxels lies behind an earlier one that has borders to other objects.
    const Span& covered(int row) const { return covered_[row]; }

    // What the search for creases (creases.h) has found in a frame: a bit for each band of CREASE_BAND rows; and which row of each
    // band it began with.
    static constexpr int CREASE_BAND = 8;
    struct FoundCreases {
        uint32_t bands;
        int turn;
    };

    // Ends a frame; rows() then returns the columns of each row that may differ from the frame before.
    void end();

    const uint8_t* frame() const { return frame_; }
    const uint16_t* zbuffer() const { return zbuffer_; }
    const Span* rows() const { return present_; }

private:
    // Positions on the screen have this many fraction bits; and half a pixel.
    static constexpr int FRACTION = 12;
    static constexpr int32_t HALF = 1 << (FRACTION - 1);

    // A projected scale: the depth of its centre, 1/256 unit; its centre on the screen and its half extents, pixels with 12
    // fraction bits.
    struct Placed {
        int32_t z, column, row, halfWidth, halfHeight;
    };

    void makeLens();
    void touchPixel(int pixel);
    void mark(int left, int top, int right, int bottom);
    void noteCovered(bool bordered);
    bool prepareLoop(const VoxelList& list);
    int showRun(const uint8_t* ramp, const Voxel* from, const Voxel* to, bool loop);
    void noteCrossings(const VoxelList& list);
    void noteCrossing(const Voxel& voxel);
    bool ordinary(const Voxel& voxel) const;
    bool place(const Voxel& voxel, Placed* placed) const;
    static bool clip(const Placed& placed, Scale* scale);
    void tilt(const Voxel& voxel, const Placed& placed, int32_t* across, int32_t* down) const;
    bool project(const Voxel& voxel, Scale* scale) const;

    Camera camera_;
    int32_t focalX_ = 0, focalY_ = 0, centreX_ = 0, centreY_ = 0;  // pixels, 12 fraction bits
    Lens lens_{};
    bool pixels_ = false;
    bool report98_ = false;
    uint8_t* frame_ = nullptr;
    uint16_t* zbuffer_ = nullptr;
    Factors* factors_ = nullptr;
    // How far the ray of sight through the middle of a pixel leads to the right, for each column, and up, for each row, while it
    // leads one unit ahead.
    Real toRight_[machine::WIDTH], toTop_[machine::HEIGHT];
    Crossing crossings_[CROSSINGS_MOST];
    int crossingCount_ = 0;
    Span touched_[machine::HEIGHT];
    FoundCreases foundCreases_{0, 0};
    bool anyBordered_;                // in this frame some list is bordered
    Span bordered_[machine::HEIGHT];  // for each row, the columns that bordered lists have drawn on
    Span covered_[machine::HEIGHT];
    Span last_[machine::HEIGHT];
    Span present_[machine::HEIGHT];
};

#endif
