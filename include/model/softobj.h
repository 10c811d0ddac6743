// SoftObject: a primitive of the model, with the seeds that sample its surface and the list of the objects it blends
// with (report, Section III, Data Structures). The class settles and draws seeds of any primitive; a subclass gives the
// distance to its core and lays out seeds and roots, and nothing else.
#ifndef FB_SOFTOBJ_H
#define FB_SOFTOBJ_H

#include "model/field.h"
#include "math/list.h"
#include "model/seed.h"
#include "math/vec.h"
#include "surface/voxel.h"

class SoftObject;

// Most neighbours that one object can blend with at a time; further ones are left out.
constexpr int NEAR_MOST = 63;

// The sizes an object may have (the distance from its core where its field ends), units.
constexpr int SIZE_LEAST = 1;
constexpr int SIZE_MOST = 100;

// An edge of the model's graph, as one of its two ends sees it: the neighbour, and what its field is multiplied by
// before it is added here (the report's "weighted graph"; 1 is plain blending, 0..4).
struct Link {
    SoftObject* object;
    Real weight;
    // For Settler: from this end to the other at the last update, and the other's size then; how it moved for it, how far, and
    // how fast those seeds that wait think that it is (units an update); the movement when it is as fast as that.
    Vector apart, moved;
    Real size, way, speed;
    Vector pace;

    bool operator==(const Link& other) const { return object == other.object; }
};

// Least room for voxels that SoftObject::draw() can work with.
constexpr int DRAW_ROOM = 128;

// What was done for a frame, as the statistics count it.
struct Counts {
    uint32_t updated;      // seeds whose position was looked for
    uint32_t drawn;        // scales drawn
    uint32_t iterations;   // looks at the field while seeds were updated: evaluations of the whole sum F
    uint32_t normals;      // surface normals taken from the field
    uint32_t samples;      // evaluations of the whole sum F for normals (three each with the report's method)
    uint32_t unsettled;    // seeds that reached the iteration limit
};

// The circumstances of a frame, the same for all objects.
struct Look {
    Point eye;         // where the viewer is; he looks along +z
    Vector light;      // unit vector from the model towards the light
    bool printed;      // the report's own methods, as printed
    Counts* counts;
};

// The report's tolerances. It names them and gives no figure; these are ours.
namespace printed {
constexpr Real LOCATION_TOLERANCE(0.00004);  // of the field: "desired accuracy"
constexpr int ITERATION_LIMIT = 32;
constexpr Real BACK_FACE(-0.43);             // cosine of path and direction to the viewer, below which a seed is skipped
constexpr Real DISPLACEMENT(0.001);         // of the position: less is taken as not moved
constexpr Real DEFORMITY(0.01);             // of the position: less, and the normal is the path
constexpr Real OVERSHOOT(0.05);             // of the field: by how much a neighbour may be stronger
constexpr Real OVERSAMPLE(0.05);            // difference of positions that activates the seed between
constexpr Real SAMPLE_DISTANCE(0.5);        // units: the three samples for a normal
constexpr Real SCALE(0.75);                 // half a scale, in spacings
constexpr Real MAGNIFICATION(2.0);          // growth of a scale with |position - 1|
}

class SoftObject {
public:
    // `size` is the distance from the core where the field ends, SIZE_LEAST..SIZE_MOST; the caller has checked it.
    // `tapers`: the size differs along the core, and `size` is the greatest.
    SoftObject(int number, Real size, bool tapers = false);
    // Unlinks the object from all that it is linked to. A link that only the other end holds must be gone before.
    virtual ~SoftObject();
    SoftObject(const SoftObject&) = delete;
    SoftObject& operator=(const SoftObject&) = delete;

    // --- What a primitive gives

    // From the nearest point of the core (placed in the world) to `p`.
    virtual Vector fromCore(const Point& p) const = 0;

    // Roots and seeds in the object's own space, `spacing` units apart on the unblended surface.
    virtual void layOutSeeds(SeedMaker& maker, Real spacing) const = 0;

    // The greatest distance of a point of the core from the centre; 0 says that the core is the centre.
    virtual Real coreReach() const { return Real(0); }

    // Called after the object was moved, turned or scaled: the place to bring the core along. Its measures go with
    // size(), in the proportion that they had when it was made.
    virtual void placeCore() {}

    // Whether the last ring of seeds lies beside the first.
    virtual bool ringsClose() const { return false; }

    // About the radius of curvature of the unblended surface, towards the viewer, where it bends away from him: scales
    // near the edge of the object are cut there. Larger for flat parts.
    virtual Real horizonRadius(const Point& /* eye */) const { return radius_; }
    // The same for the seeds of one root, in the world, given what horizonRadius() said: round ends bend more.
    virtual Real horizonAt(const Point& /* root */, Real general) const { return general; }

    // For objects that taper. The size at the point of the core that is nearest to `p`, units; the distance of a root from
    // the planes that touch the unblended surface where its seeds rest; the field's argument at `p` (see coreParam), with
    // half its gradient times size() squared in `*slope`.
    virtual Real sizeAt(const Point&) const { return size_; }
    virtual Real tangentAt(const Point&) const { return radius_; }
    virtual Real taperedParam(const Point& p, Vector* slope) const { return coreParam(*slope = fromCore(p)); }

