// Laying out seeds: regular seeds ring by ring as the primitive says, and the neighbour of each (report, Appendix C). How seeds
// move is not known here.
#include "cells.h"
#include "math/alloc.h"
#include "model/stop.h"

namespace {

// An object with a smaller radius than this is thin: it gets as many seeds around it as an object of this radius, though
// at most twice as close. Units.
constexpr Real THIN(4.5);

// The first run of layOutSeeds() counts rings, seeds and roots. Oversampled seeds between two rings with different roots need
// roots of their own: at most `between` in all. `many` means that any two seeds may have a root of their own between them.
class Counter : public SeedMaker {
public:
    explicit Counter(bool many) : many_(many) {}
    int roots = 0, rings = 0, seeds = 0, between = 0;

    int addRoot(const Vector&) override { return roots++; }
    void beginRing() override
    {
        endRing();
        ++rings;
    }
    bool countRing(int count, bool various) override
    {
        seeds += count;
        inRing_ = count;
        various_ = various;
        return true;
    }
    void addSeed(int root, const Vector&, const Vector&, const Vector&) override
    {
        ++seeds;
        ++inRing_;
        various_ |= inRing_ > 1 && root != root_;
        root_ = root;
    }
    void endRing()
    {
        between += many_ || various_ || variousBefore_ ? inRing_ : 1;
        inRing_ = 0;
        variousBefore_ = various_;
        various_ = false;
    }

private:
    const bool many_;
    int inRing_ = 0, root_ = -1;
    bool various_ = false, variousBefore_ = false;  // the seeds of this ring, and of the ring before, have different roots
};

// The second run of layOutSeeds() stores roots, regular seeds, and the first seed of each ring.
class Filler : public SeedMaker {
public:
    Filler(const SoftObject& object, Seed* seeds, Vector* roots, int32_t* ringStarts, Real spacing)
        : object_(object), seeds_(seeds), roots_(roots), ringStarts_(ringStarts), radius_(object.radius()),
          inverseSpacing_(Real(64) / spacing)
    {
    }

    int addRoot(const Vector& fromCentre) override
    {
        roots_[rootCount_] = object_.stretchedOut(fromCentre);
        return rootCount_++;
    }
    void beginRing() override { ringStarts_[rings_++] = count_; }
    void restAt(Real radius) override { radius_ = radius; }
    void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) override
    {
        Seed& s = seeds_[count_++];
        s.path = object_.stretchedOut(direction * radius_);
        s.position = Real(1);
        s.neighbour = s.beyond = -1;
        s.normal = {0, 0, 0};
        s.root = static_cast<uint16_t>(root);
        s.flags = SEED_VALID | SEED_RESTING;
        s.blocker = 0;
        s.lightChange[0] = Seed::LIGHT_UNKNOWN;
        s.lightIsOld = true;
        setAxis(s.along, object_.stretchedOut(along), inverseSpacing_);
        setAxis(s.across, object_.stretchedOut(across), inverseSpacing_);
    }

private:
    const SoftObject& object_;
    Seed* seeds_;
    Vector* roots_;
    int32_t* ringStarts_;
    Real radius_;
    Real inverseSpacing_;
    int rootCount_ = 0, rings_ = 0, count_ = 0;
};

// The reason why the latest failed resample() failed.
char trouble[128];

// Gives the lack of memory as that reason. Returns false.
bool noMemory()
{
    snprintf(trouble, sizeof trouble, "not enough memory for seeds that close");
    return false;
}

}  // namespace

const char* SoftObject::resampleTrouble()
{
    return trouble;
}

bool SoftObject::Layout::allocated()
{
    seeds = allocate<Seed>(static_cast<uint32_t>(regular));
    extras = allocate<Seed*>(static_cast<uint32_t>(2 * blocks()));
    roots = allocate<Vector>(static_cast<uint32_t>(rootRoom));
    ringStarts = allocate<int32_t>(static_cast<uint32_t>(rings + 1));
    rootsBetween = allocate<int32_t>(static_cast<uint32_t>(rings + 1));
    if (extras != nullptr)
        memset(extras, 0, sizeof(Seed*) * static_cast<size_t>(2 * blocks()));
    fine = extras == nullptr ? nullptr : extras + blocks();
    return seeds != nullptr && extras != nullptr && roots != nullptr && ringStarts != nullptr && rootsBetween != nullptr;
}

