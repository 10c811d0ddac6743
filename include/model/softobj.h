// SoftObject: a primitive of the model, with the seeds that sample its surface and the list of the objects it blends
// with (report, Section III, Data Structures). A subclass gives the distance to its core and lays out seeds and roots, and
// nothing else; how seeds find the surface is the business of its Surface.
#ifndef FB_SOFTOBJ_H
#define FB_SOFTOBJ_H

#include "math/list.h"
#include "math/vec.h"
#include "model/field.h"
#include "model/seed.h"
#include "model/surface.h"
#include "model/warp.h"

class SoftObject;
struct Paint;

// By how much an object may be stretched along each of its own axes, and how far from its centre what is stretched may reach
// (units, before any scaling).
constexpr Real STRETCH_LEAST(0.25);
constexpr Real STRETCH_MOST(4);
constexpr int STRETCHED_REACH = 100;

// The sizes an object may have (the distance from its core where its field ends), units.
constexpr int MIN_SIZE = 1;
constexpr int MAX_SIZE = 100;

// Core space: the object's own axes with its centre in the origin, scaled so that its size is CORE_SIZE. An object that
// moves, turns or is scaled is always the same there. 16 keeps four more bits of 16.16 than a size of 1 would.
constexpr int CORE_SIZE = 16;

// What an object's field is multiplied by where it stands in any sum.
constexpr Real STRENGTH_LEAST(0.25);
constexpr Real STRENGTH_MOST(4);

// An edge of the model's graph, as one of its two ends sees it: the neighbour, and what its field is multiplied by
// before it is added here (the report's "weighted graph"; 1 is plain blending, 0..4). Of a dent: what it is multiplied by
// before it is taken away.
struct Link {
    SoftObject* object;
    Real weight;

    bool operator==(const Link& other) const { return object == other.object; }
};

class SoftObject {
public:
    // `size` is the distance from the core where the field ends, MIN_SIZE..MAX_SIZE; the caller has checked it.
    // `coreReach`: the greatest distance of a point of the core from the centre, units; 0 says that the core is the
    // centre. `tapers`: the size differs along the core, and `size` is the greatest.
    SoftObject(int number, Real size, Real coreReach = Real(0), bool tapers = false);
    // Unlinks the object from all that it is linked to. A link that only the other end holds must be gone before.
    virtual ~SoftObject();
    SoftObject(const SoftObject&) = delete;
    SoftObject& operator=(const SoftObject&) = delete;

    // --- What a primitive gives

    // From the nearest point of the core to `q`, both in core space.
    virtual Vector fromCore(const Vector& q) const = 0;

    // Squared distance to the core over squared size at `q` (core space): 0 at the core, 1 where the field ends, 1 or more
    // beyond. `*slope` receives half its gradient times CORE_SIZE squared: the vector from the core, unless the object
    // tapers. Of the object as if it were neither stretched nor warped.
    virtual Real plainParam(const Vector& q, Vector* slope) const;

    // How far the core extends along each axis to either side, in core space.
    virtual Vector coreExtent16() const { return {Real(0), Real(0), Real(0)}; }

    // Where the core is a segment along the y axis: half its length in core space. Else 0. It is only a hint: fromCore()
    // would say the same, slower.
    virtual Real segmentHalf16() const { return Real(0); }

    // Roots and seeds in the object's own space, `spacing` units apart on the unblended surface.
    virtual void layOutSeeds(SeedMaker& maker, Real spacing) const = 0;

    // Whether the last ring of seeds lies beside the first.
    virtual bool ringsClose() const { return false; }

    // Whether distances from the core are convex: no less in the middle of a line than at both of its ends is wrong then.
    // True for points, segments and plates, false for circles.
    virtual bool coreConvex() const { return true; }

    // The object in the words of a dumped frame ("sphere 1 3.25 -4 0 20"), at most `size` bytes with the final 0.
    virtual void describe(char* to, int size) const = 0;

    // What its own space has been made of, where that is no plain one ("stretch 1 ..."): SHAPES lines, those for which there
    // is nothing to be said empty.
    static constexpr int SHAPES = 1 + WARP_PARTS;
    void describeShape(int which, char* to, int size) const;

    // --- Seeds

