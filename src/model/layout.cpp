// Laying out seeds: regular ones ring by ring as the primitive says, and an oversampled one beside each (report, Appendix C).
#include "math/alloc.h"
#include "math/normal.h"
#include "model/softobj.h"

namespace {

// The cell of an oversampled seed, which lies between seeds that have cells of their own: in eighths of theirs.
constexpr int EXTRA_CELL = 5;

// Roots that a seed's 16 bits can tell apart.
constexpr int ROOTS_MAX = UINT16_MAX + 1;

int8_t toCell(int32_t steps)
{
    return static_cast<int8_t>(steps > 127 ? 127 : steps < -127 ? -127 : steps);
}

// Half axes of a seed's cell in 1/64 spacing; `inverse` is 64 / spacing.
void setCell(int8_t* to, const Vector& half, Real inverse)
{
    const Real parts[] = {half.x, half.y, half.z};
    for (int i = 0; i < 3; ++i)
        to[i] = toCell(floorToInt(parts[i] * inverse + Real(0.5)));
}

int64_t squaredDistance(const Vector& a, const Vector& b)
{
    const int64_t x = rawFromReal(a.x) - rawFromReal(b.x);
    const int64_t y = rawFromReal(a.y) - rawFromReal(b.y);
    const int64_t z = rawFromReal(a.z) - rawFromReal(b.z);
    return x * x + y * y + z * z;
}

// First run of layOutSeeds(): how much of everything there is. Between two rings with different roots lie oversampled
// seeds with roots between: `between` of them at most.
class Counter : public SeedMaker {
public:
    int roots = 0, rings = 0, seeds = 0, between = 0;

    int addRoot(const Vector&) override { return roots++; }
    void beginRing() override
    {
        endRing();
        ++rings;
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
        between += various_ || variousBefore_ ? inRing_ : 1;
        inRing_ = 0;
        variousBefore_ = various_;
        various_ = false;
    }

private:
    int inRing_ = 0, root_ = -1;
    bool various_ = false, variousBefore_ = false;  // this ring's seeds have different roots; those of the one before
};

// Second run: writes roots and regular seeds, and where each ring starts.
class Filler : public SeedMaker {
public:
    Filler(Seed* seeds, Vector* roots, int32_t* ringStarts, Real radius, Real spacing)
        : seeds_(seeds), roots_(roots), ringStarts_(ringStarts), radius_(radius), inverseSpacing_(Real(64) / spacing)
    {
    }

    int addRoot(const Vector& fromCentre) override
    {
        roots_[rootCount_] = fromCentre;
        return rootCount_++;
    }
    void beginRing() override { ringStarts_[rings_++] = count_; }
    void restAt(Real radius) override { radius_ = radius; }
    void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) override
    {
        Seed& s = seeds_[2 * count_++];
        s.path = direction * radius_;
        s.position = Real(1);
        s.neighbour = -1;
        s.normal = {0, 0, 0};
        s.root = static_cast<uint16_t>(root);
        s.flags = SEED_VALID | SEED_RESTING;
        s.aside = 0;
        s.still = 0;
        s.cellArea = 0;
        setCell(s.along, along, inverseSpacing_);
        setCell(s.across, across, inverseSpacing_);
    }

private:
    Seed* seeds_;
    Vector* roots_;
    int32_t* ringStarts_;
    Real radius_;
    Real inverseSpacing_;
    int rootCount_ = 0, rings_ = 0, count_ = 0;
};

}  // namespace

// The arrays while they are made.
struct SoftObject::Layout {
    Seed* seeds = nullptr;
    Vector* roots = nullptr;
    int32_t* ringStarts = nullptr;
    int rootCount = 0, rings = 0;
    // The last pair of roots that a root between was made for.
    int pairS = -1, pairN = -1, pairRoot = 0;

