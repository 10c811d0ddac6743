// SoftObject: a primitive of the model, with the seeds that sample its surface and the list of the objects it blends with
// (report, Section III, Data Structures). A subclass computes the distance to its core and lays out seeds and roots, nothing
// else. How seeds find the surface is left to the object's Surface.
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

// Limits of the factor by which an object may be stretched along each of its own axes, and the greatest distance from its
// centre that a stretched surface of strength 1 may reach (units, before any scaling).
constexpr Real STRETCH_LEAST(0.25);
constexpr Real STRETCH_MOST(4);
constexpr int STRETCHED_REACH = 100;

// The range of an object's size, which is the distance from its core where its field ends, units.
constexpr int MIN_SIZE = 1;
constexpr int MAX_SIZE = 100;

// Core space: the object's own axes with its centre in the origin, scaled so that its size is CORE_SIZE. Moving, turning or
// scaling an object does not change it there. A size of 16 keeps four more bits of 16.16 than a size of 1 would.
constexpr int CORE_SIZE = 16;

// The range of an object's strength: the factor by which its field is multiplied in every sum.
constexpr Real STRENGTH_LEAST(0.25);
constexpr Real STRENGTH_MOST(4);

// An edge of the model's graph, as seen from one of its two ends: the neighbour, and the factor (0..4, 1 is plain blending) by
// which the neighbour's field is multiplied before it is added at this end (the report's "weighted graph"). A dent is an edge
// too: there the neighbour's field is multiplied by the weight and then subtracted.
struct Link {
    SoftObject* object;
    Real weight;

    bool operator==(const Link& other) const { return object == other.object; }
};

class SoftObject {
public:
    // `size` is the distance from the core where the field ends, MIN_SIZE..MAX_SIZE; the caller has checked it. `coreReach` is
    // the greatest distance of a point of the core from the centre, units; 0 means that the core is the centre point. `tapers`
    // means that the size differs along the core; `size` is then the greatest one.
    SoftObject(int number, Real size, Real coreReach = Real(0), bool tapers = false);
    // Unlinks the object from all objects in its lists. The caller must have removed any link that only the other end holds.
    virtual ~SoftObject();
    SoftObject(const SoftObject&) = delete;
    SoftObject& operator=(const SoftObject&) = delete;

    // --- What each primitive defines

    // The vector from the nearest point of the core to `q`, both in core space.
    virtual Vector fromCore(const Vector& q) const = 0;

    // Squared distance from the core divided by the squared size at `q` (core space): 0 on the core, 1 where the field ends, 1
    // or more beyond. `*slope` receives half the gradient of that value times CORE_SIZE squared, which is the vector from the
    // core unless the object tapers; where the value is 1 or more it receives any vector. Stretch and warp are left out of account.
    virtual Real plainParam(const Vector& q, Vector* slope) const;

    // Half extent of the core along each axis, or more, in core space.
    virtual Vector coreExtent16() const { return {coreReach16_, coreReach16_, coreReach16_}; }

    // Half the length of the core in core space if the core is a segment along the y axis, else 0. This is only a hint for
    // speed: fromCore() gives the same answer more slowly.
    virtual Real segmentHalf16() const { return Real(0); }

    // Lays out roots and seeds in the object's own space, `spacing` units apart on the unblended surface.
    virtual void layOutSeeds(SeedMaker& maker, Real spacing) const = 0;

    // Returns true if the last ring of seeds lies beside the first.
    virtual bool ringsClose() const { return false; }

    // Writes the object as a line of a dumped frame ("sphere 1 3.25 -4 0 20"), at most `size` bytes with the final 0.
    virtual void describe(char* to, int size) const = 0;

    // Writes line `which` (0..SHAPES - 1) of the description of the stretch and the warp ("stretch 1 ..."), at most `size`
    // bytes with the final 0. The text is empty where the object has no such stretch, taper, twist or bend.
    static constexpr int SHAPES = 1 + WARP_PARTS;
    void describeShape(int which, char* to, int size) const;

    // --- Seeds