    // Lays the seeds out anew, `spacing` units apart, and makes the surface that will settle them. False: the object keeps
    // what it had, and resampleTrouble() says why, unless it was stopped (model/stop.h).
    // `like` is null, or an object of the same kind, measures, size and strength whose seeds have just been laid out: they are
    // copied.
    bool resample(Real spacing, SurfaceMaker makeSurface, const SoftObject* like = nullptr);
    // Why resample() failed the last time, for any object: one line of words.
    static const char* resampleTrouble();
    // The spacing that its seeds get where `asked` is that of the model: on thin objects they lie closer.
    Real ownSpacing(Real asked) const;
    // How many regular seeds there would be.
    int seedsAt(Real spacing) const;
    int seeds() const { return laid_.regular; }
    int oversampledSeeds() const { return laid_.oversampled; }
    // As asked for; scaling makes the seeds lie up to a quarter closer or farther.
    Real spacing() const { return laid_.spacing; }

    // The seed in slot i: regular ones in even slots, the oversampled one of each in the slot behind it. Regular seeds lie
    // in memory one behind the other; an oversampled one is laid out when it is first asked for.
    Seed& seed(int i) { return i & 1 ? laidExtra(i) : laid_.seeds[i >> 1]; }
    const Seed& seed(int i) const { return const_cast<SoftObject*>(this)->seed(i); }
    // The same, of an even slot.
    const Seed& regular(int i) const { return laid_.seeds[i >> 1]; }
    Seed& regular(int i) { return laid_.seeds[i >> 1]; }
    int seedSlots() const { return 2 * laid_.regular; }
    // The slot of a regular seed.
    int slotOf(const Seed& s) const { return 2 * static_cast<int>(&s - laid_.seeds); }
    // The oversampled seed that belongs to the regular one in slot i, or is in slot i; null: it is not laid out yet.
    Seed* extra(int i) const
    {
        Seed* const block = laid_.extras[i >> (EXTRA_BITS + 1)];
        return block == nullptr ? nullptr : block + (i >> 1 & (EXTRA_BLOCK - 1));
    }
    // Lays the oversampled seed of the regular one in slot i half way between that and another, its neighbour N or one of the
    // same root; its own neighbour says which. True: it was elsewhere.
    bool layOutBetween(int i, int other);
    // The fine seeds that belong to a regular one. Two lie between others, two on the paths of others where these come back.
    enum FineSeed {
        FINE_NEAR,    // half way from the regular seed to its oversampled one
        FINE_FAR,     // half way from that to the neighbour
        FINE_BEHIND,  // behind an overhanging neck, on the path of one of all these
        FINE_ISLAND,  // where the path of the regular one enters an island,
        FINE_ISLAND_END,  // and where it leaves that again
        FINE_SEEDS    // how many there are
    };
    // Those of the regular one in slot i. They lie in memory one behind the other, in that order. Null: there are none yet.
    Seed* fine(int i) const
    {
        Seed* const block = laid_.fine[i >> (EXTRA_BITS + 1)];
        return block == nullptr ? nullptr : block + (i >> 1 & (EXTRA_BLOCK - 1)) * FINE_SEEDS;
    }
    // Makes them, without paths. Null: there is no memory.
    Seed* madeFine(int i);
    // Gives FINE_NEAR or FINE_FAR its path. The two seeds that it lies between have one root.
    void layOutFine(int i, int which);
    // Lays out all oversampled seeds. False: no memory.
    bool layOutExtras();
    const Vector& root(int i) const { return laid_.roots[i]; }
    // Regular seeds are numbered from 0: ring k has those from ringStart(k) to before ringStart(k + 1).
    int rings() const { return laid_.rings; }
    int ringStart(int k) const { return laid_.ringStarts[k]; }
    // A seed's place in the world, as it has settled.
    Point seedPoint(const Seed& s) const { return toWorld(root(s.root) + s.path * s.position); }
    // The outward direction of the unblended surface where a seed rests.
    Direction14 restNormal(const Seed& s) const;

    // --- Operations (report, Section III: Translation, Rotation, Scaling). Each sets `recalc` here and, where the
    // field of this object reaches them before or after, in its neighbours.