void SoftObject::Layout::release()
{
    for (int i = 0; extras != nullptr && i < 2 * blocks(); ++i)
        free(extras[i]);
    free(extras);
    free(seeds);
    free(roots);
    free(ringStarts);
    free(rootsBetween);
    free(plainSeeds);
    free(plainRoots);
}

SoftObject::Layout SoftObject::Layout::plain() const
{
    Layout layout = *this;
    if (plainSeeds != nullptr) {
        layout.seeds = plainSeeds;
        layout.roots = plainRoots;
    }
    return layout;
}

// Returns the number of the seed of a ring that is nearest to `target`, walking from seed `from` of that ring (0 is the first)
// in both directions as long as the distance decreases.
int SoftObject::Layout::nearestIn(int ring, int from, const Vector& target) const
{
    const int start = ringStarts[ring], count = ringStarts[ring + 1] - start;
    int n = from;
    Square nearest = squareOf(target - rest(seeds[start + n]));
    for (int step = -1; step <= 1; step += 2) {
        for (;;) {
            const int next = n + step < 0 ? count - 1 : n + step == count ? 0 : n + step;
            const Square d = squareOf(target - rest(seeds[start + next]));
            if (d >= nearest)
                break;
            nearest = d;
            n = next;
        }
    }
    return start + n;
}

// Does the work of nearestIn() where rings leave out seeds (thinning() in round.h): for a seed and its successor in a ring,
// returns the number of the seed nearest to the successor in the closest ring before that has one. The three seeds must lie
// within two spacings of each other; if no ring has such a seed, returns -1.
int SoftObject::Layout::nearestBefore(int ring, int seed, int successor, bool closed) const
{
    constexpr int BACK = 16;
    const Vector place = rest(seeds[seed]), target = rest(seeds[successor]);
    const Real reach = shiftUp(spacing, 1);
    const Square far = squareOf({reach, Real(0), Real(0)});
    if (squareOf(place - target) > far)
        return -1;
    Square nearest = far;
    int n = -1;
    for (int back = 1; back <= BACK && back < rings && n < 0; ++back) {
        if (back > ring && !closed)
            break;
        const int before = (ring + rings - back) % rings;
        for (int j = ringStarts[before]; j < ringStarts[before + 1]; ++j) {
            const Vector &root = roots[seeds[j].root], &path = seeds[j].path;
            if (absolute(target.x - root.x - path.x) >= reach || absolute(target.z - root.z - path.z) >= reach)
                continue;
            const Square d = squareOf(target - rest(seeds[j]));
            if (d < nearest && squareOf(place - rest(seeds[j])) < far) {
                nearest = d;
                n = j;
            }
        }
    }
    return n;
}

// Makes the cells of a seed and of its neighbour meet where the rings between them leave out seeds.
void SoftObject::Layout::closeGap(Seed& s, Seed& n) const
{
    const Vector a = vectorOf(s.across), b = vectorOf(n.across), apart = (rest(n) - rest(s)) * (Real(64) / spacing);
    const Real half = length(a), both = half + length(b);
    if (half < Real(1))
        return;
    const Real gap = absolute(dot(apart, a * (Real(1) / half)));
    if (gap <= both)
        return;
    setAxis(s.across, a, gap / both);
    setAxis(n.across, b, gap / both);
}