    // Lays the seeds out anew, `spacing` units apart, and makes the surface that will settle them. Returns false on failure:
    // the object then keeps its old seeds, and resampleTrouble() says why, unless the user stopped the program (model/stop.h).
    // `like` is null, or an object of the same kind, measures, size and strength whose seeds have just been laid out; its seeds
    // are copied then.
    bool resample(Real spacing, SurfaceMaker makeSurface, const SoftObject* like = nullptr);
    // The reason why the latest failed resample(), of any object, failed: one line of words.
    static const char* resampleTrouble();
    // The spacing of this object's seeds when `asked` is the spacing of the model: thin and flat objects get closer seeds, at most
    // twice as close. closeness() is the factor where the surface is `radius` units away from the core, 0.5 to 1.
    Real ownSpacing(Real asked) const { return asked * closeness(radius_); }
    Real closeness(Real radius) const;
    // The number of regular seeds that this spacing would give.
    int seedsAt(Real spacing) const;
    int seeds() const { return laid_.regular; }
    int oversampledSeeds() const { return laid_.oversampled; }
    // The spacing that was asked for. Scaling the object makes the actual one up to a quarter smaller or larger.
    Real spacing() const { return laid_.spacing; }

    // The seed in slot i: regular seeds have even slots, and the oversampled seed of each has the slot after it. Regular seeds
    // are contiguous in memory; an oversampled seed is laid out when it is first asked for.
    Seed& seed(int i) { return i & 1 ? laidExtra(i) : laid_.seeds[i >> 1]; }
    const Seed& seed(int i) const { return const_cast<SoftObject*>(this)->seed(i); }
    // Like seed(), for an even slot only.
    const Seed& regular(int i) const { return laid_.seeds[i >> 1]; }
    Seed& regular(int i) { return laid_.seeds[i >> 1]; }
    int seedSlots() const { return 2 * laid_.regular; }
    // The slot of a regular seed.
    int slotOf(const Seed& s) const { return 2 * static_cast<int>(&s - laid_.seeds); }
    // The oversampled seed that belongs to the regular seed in slot i, or is itself in slot i. Null if it is not laid out yet.
    Seed* extra(int i) const
    {
        Seed* const block = laid_.extras[i >> (EXTRA_BITS + 1)];
        return block == nullptr ? nullptr : block + (i >> 1 & (EXTRA_BLOCK - 1));
    }
    // Lays the oversampled seed of the regular seed in slot i half way between that seed and the one in slot `other`, which is
    // its neighbour N or has the same root. The oversampled seed's `neighbour` records `other`. Returns true if it lay
    // elsewhere before.
    bool layOutBetween(int i, int other);
    // The fine seeds that belong to a regular seed: two half way between others; two on a wall, the surface between two seeds whose
    // positions lie far apart (along which paths run); and those on paths that meet the surface again.
    enum FineSeed {
        FINE_NEAR,    // half way from the regular seed to its oversampled seed
        FINE_FAR,     // half way from the oversampled seed to the neighbour
        FINE_LOWER,   // at two heights of one wall between these seeds
        FINE_UPPER,
        FINE_ISLAND,  // where the path of the regular seed enters an island,
        FINE_ISLAND_END,  // and where it leaves that island again
        FINE_SEEDS    // number of fine seeds
    };
    // The FINE_SEEDS fine seeds of the regular seed in slot i, contiguous and in the order of FineSeed. Null if not made yet.
    Seed* fine(int i) const
    {
        Seed* const block = laid_.fine[i >> (EXTRA_BITS + 1)];
        return block == nullptr ? nullptr : block + (i >> 1 & (EXTRA_BLOCK - 1)) * FINE_SEEDS;
    }
    // Makes the fine seeds of slot i, without paths. Returns null when there is no memory.
    Seed* madeFine(int i);
    // Sets the path of FINE_NEAR or FINE_FAR. The two seeds that the fine seed lies between must share one root.
    void layOutFine(int i, int which);
    // Gives a seed a path between those of two seeds: at `position` it passes the fraction `share` of the way from the first to the
    // second. It begins in the root of the nearer one.
    void layBetween(Seed& s, const Seed& a, const Seed& b, Real position, Real share) const;
    // Lays out all oversampled seeds. Returns false when there is no memory.
    bool layOutExtras();
    const Vector& root(int i) const { return laid_.roots[i]; }
    // Regular seeds are numbered from 0: ring k has the half-open range ringStart(k) to ringStart(k + 1).
    int rings() const { return laid_.rings; }
    int ringStart(int k) const { return laid_.ringStarts[k]; }
    // A settled seed's place in the world.
    Point seedPoint(const Seed& s) const { return toWorld(root(s.root) + s.path * s.position); }
    // The outward normal of the unblended surface at a seed's resting place.
    Direction14 restNormal(const Seed& s) const;