    void translate(const Vector& by) { moveTo(centre_ + by); }
    void moveTo(const Point& centre) { place(centre, size_); }
    // Turns by `angle` about an axis through `about`, which keeps its distance; a zero axis turns nothing.
    void rotate(const Point& about, const Vector& axis, Angle angle);
    // Takes on an orientation, counted from the object's own axes. `turn` is a pure rotation.
    void setTurn(const Matrix& turn);
    // Multiplies size and core. The seeds are laid out anew when their spacing has drifted by more than a quarter from
    // the one asked for (or, without the memory for it, stay as they are, drawn apart).
    // The size is limited to MIN_SIZE..MAX_SIZE.
    void scale(Real by) { setSize(size_ * by); }
    // The same, by the size to be reached, for what moves by the time and must not depend on the frame before.
    void setSize(Real size) { place(centre_, size); }
    // Moves and scales it at once, so that its neighbours are told no more often than of one of the two.
    void place(const Point& centre, Real size);
    // Stretches core and field along the object's own axes, each factor STRETCH_LEAST..STRETCH_MOST. To be called before
    // seeds are laid out.
    void setStretch(const Vector& factors);
    // Warps it, as stretched. It counts as warped from then on, whatever the amounts. Without the memory for it the object
    // stays as it was.
    void setWarp(const WarpAmounts& amounts);

    // What the field is multiplied by, STRENGTH_LEAST..STRENGTH_MOST. It decides where seeds rest, so it is given before they
    // are laid out.
    void setStrength(Real strength);
    Real strength() const { return strength_; }
    // param() of the core where seeds rest, a quarter of its squared proportion to the size when that is 1, and its root.
    Real restParam() const { return restParam_; }
    Real restRoot() const { return restRoot_; }
    // Whether the surface lies where seeds rest as long as no neighbour reaches them. Weak objects have none there, or none
    // at all.
    bool rests() const { return rests_; }

    const Point& centre() const { return centre_; }
    Real size() const { return size_; }
    Real radius() const { return radius_; }
    // CORE_SIZE / size.
    Real inverse16() const { return inverse_; }
    // It grows with the size, in the proportion that the object was made with.
    Real coreReach() const { return coreReach_; }
    const Matrix& turn() const { return turn_; }
    int number() const { return number_; }
    // It looks the same from everywhere.
    bool isBall() const { return ball_; }
    bool tapers() const { return tapers_; }
    const Vector& stretch() const { return stretch_; }
    bool stretched() const { return stretched_; }
    bool warped() const { return warped_; }
    const Warp& warp() const { return warp_; }
    // Stretched or warped: paths from one root differ in length.
    bool shaped() const { return shaped_; }
    // Where no path leads square out of the unblended surface.
    bool slants() const { return tapers_ || shaped(); }
    // No distance from the core is less than this share of what it would be in an object that is not shaped.
    Real narrowing() const { return min(stretch_.x, min(stretch_.y, stretch_.z)) * warp_.least(); }
    // The same of distances where the field is steep: it changes by no more than 1.6 of its size over this share of that.
    Real steepest() const { return min(stretch_.x, min(stretch_.y, stretch_.z)) * warp_.leastSteep(); }
    // The greatest distance from the centre at which there may be any field.
    Real reach() const { return reach_; }
    // Whether a place of the world is sure to lie beyond that.
    bool isFar(const Point& p) const
    {
        const Vector v = p - centre_;
        return absolute(v.x) >= reach_ || absolute(v.y) >= reach_ || absolute(v.z) >= reach_;
    }
    // How much larger the object is than when its seeds were laid out: own space to the world.
    Real growth() const { return size_ / laid_.size; }
    Real laidSize() const { return laid_.size; }
    // How long paths were then.
    Real laidRadius() const { return laid_.size * restRoot_; }
    // And reach().
    Real laidReach() const { return shaped() ? reach() / growth() : laid_.size + coreReach_ / growth(); }
    // Where seeds rest is known in whole steps, 16 bits wide: bits of Real below those of a step.
    int placeShift() const { return laid_.placeShift; }
    // Tells a seed its normal where it rests, and that place.
    void layAtRest(Seed& s, const Direction14& normal) const;
    // No path was longer.
    Real longestPath() const { return shaped() ? laidRadius() * mostStretch_ * warp_.most() : laidRadius(); }