    // The object in the words of a dumped frame ("sphere 1 3.25 -4 0 20"), at most `size` bytes with the final 0.
    virtual void describe(char* to, int size) const = 0;

    // --- Seeds

    // Lays the seeds out anew, `spacing` units apart. False when memory or an index does not suffice; the object then
    // keeps the seeds it had.
    bool resample(Real spacing);
    int seeds() const { return regular_; }
    int oversampledSeeds() const { return extra_; }
    // As asked for; scaling makes the seeds lie up to a quarter closer or farther.
    Real spacing() const { return wanted_; }

    // --- Operations (report, Section III: Translation, Rotation, Scaling). Each sets `recalc` here and, where the
    // field of this object reaches them before or after, in its neighbours.

    void translate(const Vector& by);
    void moveTo(const Point& centre) { translate(centre - centre_); }
    // Turns by `angle` about an axis through `about`, which keeps its distance; a zero axis turns nothing.
    void rotate(const Point& about, const Vector& axis, Angle angle);
    // Takes on an orientation, counted from the object's own axes. `turn` is a pure rotation.
    void setTurn(const Matrix& turn);
    // Multiplies size and core. The seeds are laid out anew when their spacing has drifted by more than a quarter from
    // the one asked for (or, without the memory for it, stay as they are, drawn apart).
    // The size is limited to SIZE_LEAST..SIZE_MOST.
    void scale(Real by) { setSize(size_ * by); }
    // The same, by the size to be reached, for what moves by the time and must not depend on the frame before.
    void setSize(Real size);

    const Point& centre() const { return centre_; }
    Real size() const { return size_; }
    Real radius() const { return radius_; }
    const Matrix& turn() const { return turn_; }
    int number() const { return number_; }
    // It looks the same from everywhere.
    bool isBall() const { return !tapers_ && coreReach() == Real(0); }

    // --- The graph

    // Adds a link to `other` in this object's skel, or gives the one there a new weight. False: no memory.
    bool link(SoftObject* other, Real weight);
    // Takes the link out of this object's skel only. Harmless when there is none.
    void unlink(SoftObject* other);
    const List<Link>& skel() const { return skel_; }

    // --- The field

    // Squared distance to the core over squared size, for `v` from fromCore(): 0 at the core, 1 where the field ends;
    // 1 or more everywhere beyond.
    Real coreParam(const Vector& v) const;

    // The same for a point, with half its gradient times size() squared in `*slope`: the vector from the core, unless
    // the object tapers.
    Real param(const Point& p, Vector* slope) const
    {
        if (tapers_)
            return taperedParam(p, slope);
        *slope = fromCore(p);
        return coreParam(*slope);
    }

    // This object's contribution to the implicit function at `p`, 0..1 (the report's fieldFunc).
    Real fieldFunc(const Point& p) const
    {
        Vector slope;
        return geoff(param(p, &slope));
    }

    // The whole sum at `p`, as this object sees it: its own field and its neighbours', weighted.
    Real fieldSum(const Point& p) const;

    // --- A frame

    // Settles the seeds on the surface, if `recalc` says that something changed (report, Section III, update()).
    void update(const Look& look);

    // Lists the voxels of the settled seeds, as many as fit `room` (DRAW_ROOM..VOXELS_AT_ONCE). The list holds until the
    // next call or update(). `*next` is 0 for the first call of a frame; the call changes it, and as long as it is not 0
    // there are more.
    void draw(const Look& look, VoxelList& list, int room, int* next);

    // Something that its seeds rest on has changed: look again.
    void setRecalc() { recalc_ = true; }
    bool recalc() const { return recalc_; }

    // The palette indices of brightness 0..63, and of SHADING_MOST more before and behind (see VoxelList). Not owned.
    void setRamp(const uint8_t* ramp) { ramp_ = ramp; }
    const uint8_t* ramp() const { return ramp_; }

    // Brightness depends on the light; call when it changed.
    void shadeRest(const Vector& light);

    // Seed i of the order in which they lie in memory: regular ones even, the oversampled one of each behind it.
    const Seed& seed(int i) const
    {
        poseAll();
        return seeds_[i];
    }
    int seedSlots() const { return 2 * regular_; }
    Point seedPoint(const Seed& s) const { return roots_[s.root] + s.path * s.position; }

protected:
    // A point of the object's own space in the world.
    Point toWorld(const Vector& v) const { return centre_ + turn_ * v; }

    // "kind number numbers...", for describe().
    void describeAs(const char* kind, const Real* numbers, int count, char* to, int size) const;

private:
    friend class Settler;
    friend class Lister;
    friend class Counter;
    friend class Filler;

    // Most seeds that are judged as one.
    static constexpr int PATCH_SEEDS = 12;