    bool allocated(int regular, int rootRoom)
    {
        seeds = allocate<Seed>(static_cast<uint32_t>(2 * regular));
        roots = allocate<Vector>(static_cast<uint32_t>(rootRoom));
        ringStarts = allocate<int32_t>(static_cast<uint32_t>(rings + 1));
        return seeds != nullptr && roots != nullptr && ringStarts != nullptr;
    }
    void release()
    {
        free(seeds);
        free(roots);
        free(ringStarts);
    }
    Vector rest(const Seed& s) const { return roots[s.root] + s.path; }
    // How far N lies from S along S's ring, in 1/64 of the way from S to its successor.
    int8_t asideOf(const Seed& s, const Seed& n) const
    {
        const Vector way = rest(n) - rest(s);
        int32_t square = 0, part = 0;
        for (int i = 0; i < 3; ++i)
            square += s.along[i] * s.along[i];
        const Real ways[] = {way.x, way.y, way.z};
        for (int i = 0; i < 3; ++i)
            part += (rawFromReal(ways[i]) >> 8) * s.along[i];
        // `along` is half of the way, in 1/64 spacing; `part` has 256 steps a unit.
        return square == 0 ? static_cast<int8_t>(0) : toCell(mulDiv(part, rawFromReal(perSpacing), square * 8192));
    }
    Real perSpacing{1};  // 1 / spacing

    // Of ring `before`, the seed nearest to `target`; found by walking from number `from` of that ring.
    int nearestIn(int ring, int from, const Vector& target) const
    {
        const int start = ringStarts[ring], count = ringStarts[ring + 1] - start;
        int n = from;
        int64_t nearest = squaredDistance(target, rest(seeds[2 * (start + n)]));
        for (int step = -1; step <= 1; step += 2) {
            for (;;) {
                const int next = (n + step + count) % count;
                const int64_t d = squaredDistance(target, rest(seeds[2 * (start + next)]));
                if (d >= nearest)
                    break;
                nearest = d;
                n = next;
            }
        }
        return start + n;
    }
};

// The oversampled seed of S: half way to its neighbour N, "the seed N on ring K-1 that is closest to S's successor"
// (Appendix C, Figure 9). It lies in memory behind S.
void SoftObject::addOversampled(Layout& layout, int rootRoom) const
{
    const int firstRing = ringsClose() ? 0 : 1;
    for (int k = 0; k < layout.rings; ++k) {
        const int ringBefore = (k > 0 ? k : layout.rings) - 1;
        const int start = layout.ringStarts[k], end = layout.ringStarts[k + 1], inRing = end - start;
        const int inBefore = layout.ringStarts[ringBefore + 1] - layout.ringStarts[ringBefore];
        for (int i = start; i < end; ++i) {
            Seed& s = layout.seeds[2 * i];
            Seed& extra = layout.seeds[2 * i + 1];
            extra = s;
            extra.flags = 0;
            if (k < firstRing)
                continue;
            const int successor = i + 1 == end ? start : i + 1;
            const int about = static_cast<int>(static_cast<uint32_t>(successor - start) * static_cast<uint32_t>(inBefore) /
                                               static_cast<uint32_t>(inRing));
            const int n = layout.nearestIn(ringBefore, about, layout.rest(layout.seeds[2 * successor]));
            s.neighbour = extra.neighbour = 2 * n;
            s.aside = extra.aside = layout.asideOf(s, layout.seeds[2 * n]);
            oversample(layout, 2 * i, 2 * n, rootRoom);
        }
    }
}

// How long the path of a seed between two is.
Real SoftObject::restLength(const Seed& a, const Seed& b) const
{
    return tapers_ ? shiftDown(length(a.path) + length(b.path), 1) : radius_;
}