    // A place of own space, or one of the world in own axes, as if the object were not stretched; and back. What is square to
    // a surface goes the same way as a place in unstretched(), from there to own space.
    Vector unstretched(const Vector& v) const
    {
        return stretched_ ? Vector{v.x * unstretch_.x, v.y * unstretch_.y, v.z * unstretch_.z} : v;
    }
    Vector stretchedOut(const Vector& v) const
    {
        return stretched_ ? Vector{v.x * stretch_.x, v.y * stretch_.y, v.z * stretch_.z} : v;
    }
    // The same, as far as core space is concerned: what is warped is stretched behind the warp, in param().
    Vector toCoreAxes(const Vector& v) const { return warped_ ? v : unstretched(v); }

    // plainParam() at a place of core space, and half its gradient there times CORE_SIZE squared.
    Real param(const Vector& q, Vector* slope) const { return warped_ ? warpedParam(q, slope) : plainParam(q, slope); }
    // fromCore() at a place of core space.
    Vector awayFromCore(const Vector& q) const;
    // Half the gradient of param() at a place of own space, in own space, times CORE_SIZE and laidSize().
    Vector slopeAt(const Vector& place) const;

    // A point of the object's own space in the world; a vector of the world in the object's own axes, unscaled.
    Point toWorld(const Vector& v) const;
    Vector toOwnAxes(const Vector& v) const { return isBall() ? v : turnedBack(v); }

    // --- The graph

    // Adds a link to `other` in this object's skel, or gives the one there a new weight. False: no memory.
    bool link(SoftObject* other, Real weight);
    // Takes the link out of this object's skel only. Harmless when there is none.
    void unlink(SoftObject* other);
    const List<Link>& skel() const { return skel_; }
    // Lets `other` dig into this object: its field, times a weight of 0 or more, is taken away from this one's sum. Both know
    // of it. False: no memory.
    bool dent(SoftObject* other, Real weight);
    // Fills it again. Harmless when there is none.
    void undent(SoftObject* other);
    // What digs into this object; and what this one digs into.
    const List<Link>& dents() const { return dents_; }
    const List<Link>& digs() const { return digs_; }
    // Whether it has a surface of its own: it blends with another, or digs into none. Weights of 0 count as none.
    bool hasSurface() const;
    // The object whose hollow its seeds sample: the first that it digs into, when it has no surface of its own. Else null.
    const SoftObject* hollowed() const { return hollowLink() == nullptr ? nullptr : hollowLink()->object; }
    // The object whose colour and paint its surface shows: its own, or what its hollow is in. Null: it has no surface.
    const SoftObject* shown() const { return hasSurface() ? this : hollowed(); }
    // Whether its seeds were laid out for a hollow and are for a surface now, or the other way round.
    bool laidInVain() const { return laid_.seeds != nullptr && (hollowed() != nullptr) != laidHollow_; }
    // Where Bodies keeps it.
    int slot() const { return slot_; }
    void setSlot(int slot) { slot_ = slot; }

    // --- The field

    // This object's contribution to the implicit function at `p`, 0..strength() (the report's fieldFunc).
    Real fieldFunc(const Point& p) const;

    // Whether fields of the two can meet anywhere, from centres and sizes alone.
    bool inRange(const SoftObject& other) const { return isNearer(centre_, other.centre_, reach_ + other.reach_); }

    // --- A frame

    // Settles the seeds on the surface, if `recalc` says that something changed (report, Section III, update()).
    void update(const FrameContext& frame);

    // Lists the voxels of the settled seeds; see Surface::draw().
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next);

    // Something that its seeds rest on has changed: look again.
    void setRecalc() { recalc_ = true; }
    bool recalc() const { return recalc_; }
    // Some seed is not at rest; the surface says so.
    void setDisplaced(bool displaced) { displaced_ = displaced; }

    // The palette indices of brightness 0..63, and of SHADING_MOST more before and behind (see VoxelList). Not owned.
    void setRamp(const uint8_t* ramp) { ramp_ = ramp; }
    const uint8_t* ramp() const { return ramp_; }
    // What it shows besides a colour of its own, matt; null: nothing. Not owned.
    void setPaint(const Paint* paint) { paint_ = paint; }
    const Paint* paint() const { return paint_; }

protected:
    // "kind number numbers...", for describe().
    void describeAs(const char* kind, const Real* numbers, int count, char* to, int size) const;

    // The reach of the core in core space.
    Real coreReach16() const { return coreReach16_; }
    // A measure that grows with the size, from what it was when the object was made.
    Real grown(Real made) const { return size_ == sizeMade_ ? made : made * (size_ / sizeMade_); }

    // The object's y axis in the world, which round primitives describe themselves by.
    Vector axis() const { return {turn_.m[0][1], turn_.m[1][1], turn_.m[2][1]}; }