    // A run of seeds of one ring, small enough to be judged as one.
    struct Patch : SeedRun {
        int32_t first;    // index of the first seed / 2
        Real radius;      // of a ball round `middle` that holds the places where they rest
        int16_t axis[3];  // mean direction, unit length = 2^14
        int16_t spread;   // greatest |direction - axis|, the same scale
        int32_t across;   // middle . axis and radius in 1/32 unit
        int32_t radius32;
        uint32_t reached; // which of the neighbours in range reach it, by bits; the last bit stands for all from the 32nd on
        int16_t due;      // up to which travel of the object no further one does, nor its state changes
        int16_t idle;     // up to which travel nothing at all happens to it
        uint8_t state;    // PatchState
        uint8_t stale;    // PatchStale
        uint16_t laid;    // up to which drift_ that holds if it is at rest, and how its seeds at rest lie in the view
    };
    enum PatchState : uint8_t { PATCH_UNKNOWN, PATCH_AT_REST, PATCH_BURIED, PATCH_MIXED };

    // Of seeds that have not been turned and scaled as the object has.
    enum PatchStale : uint8_t { STALE_NONE, STALE_EXTRAS, STALE_ALL };

    // What the report's method keeps of a seed from frame to frame.
    struct Kept {
        Point point;
        Vector normal;
    };

    // A seed as it was laid out, unturned and unscaled: what turned and scaled ones are made from, so that no error adds
    // up however often it is done. Only kept for objects that are no balls, and for those once scaled.
    struct Rest {
        Vector path;
        int8_t along[3], across[3];  // as in Seed
        int16_t normal[3];           // of the surface, unit length = 2^14; only where the object tapers
    };
    struct PatchRest {
        Vector middle, half;
        Real wide;
        Vector axis;
        Real radius;
    };

    void tellNeighbours();
    void linkChanged();
    bool inRange(const SoftObject& other) const;
    void buildPatches();
    void alignPatch(Patch& patch) const;
    static void facePatch(Patch& patch, const Vector& axis);
    bool keepRest();
    Vector restNormal(const Seed& s) const;
    void poseSeeds();
    // A component of a vector of whole numbers, turned.
    template <class T>
    int32_t turnStep(int row, const T v[3]) const
    {
        const int32_t* r = turnSteps_[row];
        return (r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + 8192) >> 14;
    }
    void posePatch(Patch& patch, bool extras) const;
    void poseAll() const;
    void updatePrinted(const Look& look);
    int findNear(Link* near) const;
    void settlePrinted(int i, const Look& look, const Vector& toEye, const Link* near, int nearCount);
    void drawPrinted(const Look& look, VoxelList& list, int room, int* next);
    void updateQuick(const Look& look);
    void drawQuick(const Look& look, VoxelList& list, int room, int* next);
    void freeSeeds();

    int number_;
    Point centre_;
    Matrix turn_;
    Real size_;       // R: where the field ends
    Real radius_;     // R/2: "the distance each seed would be from the center if no blending were taking place"
    Real inverse_;    // 16 / size
    List<Link> skel_;
    bool recalc_;
    bool tapers_;
    bool displaced_;  // some seed is not at rest
    bool restStale_;  // the brightness at rest is that of another turn or size
    Real spacing_;    // of the seeds as they are
    Real wanted_;     // as asked for
    Real laidSize_;   // size when the seeds were laid out
    mutable bool stale_;       // some patch is
    Matrix pose_;              // turn and scale, counted from how the seeds were laid out
    int32_t turnSteps_[3][3];  // the turn alone, 1.0 = 2^14
    Real inverseRadius_;
    Vector light_;             // of shadeRest()
    const uint8_t* ramp_;
    // More than any seed waits.
    static constexpr uint16_t TRAVEL_JUMP = 0x4000;
    // How far the things that its seeds see (neighbours, viewer) have moved against it (Settler::travel()); wraps round. And
    // where the viewer was at the last update, and how fast he is.
    uint16_t travel_;
    bool linksChanged_;
    bool bent_;           // a much smaller object was in range at the last update
    Real turning_;        // by what part of itself the pace of some link changes in an update, at most; 1: anything may happen
    uint32_t nearMark_;   // of the neighbours that were in range then, and their order
    Vector eyeApart_;
    Real eyeSpeed_;
    Real sizeSeen_;
    // How far the viewer has moved against it, 1/64 unit, counted in moves of DRIFT_LEAST or more; wraps round. Where he
    // was at the last of them. And how far he may move until seeds at rest are laid anew: his distance in 1/32 unit over
    // DRIFT_SHARE, a sixteenth of it, which turns what he sees of them by 3.6 degrees at most; but no more than DRIFT_KEPT.
    static constexpr int32_t DRIFT_KEPT = 400;
    static constexpr int32_t DRIFT_SHARE = 8;
    static constexpr int32_t DRIFT_LEAST = 16;
    uint16_t drift_;
    Vector eyeDrawn_;

    Seed* seeds_;
    int regular_;
    int extra_;
    Point* roots_;
    Vector* rootRest_;     // from the centre, as laid out
    int rootCount_;
    Rest* rest_;
    PatchRest* patchRest_;
    Patch* patches_;
    int patchCount_;
    Kept* kept_;           // only with the report's methods
};

#endif
