// SoftObject: seeds, pose and graph of any primitive. How the seeds settle and are drawn stands in settle.cpp (our
// method) and printed.cpp (the report's, as printed).
#include "softobj.h"

#include "alloc.h"

namespace {

// Every scale is a little larger than the part of the surface that is its own, by this part of the spacing: the
// surface bends between seeds and a ring holds a whole number of them.
constexpr Real CELL_MARGIN(0.08);

constexpr int EXTRA_CELL = 5;

int16_t toExtent(Real units)
{
    const int32_t value = rawFromReal(units) >> 8;
    return static_cast<int16_t>(value > INT16_MAX ? INT16_MAX : value);
}

// Half axes of a seed's cell in 1/64 spacing; `inverse` is 64 / spacing.
void setCell(int8_t* to, const Vector& half, Real inverse)
{
    const Real parts[] = {half.x, half.y, half.z};
    for (int i = 0; i < 3; ++i)
        to[i] = static_cast<int8_t>(floorToInt(clamp(parts[i] * inverse, Real(-127), Real(127)) + Real(0.5)));
}

// 1.0 -> 2^14
int16_t toDirection(Real part)
{
    return static_cast<int16_t>(rawFromReal(part) >> 2);
}

int64_t squaredDistance(const Point& a, const Point& b)
{
    const int64_t x = rawFromReal(a.x) - rawFromReal(b.x);
    const int64_t y = rawFromReal(a.y) - rawFromReal(b.y);
    const int64_t z = rawFromReal(a.z) - rawFromReal(b.z);
    return x * x + y * y + z * z;
}

}  // namespace

// First run of layOutSeeds(): how much of everything there is.
class Counter : public SeedMaker {
public:
    int roots = 0, rings = 0, seeds = 0, inFirstRing = 0, patches = 0;

    int addRoot(const Vector&) override { return roots++; }
    void beginRing() override
    {
        endRing();
        ++rings;
    }
    void addSeed(int, const Vector&, const Vector&, const Vector&) override
    {
        ++seeds;
        ++inRing_;
        if (rings == 1)
            ++inFirstRing;
    }
    void endRing()
    {
        patches += (inRing_ + SoftObject::PATCH_SEEDS - 1) / SoftObject::PATCH_SEEDS;
        inRing_ = 0;
    }

private:
    int inRing_ = 0;
};

// Second run: writes roots and regular seeds, and where each ring starts.
class Filler : public SeedMaker {
public:
    Filler(Seed* seeds, Vector* roots, int32_t* ringStarts, Real radius, Real spacing)
        : seeds_(seeds), roots_(roots), ringStarts_(ringStarts), radius_(radius), margin_(spacing * CELL_MARGIN),
          inverseSpacing_(Real(64) / spacing)
    {
    }

    int addRoot(const Vector& fromCentre) override
    {
        roots_[rootCount_] = fromCentre;
        return rootCount_++;
    }
    void beginRing() override { ringStarts_[rings_++] = count_; }
    void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) override
    {
        Seed& s = seeds_[2 * count_++];
        memset(&s, 0, sizeof s);
        s.path = direction * radius_;
        s.position = Real(1);
        s.neighbour = -1;
        s.root = static_cast<uint16_t>(root);
        s.dirX = toDirection(direction.x);
        s.dirY = toDirection(direction.y);
        s.dirZ = toDirection(direction.z);
        s.restWide = toExtent(absolute(along.x) + absolute(across.x) + margin_);
        s.restHigh = toExtent(absolute(along.y) + absolute(across.y) + margin_);
        setCell(s.along, along, inverseSpacing_);
        setCell(s.across, across, inverseSpacing_);
    }

private:
    Seed* seeds_;
    Vector* roots_;
    int32_t* ringStarts_;
    Real radius_;
    Real margin_;
    Real inverseSpacing_;
    int rootCount_ = 0, rings_ = 0, count_ = 0;
};

SoftObject::SoftObject(int number, Real size)
    : number_(number), centre_{Real(0), Real(0), Real(0)}, turn_(Matrix::identity()), size_(size),
      radius_(shiftDown(size, 1)), inverse_(Real(16) / size), recalc_(true), turned_(false), displaced_(false),
      linkedChange_(false), spacing_(2), spread_(1), ramp_(nullptr), seeds_(nullptr), regular_(0), extra_(0),
      roots_(nullptr), rootRest_(nullptr), rootCount_(0), pathRest_(nullptr), patches_(nullptr), patchCount_(0),
      kept_(nullptr)
{
}

SoftObject::~SoftObject()
{
    freeSeeds();
}