private:
    // Oversampled seeds are laid out this many at a time.
    static constexpr int EXTRA_BITS = 3;
    static constexpr int EXTRA_BLOCK = 1 << EXTRA_BITS;

    // The seeds of an object and what was known when they were laid out.
    struct Layout {
        Seed* seeds = nullptr;           // the regular ones
        Seed** extras = nullptr;         // blocks of oversampled ones; null where none was needed yet
        Seed** fine = nullptr;           // the same of fine ones
        Vector* roots = nullptr;
        int32_t* ringStarts = nullptr;
        int32_t* rootsBetween = nullptr; // of each ring: the first root for oversampled seeds between it and the one before
        int regular = 0, oversampled = 0, rings = 0, rootRoom = 0;
        Real spacing{2};
        Real size{0};                    // of the object
        int placeShift = 8;              // of the places where seeds rest
        // Of a warped object: the regular seeds and the roots as they are without the warp, and as the `border` of those seeds the
        // direction outward where they rest now. Else null.
        Seed* plainSeeds = nullptr;
        Vector* plainRoots = nullptr;

        bool allocated();
        void release();
        int blocks() const { return (regular + EXTRA_BLOCK - 1) >> EXTRA_BITS; }
        Vector rest(const Seed& s) const { return roots[s.root] + s.path; }
        int nearestIn(int ring, int from, const Vector& target) const;
        int nearestBefore(int ring, int seed, int successor, bool closed) const;
        bool rootsDiffer(int ring) const;
        void closeGap(Seed& s, Seed& n) const;
        // The layout as it is without the warp. It shares all that it points at.
        Layout plain() const;
    };

    Vector turnedBack(const Vector& v) const;
    const Link* hollowLink() const;
    void findRest();
    void makeWarp(const WarpAmounts& amounts);
    void setGrown(Real size);
    void tellNeighbours();
    bool layOutRegular(Layout& layout) const;
    bool findNeighbours(Layout& layout) const;
    void findNeighbours(Layout& layout, int ring) const;
    bool layOutLike(const SoftObject& other, Layout& layout) const;
    Seed& laidExtra(int slot);
    Seed* layOutBlock(int block);
    int ringOf(int number) const;
    bool manyRoots() const { return stretched_ && coreReach_ > Real(0); }
    Seed* blockFromOthers();
    static bool isUsed(const Seed* block);
    void layOutExtra(Layout& layout, int number, int ring, Seed& extra) const;
    bool rootBetween(const Layout& layout, const Seed& one, const Seed& other, Vector* root, Vector* out) const;
    Real restLength(const Layout& layout, const Seed& a, const Seed& b) const;
    void measureReach();
    void findSteps();
    Real warpedParam(const Vector& q, Vector* slope) const;
    bool keepPlain(Layout& layout) const;
    void reshape();
    Direction14 warpSeed(const Seed& plain, const Vector& plainRoot, Seed& to, Warp::Way& way) const;
    void warpExtra(const Layout& plain, Seed& s) const;
    Direction14 plainNormal(const Vector& rest, const Vector& path) const;

    int number_;
    Point centre_;
    Matrix turn_;
    Real size_;       // R: where the field ends
    Real radius_;     // R/2: "the distance each seed would be from the center if no blending were taking place"; R restRoot_
    Real inverse_;    // CORE_SIZE / size
    Real coreReach_;
    Vector stretch_, unstretch_;  // factors along the own axes, and one over each
    Real mostStretch_;
    bool stretched_, warped_, shaped_, ball_;
    Real reach_;
    Warp warp_;                   // of core space
    Real sizeMade_, coreReachMade_, coreReach16_;  // as made, so that scaling never adds up errors
    List<Link> skel_, dents_, digs_;
    Real strength_, restParam_, restRoot_;
    bool rests_, laidHollow_;
    int slot_;
    bool recalc_;
    bool tapers_;
    bool displaced_;
    bool unfinished_;  // the surface was not done in the last frame (Surface::update())
    const uint8_t* ramp_;
    const Paint* paint_ = nullptr;

    Layout laid_;
    Surface* surface_;
    SurfaceMaker makeSurface_;
};

#endif