    // --- Operations (report, Section III: Translation, Rotation, Scaling). What places, turns or warps the object sets `recalc` in
    // it and in those neighbours that its field reaches before or after the change; where some of its seeds are not at rest, in all
    // that it is linked with. A turn of a ball is felt by no neighbour, nor by itself unless its seeds turn with it. setStretch()
    // and setStrength(), which come before the seeds are laid out, tell no neighbour.

    void translate(const Vector& by) { moveTo(centre_ + by); }
    void moveTo(const Point& centre) { place(centre, size_); }
    // Turns by `angle` about an axis through `about`, keeping the distance from that point. A zero axis turns nothing.
    void rotate(const Point& about, const Vector& axis, Angle angle);
    // Sets the orientation relative to the object's own axes. `turn` is a pure rotation.
    void setTurn(const Matrix& turn);
    // Multiplies size and core; the size is clamped to MIN_SIZE..MAX_SIZE. When the actual spacing has drifted by more than a
    // quarter from the one asked for, the seeds are laid out anew; without the memory for that they are kept as they are.
    void scale(Real by) { setSize(size_ * by); }
    // Like scale(), but sets the size itself: motion that depends on time alone must not depend on the previous frame.
    void setSize(Real size) { place(centre_, size); }
    // Moves and scales in one step, so that the neighbours are told only once.
    void place(const Point& centre, Real size);
    // Stretches core and field along the object's own axes by factors STRETCH_LEAST..STRETCH_MOST. Call it before seeds are
    // laid out.
    void setStretch(const Vector& factors);
    // Warps the stretched object. It counts as warped from then on, even with amounts of 0. Without the memory for it the
    // object is left unchanged.
    void setWarp(const WarpAmounts& amounts);

    // The factor by which the field is multiplied, clamped to STRENGTH_LEAST..STRENGTH_MOST. It decides where seeds rest, so
    // set it before they are laid out.
    void setStrength(Real strength);
    Real strength() const { return strength_; }
    // Seeds rest where param() has the value restParam(): a quarter for strength 1. restRoot() is its square root: the distance
    // of a resting seed from the core divided by the size.
    Real restParam() const { return restParam_; }
    Real restRoot() const { return restRoot_; }
    // Returns true if the surface lies where seeds rest as long as no neighbour reaches them. A weak object's own field may
    // reach the isovalue nearer to the core, or nowhere; the result is false then, and also for the seeds of a hollow.
    bool rests() const { return rests_; }