void SoftObject::freeSeeds()
{
    free(seeds_);
    free(roots_);
    free(rootRest_);
    free(pathRest_);
    free(patches_);
    free(kept_);
    seeds_ = nullptr;
    roots_ = nullptr;
    rootRest_ = nullptr;
    pathRest_ = nullptr;
    patches_ = nullptr;
    kept_ = nullptr;
}

bool SoftObject::resample(Real spacing)
{
    Counter counter;
    layOutSeeds(counter, spacing);
    counter.endRing();
    const int regular = counter.seeds;

    // Between two rings with different roots lie oversampled seeds with a root between: one more for each ring at most.
    const int rootRoom = counter.roots + counter.rings;
    if (rootRoom > UINT16_MAX)
        return false;
    Seed* seeds = allocate<Seed>(static_cast<uint32_t>(2 * regular));
    Vector* rootRest = allocate<Vector>(static_cast<uint32_t>(rootRoom));
    Point* roots = allocate<Point>(static_cast<uint32_t>(rootRoom));
    int32_t* ringStarts = allocate<int32_t>(static_cast<uint32_t>(counter.rings + 1));
    Patch* patches = allocate<Patch>(static_cast<uint32_t>(counter.patches));
    if (seeds == nullptr || rootRest == nullptr || roots == nullptr || ringStarts == nullptr || patches == nullptr) {
        free(seeds);
        free(rootRest);
        free(roots);
        free(ringStarts);
        free(patches);
        return false;
    }

    Filler filler(seeds, rootRest, ringStarts, radius_, spacing);
    layOutSeeds(filler, spacing);
    ringStarts[counter.rings] = regular;
    int rootCount = counter.roots;

    // The oversampled seed of S: half way to its neighbour N, "the seed N on ring K-1 that is closest to S's
    // successor" (Appendix C, Figure 9). It lies in memory behind S.
    int pairS = -1, pairN = -1;
    for (int i = 0; i < ringStarts[counter.rings > 0 ? 1 : 0]; ++i)
        memset(&seeds[2 * i + 1], 0, sizeof(Seed));
    for (int k = 1; k < counter.rings; ++k) {
        const int before = ringStarts[k - 1], start = ringStarts[k], end = ringStarts[k + 1];
        const int inBefore = start - before, inRing = end - start;
        for (int i = start; i < end; ++i) {
            Seed& s = seeds[2 * i];
            const Seed& successor = seeds[2 * (i + 1 == end ? start : i + 1)];
            const Point target = toPoint(rootRest[successor.root] + successor.path);
            int n = static_cast<int>(static_cast<uint32_t>(i + 1 == end ? 0 : i + 1 - start) *
                                     static_cast<uint32_t>(inBefore) / static_cast<uint32_t>(inRing));
            const auto distance = [&](int j) {
                const Seed& other = seeds[2 * (before + j)];
                return squaredDistance(target, toPoint(rootRest[other.root] + other.path));
            };
            int64_t nearest = distance(n);
            for (int step = -1; step <= 1; step += 2) {
                for (;;) {
                    const int next = (n + step + inBefore) % inBefore;
                    const int64_t d = distance(next);
                    if (d >= nearest)
                        break;
                    nearest = d;
                    n = next;
                }
            }
            s.neighbour = 2 * (before + n);
            const Seed& other = seeds[s.neighbour];
            Seed& o = seeds[2 * i + 1];
            o = s;
            if (s.root != other.root) {
                if (pairS != s.root || pairN != other.root) {
                    pairS = s.root;
                    pairN = other.root;
                    if (rootCount < rootRoom)
                        ++rootCount;
                    rootRest[rootCount - 1] = (rootRest[pairS] + rootRest[pairN]) * Real(0.5);
                }
                o.root = static_cast<uint16_t>(rootCount - 1);
            }
            o.path = withLength(s.path + other.path, radius_);
            const Vector direction = unit(o.path);
            o.dirX = toDirection(direction.x);
            o.dirY = toDirection(direction.y);
            o.dirZ = toDirection(direction.z);
            // It fills the middle between seeds that have cells of their own.
            for (int part = 0; part < 3; ++part) {
                o.along[part] = static_cast<int8_t>(s.along[part] * EXTRA_CELL / 8);
                o.across[part] = static_cast<int8_t>(s.across[part] * EXTRA_CELL / 8);
            }
        }
    }

    // Runs of seeds of one ring, of about equal length.
    int patch = 0;
    for (int k = 0; k < counter.rings; ++k) {
        const int inRing = ringStarts[k + 1] - ringStarts[k];
        const int runs = (inRing + PATCH_SEEDS - 1) / PATCH_SEEDS;
        for (int r = 0; r < runs; ++r, ++patch) {
            patches[patch].first = ringStarts[k] + inRing * r / runs;
            patches[patch].count = ringStarts[k] + inRing * (r + 1) / runs - patches[patch].first;
        }
    }
    const int extra = counter.rings > 0 ? regular - ringStarts[1] : 0;
    free(ringStarts);

    freeSeeds();
    seeds_ = seeds;
    regular_ = regular;
    extra_ = extra;
    roots_ = roots;
    rootRest_ = rootRest;
    rootCount_ = rootCount;
    patches_ = patches;
    patchCount_ = patch;
    spacing_ = spacing;
    if (turned_)
        turnSeeds();
    for (int i = 0; i < rootCount_; ++i)
        roots_[i] = toWorld(rootRest_[i]);
    rebuildPatches();
    displaced_ = false;
    setRecalc();
    return true;
}