// Lays out regular seeds and their roots. Returns false if there is no room for them, or if the user stopped the program.
bool SoftObject::layOutRegular(Layout& layout) const
{
    Counter counter(manyRoots());
    layOutSeeds(counter, layout.spacing);
    counter.endRing();
    // A seed's root index has 16 bits. If there are too many roots between rings for that, some oversampled seeds get none.
    if (counter.roots > ROOTS_MAX) {
        snprintf(trouble, sizeof trouble, "object %d would need %d roots of seeds, and %d is the limit", number_, counter.roots,
                 ROOTS_MAX);
        return false;
    }
    layout.rings = counter.rings;
    layout.regular = counter.seeds;
    layout.rootRoom = counter.roots + counter.between > ROOTS_MAX ? ROOTS_MAX : counter.roots + counter.between;
    if (!layout.allocated())
        return noMemory();
    Filler filler(*this, layout.seeds, layout.roots, layout.ringStarts, layout.spacing);
    layOutSeeds(filler, layout.spacing);
    layout.ringStarts[layout.rings] = layout.regular;
    layout.rootsBetween[0] = counter.roots;
    return !stopAsked();
}

// Returns true if the seeds of a ring have different roots.
bool SoftObject::Layout::rootsDiffer(int ring) const
{
    for (int i = ringStarts[ring] + 1; i < ringStarts[ring + 1]; ++i)
        if (seeds[i].root != seeds[i - 1].root)
            return true;
    return false;
}

// Finds for each regular seed S of ring K "the seed N on ring K-1 that is closest to S's successor" (Appendix C, Figure 9).
void SoftObject::findNeighbours(Layout& layout, int ring) const
{
    const int ringBefore = (ring > 0 ? ring : layout.rings) - 1;
    const int start = layout.ringStarts[ring], end = layout.ringStarts[ring + 1];
    const int inBefore = layout.ringStarts[ringBefore + 1] - layout.ringStarts[ringBefore];
    for (int i = start; i < end; ++i) {
        Seed& s = layout.seeds[i];
        const int successor = i + 1 == end ? start : i + 1;
        const int about = static_cast<int>(static_cast<uint32_t>(successor - start) * static_cast<uint32_t>(inBefore) /
                                           static_cast<uint32_t>(end - start));
        const int n = stretched_ ? layout.nearestBefore(ring, i, successor, ringsClose())
                                 : layout.nearestIn(ringBefore, about, layout.rest(layout.seeds[successor]));
        s.neighbour = n < 0 ? -1 : 2 * n;
        if (stretched_ && n >= 0)
            layout.closeGap(s, layout.seeds[n]);
    }
}

// Finds the neighbours of all seeds, and which root indices the oversampled seeds of each ring may use. Returns false if the
// user stopped the program.
bool SoftObject::findNeighbours(Layout& layout) const
{
    const int firstRing = ringsClose() ? 0 : 1;
    bool differBefore = layout.rings > 0 && layout.rootsDiffer(layout.rings - 1);
    for (int k = 0; k < layout.rings; ++k) {
        const bool differ = layout.rootsDiffer(k);
        const bool many = manyRoots() || differ || differBefore;
        layout.rootsBetween[k + 1] = layout.rootsBetween[k] + (many ? layout.ringStarts[k + 1] - layout.ringStarts[k] : 1);
        differBefore = differ;
        if (stopAsked())
            return false;
        if (k >= firstRing)
            findNeighbours(layout, k);
    }
    return true;
}

// Copies the regular seeds of another object. Returns false when there is no memory.
bool SoftObject::layOutLike(const SoftObject& other, Layout& layout) const
{
    const Layout from = other.laid_.plain();
    layout.rings = from.rings;
    layout.regular = from.regular;
    layout.rootRoom = from.rootRoom;
    if (!layout.allocated())
        return noMemory();
    memcpy(layout.seeds, from.seeds, sizeof(Seed) * static_cast<size_t>(from.regular));
    memcpy(layout.roots, from.roots, sizeof(Vector) * static_cast<size_t>(from.rootRoom));
    memcpy(layout.ringStarts, from.ringStarts, sizeof(int32_t) * static_cast<size_t>(from.rings + 1));
    memcpy(layout.rootsBetween, from.rootsBetween, sizeof(int32_t) * static_cast<size_t>(from.rings + 1));
    return true;
}