    const Point& centre() const { return centre_; }
    Real size() const { return size_; }
    Real radius() const { return radius_; }
    // CORE_SIZE / size.
    Real inverse16() const { return inverse_; }
    // Greatest distance of a point of the core from the centre. It grows in proportion to the size.
    Real coreReach() const { return coreReach_; }
    const Matrix& turn() const { return turn_; }
    int number() const { return number_; }
    // Returns true if the object looks the same from everywhere.
    bool isBall() const { return ball_; }
    // Returns true if the object's seeds, and its own axes, turn with it. The own axes of a ball are those of the world unless it
    // rides.
    bool turnsSeeds() const { return !ball_ || rides_; }
    // A ball that rides turns its seeds with it, so that they keep their places beside neighbours that turn about the same centre
    // as it does. It is the same ball, sampled at other places.
    void setRides(bool rides) { rides_ = rides; }
    bool tapers() const { return tapers_; }
    const Vector& stretch() const { return stretch_; }
    bool stretched() const { return stretched_; }
    bool warped() const { return warped_; }
    const Warp& warp() const { return warp_; }
    // Returns true if the object is stretched or warped; paths from one root then differ in length.
    bool shaped() const { return shaped_; }
    // Returns true if paths do not, in general, lead along the normal of the unblended surface.
    bool slants() const { return tapers_ || shaped(); }
    // Lower bound of the ratio between a distance from the core and the same distance in the object without stretch and warp.
    Real narrowing() const { return min(stretch_.x, min(stretch_.y, stretch_.z)) * warp_.least(); }
    // Like narrowing(), for the part of the field that is steep: over a distance of steepest() times the size the field changes
    // by at most 1.6 times the strength.
    Real steepest() const { return min(stretch_.x, min(stretch_.y, stretch_.z)) * warp_.leastSteep(); }
    // Upper bound of the distance from the centre at which there is any field.
    Real reach() const { return reach_; }
    // Returns true if a point lies outside the box of extent_, by `more` units or more along some axis of the world. Then there is
    // no field. (False says nothing.)
    bool isFar(const Point& p, Real more = Real(0)) const
    {
        return absolute(p.x - centre_.x) >= extent_.x + more || absolute(p.y - centre_.y) >= extent_.y + more ||
               absolute(p.z - centre_.z) >= extent_.z + more;
    }
    // The factor by which the object has grown since its seeds were laid out: it scales own space to the world.
    Real growth() const { return size_ / laid_.size; }
    Real laidSize() const { return laid_.size; }
    // Length of the paths of an object without stretch and warp, in own space.
    Real laidRadius() const { return laid_.size * restRoot_; }
    // reach() as a length of own space, whose scale is that of the time when the seeds were laid out.
    Real laidReach() const { return shaped() ? reach() / growth() : laid_.size + coreReach_ / growth(); }
    // Resting places are stored in 16 bits (Seed::place): the number of low bits of a 16.16 number that are dropped.
    int placeShift() const { return laid_.placeShift; }
    // Stores in a seed its normal at rest and its resting place.
    void layAtRest(Seed& s, const Direction14& normal) const;
    // Upper bound of the length of a path.
    Real longestPath() const { return warped_ ? laid_.longest : laidRadius() * mostStretch_; }

    // unstretched() takes a vector of own space, or one of the world in own axes, to where it would be without the stretch;
    // stretchedOut() takes it back. A normal of the unstretched surface becomes one of own space by unstretched() as well.
    Vector unstretched(const Vector& v) const
    {
        return stretched_ ? Vector{v.x * unstretch_.x, v.y * unstretch_.y, v.z * unstretch_.z} : v;
    }
    Vector stretchedOut(const Vector& v) const
    {
        return stretched_ ? Vector{v.x * stretch_.x, v.y * stretch_.y, v.z * stretch_.z} : v;
    }
    // The same for vectors on their way to core space: a warped object is left stretched here, because param() undoes the warp
    // first.
    Vector toCoreAxes(const Vector& v) const { return warped_ ? v : unstretched(v); }

    // plainParam() of the object as shaped, at a point of core space, and half its gradient there times CORE_SIZE squared.
    Real param(const Vector& q, Vector* slope) const { return warped_ ? warpedParam(q, slope) : plainParam(q, slope); }
    // fromCore() of the object as shaped, at a point of core space.
    Vector awayFromCore(const Vector& q) const;
    // Half the gradient of param() at a point of own space, in own space, times CORE_SIZE and laidSize().
    Vector slopeAt(const Vector& place) const;

    // toWorld() takes a point of own space to the world; toOwnAxes() turns a vector of the world into own axes, without
    // scaling.
    Point toWorld(const Vector& v) const;
    Vector toOwnAxes(const Vector& v) const { return turnsSeeds() ? turnedBack(turn_, v) : v; }

    // --- The graph