// Places the seed between seeds s and n, behind s. False: it stays a copy of s, for lack of a root or of a direction.
bool SoftObject::oversample(Layout& layout, int s, int n, int rootRoom) const
{
    const Seed &one = layout.seeds[s], &other = layout.seeds[n];
    Seed& extra = layout.seeds[s + 1];
    if (one.root == other.root) {
        extra.path = withLength(one.path + other.path, restLength(one, other));
    } else {
        // Above the point of the core that is nearest to the middle of the two.
        const Vector middle = (layout.rest(one) + layout.rest(other)) * Real(0.5);
        const Vector out = fromCore(middle * inverse_) * shiftDown(size_, 4);
        const bool known = layout.pairS == one.root && layout.pairN == other.root;
        if (length(out) < shiftDown(radius_, 3) || (!known && layout.rootCount == rootRoom))
            return false;
        if (!known) {
            layout.pairS = one.root;
            layout.pairN = other.root;
            layout.pairRoot = layout.rootCount++;
            layout.roots[layout.pairRoot] = middle - out;
        }
        extra.root = static_cast<uint16_t>(layout.pairRoot);
        extra.path = withLength(out, restLength(one, other));
    }
    if (tapers_) {
        // The mean of two lengths is near: to where the field is that of the surface.
        Vector unused;
        const Real t = param((layout.roots[extra.root] + extra.path) * inverse_, &unused);
        extra.path = extra.path * (Real(0.5) / squareRoot(t));
    }
    for (int part = 0; part < 3; ++part) {
        extra.along[part] = static_cast<int8_t>(one.along[part] * EXTRA_CELL / 8);
        extra.across[part] = static_cast<int8_t>(one.across[part] * EXTRA_CELL / 8);
    }
    return true;
}

Direction14 SoftObject::restNormal(const Seed& s) const
{
    Vector slope = s.path;
    if (tapers_)
        param((roots_[s.root] + s.path) * (Real(CORE_SIZE) / laidSize_), &slope);
    const Normal n = normalise(slope);
    return {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

bool SoftObject::resample(Real spacing, SurfaceMaker makeSurface)
{
    Counter counter;
    layOutSeeds(counter, spacing);
    counter.endRing();
    // A seed's root has 16 bits. When roots between rings are too many for them, some oversampled seeds do without.
    if (counter.roots > ROOTS_MAX)
        return false;
    const int rootRoom = counter.roots + counter.between > ROOTS_MAX ? ROOTS_MAX : counter.roots + counter.between;
    Layout layout;
    layout.rings = counter.rings;
    layout.rootCount = counter.roots;
    layout.perSpacing = Real(1) / spacing;
    if (!layout.allocated(counter.seeds, rootRoom)) {
        layout.release();
        return false;
    }
    Filler filler(layout.seeds, layout.roots, layout.ringStarts, radius_, spacing);
    layOutSeeds(filler, spacing);
    layout.ringStarts[layout.rings] = counter.seeds;
    addOversampled(layout, rootRoom);

    // The surface is made for the object as it will be; without memory for it the object goes back.
    struct Kept {
        Seed* seeds;
        Vector* roots;
        int32_t* ringStarts;
        int regular, extra, rootCount, rings;
        Real spacing, laidSize;
    };
    const Kept before{seeds_, roots_, ringStarts_, regular_, extra_, rootCount_, rings_, spacing_, laidSize_};
    seeds_ = layout.seeds;
    roots_ = layout.roots;
    ringStarts_ = layout.ringStarts;
    regular_ = counter.seeds;
    extra_ = counter.rings > 0 ? counter.seeds - layout.ringStarts[ringsClose() ? 0 : 1] : 0;
    rootCount_ = layout.rootCount;
    rings_ = layout.rings;
    spacing_ = spacing;
    laidSize_ = size_;
    for (int i = 0; i < 2 * regular_; ++i)
        seeds_[i].normal = restNormal(seeds_[i]);
    Surface* const surface = makeSurface(*this);
    if (surface == nullptr) {
        layout.release();
        seeds_ = before.seeds;
        roots_ = before.roots;
        ringStarts_ = before.ringStarts;
        regular_ = before.regular;
        extra_ = before.extra;
        rootCount_ = before.rootCount;
        rings_ = before.rings;
        spacing_ = before.spacing;
        laidSize_ = before.laidSize;
        return false;
    }
    free(before.seeds);
    free(before.roots);
    free(before.ringStarts);
    destroy(surface_);
    surface_ = surface;
    makeSurface_ = makeSurface;
    displaced_ = false;
    recalc_ = true;
    return true;
}