// The outward normal of the unblended surface without a warp, at the resting place `rest` of a seed with path `path`.
Direction14 SoftObject::plainNormal(const Vector& rest, const Vector& path) const
{
    Vector slope = path;
    if (tapers_ || stretched_)
        plainParam(unstretched(rest) * (Real(CORE_SIZE) / laid_.size), &slope);
    return direction(unstretched(slope));
}

Direction14 SoftObject::restNormal(const Seed& s) const
{
    if (warped_ && &s >= laid_.seeds && &s < laid_.seeds + laid_.regular)
        return laid_.plainSeeds[&s - laid_.seeds].border;
    const Vector rest = root(s.root) + s.path;
    return warped_ ? direction(slopeAt(rest)) : plainNormal(rest, s.path);
}

// Chooses the step of Seed::place so that 16 bits reach as far as the object, whose reach no seed leaves.
void SoftObject::findSteps()
{
    laid_.placeShift = 8;
    for (int32_t most = rawFromReal(laidReach()) >> 8; most > 32000; most >>= 1)
        ++laid_.placeShift;
}

void SoftObject::layAtRest(Seed& s, const Direction14& normal) const
{
    const Vector rest = root(s.root) + s.path;
    s.normal = normal;
    s.place[0] = static_cast<int16_t>(rawFromReal(rest.x) >> laid_.placeShift);
    s.place[1] = static_cast<int16_t>(rawFromReal(rest.y) >> laid_.placeShift);
    s.place[2] = static_cast<int16_t>(rawFromReal(rest.z) >> laid_.placeShift);
    s.out = static_cast<int16_t>((normal.x * s.place[0] + normal.y * s.place[1] + normal.z * s.place[2]) >> 14);
}

// Lays all regular seeds at rest, where `known` with the normals, ways and areas that they have got from another object.
void SoftObject::layRingsAtRest(bool known)
{
    for (int ring = 0; ring < laid_.rings && !stopAsked(); ++ring)
        for (int i = laid_.ringStarts[ring]; i < laid_.ringStarts[ring + 1]; ++i) {
            Seed& s = laid_.seeds[i];
            layAtRest(s, known ? s.normal : plainNormal(laid_.rest(s), s.path));
            if (known)
                continue;
            // Unless paths slant, a path leads along the normal.
            if (slants())
                setWay(s);
            else
                setWay(s, s.normal);
            setArea(s, s.normal);
        }
}

Real SoftObject::closeness(Real radius) const
{
    return clamp(radius * min(stretch_.x, min(stretch_.y, stretch_.z)) * (Real(1) / THIN), Real(0.5), Real(1));
}

int SoftObject::seedsAt(Real spacing) const
{
    Counter counter(false);
    layOutSeeds(counter, spacing);
    return counter.seeds;
}

bool SoftObject::resample(Real spacing, SurfaceMaker makeSurface, const SoftObject* like)
{
    findRest();
    // (The constructor could not ask the primitive for its core yet.)
    measureExtent();
    Layout layout;
    layout.spacing = spacing;
    layout.size = size_;
    layout.hollow = hollowed() != nullptr;
    if (like != nullptr ? !layOutLike(*like, layout) : !layOutRegular(layout) || !findNeighbours(layout)) {
        layout.release();
        return false;
    }
    for (int i = 0; i < layout.regular; ++i)
        layout.oversampled += layout.seeds[i].neighbour >= 0;

    // The surface is made from the new layout. If there is no memory for it, the old layout is restored.
    Layout before = laid_;
    laid_ = layout;
    findSteps();
    layRingsAtRest(like != nullptr);
    // A ball has no ridges, however far apart its seeds are.
    if (like == nullptr && !isBall())
        laid_.findRidges(tapers_);
    const bool warps = !warped_ || keepPlain(laid_);
    if (warped_ && warps)
        reshape();
    Surface* const surface = !warps || stopAsked() ? nullptr : makeSurface(*this);
    if (surface == nullptr) {
        laid_.release();
        laid_ = before;
        return noMemory();
    }
    before.release();
    destroy(surface_);
    surface_ = surface;
    makeSurface_ = makeSurface;
    displaced_ = false;
    recalc_ = true;
    return true;
}