    // Adds a link to `other` to this object's skel, or changes its weight. Returns false when there is no memory.
    bool link(SoftObject* other, Real weight);
    // Removes the link from this object's skel only. Without such a link it does nothing.
    void unlink(SoftObject* other);
    const List<Link>& skel() const { return skel_; }
    // Lets `other` dig into this object: its field times `weight` (0 or more) is subtracted from this object's sum. Both
    // objects record it. Returns false when there is no memory.
    bool dent(SoftObject* other, Real weight);
    // Ends the digging of `other`. Without such a dent it does nothing.
    void undent(SoftObject* other);
    // dents(): the objects that dig into this one; digs(): the objects that this one digs into.
    const List<Link>& dents() const { return dents_; }
    const List<Link>& digs() const { return digs_; }
    // Returns true if the object has a surface of its own: it blends with another or digs into none. Weights of 0 do not count.
    bool hasSurface() const;
    // The object whose hollow this object's seeds sample: of those it digs into, the one in which its middle lies deepest, or which
    // is the nearest to it, if this object has no surface of its own. Else null.
    const SoftObject* hollowed() const { return hollowLink() == nullptr ? nullptr : hollowLink()->object; }
    // The object whose colour and paint this surface shows: itself, or the one with the hollow. Null if there is no surface.
    const SoftObject* shown() const { return hasSurface() ? this : hollowed(); }
    // Returns true if the seeds were laid out for a hollow but are now needed for a surface, or the other way round.
    bool laidInVain() const { return laid_.seeds != nullptr && (hollowed() != nullptr) != laid_.hollow; }
    // The object's index in Bodies.
    int slot() const { return slot_; }
    void setSlot(int slot) { slot_ = slot; }

    // --- The field

    // A place in the field of an object: param() there and half its gradient, times CORE_SIZE^2, in core axes (of a ball, in the
    // axes of the world) and core space.
    struct FieldPlace {
        Real param;
        Vector slope;
    };
    // This object's contribution to the implicit function at `p`, 0..strength() (the report's fieldFunc).
    Real fieldFunc(const Point& p) const
    {
        FieldPlace place;
        return isFar(p) ? Real(0) : fieldNear(p, &place);
    }
    // The same at a point that is not far (isFar()): the place of one that is far, relative to a small object, would overflow
    // 16.16. Where the field is above 0, `*place` receives what gradientAt() needs.
    Real fieldNear(const Point& p, FieldPlace* place) const;
    // The gradient of that field in the world, 1/unit, times CORE_SIZE; at a place where the field is above 0.
    Vector gradientAt(const FieldPlace& place) const;

    // Returns true if the fields of the two objects can overlap, judging by centres and reaches alone.
    bool inRange(const SoftObject& other) const { return isNearer(centre_, other.centre_, reach_ + other.reach_); }

    // --- A frame

    // Settles the seeds on the surface, if `recalc` says that something has changed (report, Section III, update()).
    void update(const FrameContext& frame);

    // Lists the voxels of the settled seeds; see Surface::draw().
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next);

    // Marks that something the seeds depend on has changed, so that the next update() looks at them again.
    void setRecalc() { recalc_ = true; }
    bool recalc() const { return recalc_; }
    // The surface records here whether some seed is not at rest.
    void setDisplaced(bool displaced) { displaced_ = displaced; }

    // The palette indices of brightness 0..63, with SHADING_MOST more before and after them (see VoxelList). Not owned.
    void setRamp(const uint8_t* ramp) { ramp_ = ramp; }
    const uint8_t* ramp() const { return ramp_; }
    // What the object shows besides a matt colour of its own; null if nothing. Not owned.
    void setPaint(const Paint* paint) { paint_ = paint; }
    const Paint* paint() const { return paint_; }

protected:
    // plainParam() for a vector from the core, in core space.
    static Real paramOf(const Vector& v)
    {
        // First exclude what is far away: beyond this box the squares would overflow 16.16, and the field is 0 anyway.
        const Real end(CORE_SIZE);
        if (absolute(v.x) >= end || absolute(v.y) >= end || absolute(v.z) >= end)
            return Real(1);
        return shiftDown(dot(v, v), 8);
    }
    // plainParam() of a core that lies in the plane y = 0. fromCore() returns the vector to `q` from the core's nearest point. Far
    // above or below the core it need not be known how far that lies aside.
    template <class FromCore>
    static Real flatParam(const Vector& q, Vector* slope, FromCore fromCore)
    {
        const bool isFar = absolute(q.y) >= Real(CORE_SIZE);
        *slope = isFar ? q : fromCore();
        return isFar ? Real(1) : paramOf(*slope);
    }

    // Writes "kind number numbers...", for describe().
    void describeAs(const char* kind, const Real* numbers, int count, char* to, int size) const;

    // coreReach() in core space.
    Real coreReach16() const { return coreReach16_; }
    // Scales a measure `made` from the time when the object was made by the object's growth since then.
    Real grown(Real made) const { return size_ == sizeMade_ ? made : made * (size_ / sizeMade_); }

    // The object's y axis in the world; round primitives write it in describe().
    Vector axis() const { return {turn_.m[0][1], turn_.m[1][1], turn_.m[2][1]}; }