void SoftObject::rebuildPatches()
{
    for (int p = 0; p < patchCount_; ++p) {
        Patch& patch = patches_[p];
        patch.state = PATCH_UNKNOWN;
        Vector middle{Real(0), Real(0), Real(0)}, axis = middle;
        const Real share = Real(1) / Real(patch.count);
        for (int i = 0; i < patch.count; ++i) {
            const Seed& s = seeds_[2 * (patch.first + i)];
            middle = middle + ((roots_[s.root] - centre_) + s.path) * share;
            axis = axis + s.path * share;
        }
        patch.middle = middle;
        axis = unit(axis);
        patch.radius = Real(0);
        Real spread(0);
        const Real inverseRadius = Real(1) / radius_;
        for (int i = 0; i < patch.count; ++i) {
            const Seed& s = seeds_[2 * (patch.first + i)];
            patch.radius = most(patch.radius, length((roots_[s.root] - centre_) + s.path - middle));
            spread = most(spread, length(s.path * inverseRadius - axis));
        }
        patch.axis[0] = toDirection(axis.x);
        patch.axis[1] = toDirection(axis.y);
        patch.axis[2] = toDirection(axis.z);
        patch.spread = toDirection(least(spread, Real(1.9)));
        patch.across = rawFromReal(dot(middle, axis)) >> 11;
        patch.radius32 = (rawFromReal(patch.radius) >> 11) + 1;
        // The oversampled seeds between this ring and the one before reach a little further.
        patch.radius += spacing_;
    }
}

void SoftObject::turnSeeds()
{
    // A ball looks the same from everywhere; only its place turned.
    if (coreReach() == Real(0))
        return;
    const int slots = 2 * regular_;
    if (pathRest_ == nullptr) {
        pathRest_ = allocate<Vector>(static_cast<uint32_t>(slots));
        if (pathRest_ == nullptr)
            return;  // no memory to turn: the seeds stay as they were laid out, and the surface is still found
        for (int i = 0; i < slots; ++i)
            pathRest_[i] = seeds_[i].path;
    }
    // Always from the rest paths, so that no error adds up however often it is turned.
    const Real inverseRadius = Real(1) / radius_;
    const Real inverse = Real(64) / spacing_;
    for (int i = 0; i < slots; ++i) {
        Seed& s = seeds_[i];
        s.path = turn_ * pathRest_[i];
        const Vector direction = s.path * inverseRadius;
        s.dirX = toDirection(direction.x);
        s.dirY = toDirection(direction.y);
        s.dirZ = toDirection(direction.z);
        // The cell turned, but rotated anew from any two half axes: across the direction they are all alike.
        const Vector aside = absolute(direction.y) < Real(0.9) ? Vector{Real(0), Real(1), Real(0)} : Vector{Real(1), Real(0), Real(0)};
        const Vector along = withLength(cross(aside, direction), spacing_ * Real(0.56));
        const Vector across = cross(direction, along);
        setCell(s.along, along, inverse);
        setCell(s.across, across, inverse);
        s.restWide = toExtent(absolute(along.x) + absolute(across.x));
        s.restHigh = toExtent(absolute(along.y) + absolute(across.y));
        s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
    }
}

void SoftObject::shadeRest(const Vector& light)
{
    const Real inverseRadius = Real(1) / radius_;
    for (int i = 0; i < 2 * regular_; ++i) {
        Seed& s = seeds_[i];
        const Real lit = dot(s.path, light) * inverseRadius * Real(63) + Real(0.5);
        const int step = floorToInt(lit);
        s.restBrightness = static_cast<uint8_t>(step < 0 ? 0 : step > 63 ? 63 : step);
        s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
    }
    for (int p = 0; p < patchCount_; ++p)
        patches_[p].state = PATCH_UNKNOWN;
    recalc_ = true;
}

// --- Operations