private:
    // Number of oversampled seeds laid out at a time (a block).
    static constexpr int EXTRA_BITS = 3;
    static constexpr int EXTRA_BLOCK = 1 << EXTRA_BITS;

    // The seeds of an object, and the values that held when they were laid out.
    struct Layout {
        Seed* seeds = nullptr;           // the regular seeds
        Seed** extras = nullptr;         // blocks of oversampled seeds; null where none was needed yet
        Seed** fine = nullptr;           // blocks of fine seeds, likewise
        Vector* roots = nullptr;
        int32_t* ringStarts = nullptr;
        int32_t* rootsBetween = nullptr; // of each ring: first root for oversampled seeds between this ring and the one before
        int regular = 0, oversampled = 0, rings = 0, rootRoom = 0;
        Real spacing{2};
        Real size{0};                    // size of the object then
        bool hollow = false;             // the seeds were laid out for the hollow of another object
        int placeShift = 8;              // SoftObject::placeShift()
        Real longest{0};                 // of a warped object: SoftObject::longestPath()
        // For a warped object: the regular seeds and the roots as they would be without the warp (`border` of these seeds holds
        // the outward normal where the warped seed rests now). Else null.
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
        Real behind(const Seed& s, const Seed& other) const;
        void noteBeyond(Seed& s, int other) const;
        bool bendSharply(const Seed& a, const Seed& b, bool tapers) const;
        void noteRidge(int one, int other, bool tapers) const;
        void findRidges(bool tapers) const;
        // The layout as it would be without the warp. It shares all memory with this one.
        Layout plain() const;
    };

    Real paramAt(const Vector& v, Vector* slope) const;
    const Link* hollowLink() const;
    Real depthIn(const SoftObject& other) const;
    void findRest();
    void makeWarp(const WarpAmounts& amounts);
    void setGrown(Real size);
    // Tells the neighbours at its old place, where it had another reach, and at the new one.
    void tellNeighbours(const Point& before, Real reachBefore);
    void tellNeighbours() { tellNeighbours(centre_, reach_); }
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
    void measureExtent();
    void findSteps();
    void layRingsAtRest(bool known);
    Real warpedParam(const Vector& q, Vector* slope) const;
    bool keepPlain(Layout& layout) const;
    void reshape();
    Direction14 warpSeed(const Seed& plain, const Vector& plainRoot, Seed& to, Warp::Way& way) const;
    void warpExtra(const Layout& plain, Seed& s) const;
    Direction14 plainNormal(const Vector& rest, const Vector& path) const;

    int number_;
    Point centre_;
    Matrix turn_;
    Real size_;       // R: distance from the core where the field ends
    Real radius_;     // usually R/2: "the distance each seed would be from the center if no blending were taking place"
    Real inverse_;    // CORE_SIZE / size
    Real coreReach_;
    Vector stretch_, unstretch_;  // factors along the own axes, and their reciprocals
    Real mostStretch_;
    bool stretched_, warped_, shaped_, ball_, rides_ = false;
    Real reach_;
    Vector extent_;   // half extents of a box about the centre, along the axes of the world, units: there is no field outside
    Warp warp_;                   // in core space
    Real sizeMade_, coreReachMade_, coreReach16_;  // measures when made, so that repeated scaling adds up no errors
    List<Link> skel_, dents_, digs_;
    Real strength_, restParam_, restRoot_;
    bool rests_;
    int slot_;
    bool recalc_;
    bool tapers_;
    bool displaced_;
    bool unfinished_;  // Surface::update() returned true in the last frame: it was not done
    const uint8_t* ramp_;
    const Paint* paint_ = nullptr;

    Layout laid_;
    Surface* surface_;
    SurfaceMaker makeSurface_;
};

#endif