void SoftObject::translate(const Vector& by)
{
    if (by == Vector{Real(0), Real(0), Real(0)})
        return;
    tellNeighbours();
    centre_ = centre_ + by;
    for (int i = 0; i < rootCount_; ++i)
        roots_[i] = roots_[i] + by;
    placeCore();
    recalc_ = true;
    tellNeighbours();
}

void SoftObject::rotate(const Point& about, const Vector& axis, Angle angle)
{
    const Matrix by = Matrix::rotation(axis, angle);
    const Vector arm = centre_ - about;
    translate(by * arm - arm);
    setTurn(by * turn_);
}

void SoftObject::setTurn(const Matrix& turn)
{
    // Columns made perpendicular and of unit length again: a product of many rotations drifts.
    Vector x{turn.m[0][0], turn.m[1][0], turn.m[2][0]};
    Vector y{turn.m[0][1], turn.m[1][1], turn.m[2][1]};
    x = unit(x);
    y = unit(y - x * dot(x, y));
    const Vector z = cross(x, y);
    tellNeighbours();
    turn_ = Matrix::identity();
    turn_.m[0][0] = x.x;
    turn_.m[1][0] = x.y;
    turn_.m[2][0] = x.z;
    turn_.m[0][1] = y.x;
    turn_.m[1][1] = y.y;
    turn_.m[2][1] = y.z;
    turn_.m[0][2] = z.x;
    turn_.m[1][2] = z.y;
    turn_.m[2][2] = z.z;
    turned_ = true;
    for (int i = 0; i < rootCount_; ++i)
        roots_[i] = toWorld(rootRest_[i]);
    placeCore();
    if (seeds_ != nullptr && coreReach() > Real(0)) {
        turnSeeds();
        rebuildPatches();
        linkedChange_ = true;  // rest brightness is stale
    }
    recalc_ = true;
    tellNeighbours();
}

void SoftObject::scale(Real by)
{
    const Real size = clamp(size_ * by, Real(SIZE_LEAST), Real(SIZE_MOST));
    const Real factor = size / size_;
    if (factor == Real(1))
        return;
    tellNeighbours();
    size_ = size;
    radius_ = shiftDown(size, 1);
    inverse_ = Real(16) / size;
    scaleCore(factor);
    placeCore();
    recalc_ = true;
    tellNeighbours();
}

// "If the object is transformed, this flag is set and it will tell all its neighbors to set their recalc flags", but
// "if an object has no displaced seeds [...] it will not tell its neighbors". Our addition: it does when it is near
// enough to matter, so that huge jumps are safe.
void SoftObject::tellNeighbours()
{
    for (const List<Link>::Node* node = skel_.first(); node != nullptr; node = node->next) {
        if (!node->item.object->recalc_ && (displaced_ || inRange(*node->item.object)))
            node->item.object->recalc_ = true;
    }
}

bool SoftObject::inRange(const SoftObject& other) const
{
    const Real core = coreReach() + other.coreReach();
    return length(centre_ - other.centre_) < core + most(radius_ + other.size_, other.radius_ + size_);
}

bool SoftObject::link(SoftObject* other, Real weight)
{
    Link* there = skel_.find({other, Real(0)});
    if (there != nullptr)
        there->weight = weight;
    else if (!skel_.append({other, weight}))
        return false;
    recalc_ = true;
    return true;
}

void SoftObject::unlink(SoftObject* other)
{
    if (skel_.remove({other, Real(0)}))
        recalc_ = true;
}

// --- The field

Real SoftObject::coreParam(const Vector& v) const
{
    // Far away first: beyond this box the squares would overflow 16.16 and the field is 0 anyway.
    if (absolute(v.x) >= size_ || absolute(v.y) >= size_ || absolute(v.z) >= size_)
        return Real(1);
    const Vector q = v * inverse_;
    return shiftDown(dot(q, q), 8);
}

Real SoftObject::fieldSum(const Point& p) const
{
    Real sum = fieldFunc(p);
    for (const List<Link>::Node* node = skel_.first(); node != nullptr; node = node->next)
        sum += node->item.object->fieldFunc(p) * node->item.weight;
    return sum;
}

// --- A frame

void SoftObject::update(const Look& look)
{
    if (!recalc_)
        return;
    if (linkedChange_) {
        shadeRest(look.light);
        linkedChange_ = false;
    }
    if (look.printed)
        updatePrinted(look);
    else
        updateQuick(look);
    recalc_ = false;
}

int SoftObject::draw(const Look& look, Voxel* voxels, int room, int* next)
{
    return look.printed ? drawPrinted(look, voxels, room, next) : drawQuick(look, voxels, room, next);
}

Real SoftObject::reach() const
{
    return coreReach() + radius_ * spread_ + shiftUp(spacing_, 2);
}
