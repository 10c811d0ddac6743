// SoftObject: seeds, pose and graph of any primitive. How the seeds settle and are drawn stands in settle.cpp (our
// method) and printed.cpp (the report's, as printed).
#include "model/softobj.h"

#include "math/alloc.h"
#include "surface/shade.h"
#include "math/text.h"

namespace {

// The cell of an oversampled seed, which lies between seeds that have cells of their own: in eighths of theirs.
constexpr int EXTRA_CELL = 5;

// Roots that a seed's 16 bits can tell apart.
constexpr int ROOTS_MOST = UINT16_MAX + 1;

// Of the spacing asked for: seeds that scaling has moved farther apart or together are laid out anew.
constexpr Real DRIFT_MOST(0.25);

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

// First run of layOutSeeds(): how much of everything there is. Between two rings with different roots lie oversampled
// seeds with roots between: `between` of them at most.
class Counter : public SeedMaker {
public:
    int roots = 0, rings = 0, seeds = 0, patches = 0, between = 0;

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
        patches += (inRing_ + SoftObject::PATCH_SEEDS - 1) / SoftObject::PATCH_SEEDS;
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
        memset(&s, 0, sizeof s);
        s.path = direction * radius_;
        s.position = Real(1);
        s.neighbour = -1;
        s.root = static_cast<uint16_t>(root);
        s.dirX = toDirection(direction.x);
        s.dirY = toDirection(direction.y);
        s.dirZ = toDirection(direction.z);
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

SoftObject::SoftObject(int number, Real size, bool tapers)
    : number_(number), centre_{Real(0), Real(0), Real(0)}, turn_(Matrix::identity()), size_(size),
      radius_(shiftDown(size, 1)), inverse_(Real(16) / size), recalc_(true), tapers_(tapers), displaced_(false),
      restStale_(false), spacing_(2), wanted_(2), laidSize_(size), stale_(false),
      light_{Real(0), Real(0), Real(0)}, ramp_(nullptr), travel_(0), linksChanged_(true), bent_(false), turning_(1), nearMark_(0),
      eyeApart_{Real(0), Real(0), Real(0)}, eyeSpeed_(0), sizeSeen_(size), drift_(0), eyeDrawn_{Real(0), Real(0), Real(0)},
      seeds_(nullptr), regular_(0), extra_(0), roots_(nullptr), rootRest_(nullptr), rootCount_(0), rest_(nullptr),
      patchRest_(nullptr), patches_(nullptr), patchCount_(0), kept_(nullptr)
{
}

SoftObject::~SoftObject()
{
    for (const List<Link>::Node* node = skel_.first(); node != nullptr; node = node->next)
        node->item.object->unlink(this);
    freeSeeds();
}

void SoftObject::freeSeeds()
{
    free(seeds_);
    free(roots_);
    free(rootRest_);
    free(rest_);
    free(patchRest_);
    free(patches_);
    free(kept_);
    seeds_ = nullptr;
    roots_ = nullptr;
    rootRest_ = nullptr;
    rest_ = nullptr;
    patchRest_ = nullptr;
    patches_ = nullptr;
    kept_ = nullptr;
}

bool SoftObject::resample(Real spacing)
{
    Counter counter;
    layOutSeeds(counter, spacing);
    counter.endRing();
    const int regular = counter.seeds;
    const bool ball = isBall();

    // A seed's root has 16 bits. When roots between rings are too many for them, some oversampled seeds do without.
    if (counter.roots > ROOTS_MOST)
        return false;
    const int rootRoom = counter.roots + counter.between > ROOTS_MOST ? ROOTS_MOST : counter.roots + counter.between;
    Seed* seeds = allocate<Seed>(static_cast<uint32_t>(2 * regular));
    Vector* rootRest = allocate<Vector>(static_cast<uint32_t>(rootRoom));
    Point* roots = allocate<Point>(static_cast<uint32_t>(rootRoom));
    int32_t* ringStarts = allocate<int32_t>(static_cast<uint32_t>(counter.rings + 1));
    Patch* patches = allocate<Patch>(static_cast<uint32_t>(counter.patches));
    Rest* rest = ball ? nullptr : allocate<Rest>(static_cast<uint32_t>(2 * regular));
    PatchRest* patchRest = ball ? nullptr : allocate<PatchRest>(static_cast<uint32_t>(counter.patches));
    if (seeds == nullptr || rootRest == nullptr || roots == nullptr || ringStarts == nullptr || patches == nullptr ||
        (!ball && (rest == nullptr || patchRest == nullptr))) {
        free(seeds);
        free(rootRest);
        free(roots);
        free(ringStarts);
        free(patches);
        free(rest);
        free(patchRest);
        return false;
    }

    Filler filler(seeds, rootRest, ringStarts, radius_, spacing);
    layOutSeeds(filler, spacing);
    ringStarts[counter.rings] = regular;
    int rootCount = counter.roots;

    // The oversampled seed of S: half way to its neighbour N, "the seed N on ring K-1 that is closest to S's
    // successor" (Appendix C, Figure 9). It lies in memory behind S. Distances to the core are asked of the object as it
    // is in its own space.
    const Point centre = centre_;
    const Matrix turn = turn_;
    if (counter.roots > 1) {
        centre_ = {Real(0), Real(0), Real(0)};
        turn_ = Matrix::identity();
        placeCore();
    }
    int pairS = -1, pairN = -1, pairRoot = 0;
    const int firstRing = ringsClose() ? 0 : 1;
    for (int i = 0; i < ringStarts[counter.rings > 0 ? firstRing : 0]; ++i)
        memset(&seeds[2 * i + 1], 0, sizeof(Seed));
    for (int k = firstRing; k < counter.rings; ++k) {
        const int ringBefore = (k > 0 ? k : counter.rings) - 1;
        const int before = ringStarts[ringBefore], start = ringStarts[k], end = ringStarts[k + 1];
        const int inBefore = ringStarts[ringBefore + 1] - before, inRing = end - start;
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
            o.neighbour = static_cast<int32_t>((s.neighbour - 2 * i) * static_cast<int>(sizeof(Seed)));
            if (s.root == other.root) {
                o.path = withLength(s.path + other.path, tapers_ ? length(s.path) : radius_);
            } else {
                // Above the point of the core that is nearest to the middle of the two.
                const Vector middle = (rootRest[s.root] + s.path + rootRest[other.root] + other.path) * Real(0.5);
                const Vector fromIt = fromCore(toPoint(middle));
                const bool known = pairS == s.root && pairN == other.root;
                if (length(fromIt) < shiftDown(radius_, 3) || (!known && rootCount == rootRoom))
                    continue;  // it stays a copy of S
                if (!known) {
                    pairS = s.root;
                    pairN = other.root;
                    pairRoot = rootCount++;
                    rootRest[pairRoot] = middle - fromIt;
                }
                o.root = static_cast<uint16_t>(pairRoot);
                o.path = withLength(fromIt, shiftDown(sizeAt(toPoint(middle)), 1));
            }
            const Vector direction = unit(o.path);
            o.dirX = toDirection(direction.x);
            o.dirY = toDirection(direction.y);
            o.dirZ = toDirection(direction.z);
            for (int part = 0; part < 3; ++part) {
                o.along[part] = static_cast<int8_t>(s.along[part] * EXTRA_CELL / 8);
                o.across[part] = static_cast<int8_t>(s.across[part] * EXTRA_CELL / 8);
            }
        }
    }
    if (tapers_) {
        for (int i = 0; i < 2 * regular; i += 2) {
            Vector slope;
            taperedParam(toPoint(rootRest[seeds[i].root] + seeds[i].path), &slope);
            const Normal normal = normalise(slope);
            rest[i].normal[0] = static_cast<int16_t>(normal.x);
            rest[i].normal[1] = static_cast<int16_t>(normal.y);
            rest[i].normal[2] = static_cast<int16_t>(normal.z);
        }
    }
    if (counter.roots > 1) {
        centre_ = centre;
        turn_ = turn;
        placeCore();
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
    const int extra = counter.rings > 0 ? regular - ringStarts[firstRing] : 0;
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
    wanted_ = spacing;
    laidSize_ = size_;
    rest_ = rest;
    patchRest_ = patchRest;
    buildPatches();
    if (!ball)
        keepRest();
    if (!ball) {
        poseSeeds();
    } else {
        for (int i = 0; i < rootCount_; ++i)
            roots_[i] = toWorld(rootRest_[i]);
    }
    displaced_ = false;
    setRecalc();
    return true;
}

// What the visibility test of a patch takes, in its small units.
void SoftObject::facePatch(Patch& patch, const Vector& axis)
{
    patch.axis[0] = toDirection(axis.x);
    patch.axis[1] = toDirection(axis.y);
    patch.axis[2] = toDirection(axis.z);
    patch.across = rawFromReal(dot(patch.middle, axis)) >> 11;
    patch.radius32 = (rawFromReal(patch.radius) >> 11) + 1;
}

// As laid out; its length is that of the path, but for objects that taper: there it is 1.
Vector SoftObject::restNormal(const Seed& s) const
{
    if (!tapers_)
        return s.path;
    const int16_t* normal = rest_[&s - seeds_].normal;
    const Real part(1.0 / 16384);
    return {part * Real(normal[0]), part * Real(normal[1]), part * Real(normal[2])};
}

// The straight line that its seeds lie along.
void SoftObject::alignPatch(Patch& patch) const
{
    const auto rests = [&](int i) {
        const Seed& s = seeds_[2 * (patch.first + i)];
        return rootRest_[s.root] + s.path - patch.middle;
    };
    patch.half = (rests(patch.count - 1) - rests(0)) * Real(0.5);
    const Vector along = unit(patch.half);
    const Real most = length(patch.half);
    Real thick(0);
    for (int i = 0; i < patch.count; ++i) {
        const Vector v = rests(i);
        thick = ::most(thick, length(v - along * clamp(dot(v, along), -most, most)));
    }
    patch.wide = thick + thick + Real(0.002);
}

void SoftObject::buildPatches()
{
    for (int p = 0; p < patchCount_; ++p) {
        Patch& patch = patches_[p];
        patch.state = PATCH_UNKNOWN;
        patch.reached = 0;
        patch.extras = false;
        patch.stale = STALE_NONE;
        patch.back = false;
        patch.turned = false;
        patch.laid = drift_;
        Vector middle{Real(0), Real(0), Real(0)}, axis = middle;
        const Real share = Real(1) / Real(patch.count);
        for (int i = 0; i < patch.count; ++i) {
            const Seed& s = seeds_[2 * (patch.first + i)];
            middle = middle + (rootRest_[s.root] + s.path) * share;
            axis = axis + restNormal(s) * share;
        }
        patch.middle = middle;
        alignPatch(patch);
        axis = unit(axis);
        patch.radius = Real(0);
        Real spread(0);
        const Real inverseRadius = Real(1) / radius_;
        for (int i = 0; i < patch.count; ++i) {
            const Seed& s = seeds_[2 * (patch.first + i)];
            patch.radius = most(patch.radius, length(rootRest_[s.root] + s.path - middle));
            spread = most(spread, length((tapers_ ? restNormal(s) : s.path * inverseRadius) - axis));
        }
        patch.spread = toDirection(least(spread, Real(1.9)));
        // The oversampled seeds between this ring and the one before reach a little further.
        patch.radius += spacing_;
        facePatch(patch, axis);
    }
}

// Makes the copies that turned and scaled seeds come from. False: no memory.
bool SoftObject::keepRest()
{
    const int slots = 2 * regular_;
    if (rest_ == nullptr || patchRest_ == nullptr) {
        free(rest_);
        free(patchRest_);
        rest_ = allocate<Rest>(static_cast<uint32_t>(slots));
        patchRest_ = allocate<PatchRest>(static_cast<uint32_t>(patchCount_));
        if (rest_ == nullptr || patchRest_ == nullptr) {
            free(rest_);
            free(patchRest_);
            rest_ = nullptr;
            patchRest_ = nullptr;
            return false;
        }
    }
    for (int i = 0; i < slots; ++i) {
        const Seed& s = seeds_[i];
        Rest& rest = rest_[i];
        rest.path = s.path;
        memcpy(rest.along, s.along, sizeof rest.along);
        memcpy(rest.across, s.across, sizeof rest.across);
    }
    for (int p = 0; p < patchCount_; ++p) {
        const Patch& patch = patches_[p];
        const Real part(1.0 / 16384);
        patchRest_[p] = {patch.middle, patch.half, patch.wide, {part * Real(patch.axis[0]), part * Real(patch.axis[1]), part * Real(patch.axis[2])},
                         patch.radius};
    }
    return true;
}

// Turns and scales the patches, and leaves roots and seeds for when they are wanted: of those that face away, never.
void SoftObject::poseSeeds()
{
    const Real ratio = size_ / laidSize_;
    spacing_ = wanted_ * ratio;
    // A ball looks the same from everywhere; only its size matters.
    const bool ball = isBall();
    const Matrix turn = ball ? Matrix::identity() : turn_;
    pose_ = turn;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            pose_.m[i][j] = turn.m[i][j] * ratio;
            turnSteps_[i][j] = rawFromReal(turn.m[i][j]) >> 2;
        }
    inverseRadius_ = Real(1) / radius_;
    if (rest_ == nullptr) {
        // Without the memory for copies, a ball scaled only: from the directions.
        for (int i = 0; i < 2 * regular_; ++i) {
            Seed& s = seeds_[i];
            const Real step = shiftDown(radius_, 14);
            s.path = {step * Real(s.dirX), step * Real(s.dirY), step * Real(s.dirZ)};
            // buildPatches() takes it that no oversampled one takes part.
            s.flags = i & 1 ? 0 : static_cast<uint8_t>(s.flags & ~SEED_KEPT);
        }
        buildPatches();
        return;
    }
    for (int p = 0; p < patchCount_; ++p) {
        Patch& patch = patches_[p];
        patch.middle = pose_ * patchRest_[p].middle;
        patch.half = pose_ * patchRest_[p].half;
        patch.wide = patchRest_[p].wide * ratio;
        patch.radius = patchRest_[p].radius * ratio;
        facePatch(patch, turn * patchRest_[p].axis);
        patch.state = PATCH_UNKNOWN;
        patch.stale = STALE_ALL;
        patch.laid = drift_;
    }
    stale_ = true;
}

// Turns and scales the seeds of a patch, and their roots; the oversampled ones only if `extras`.
void SoftObject::posePatch(Patch& patch, bool extras) const
{
    const bool regular = patch.stale == STALE_ALL;
    patch.stale = extras ? STALE_NONE : STALE_EXTRAS;
    patch.laid = drift_;
    const Matrix& m = pose_;
    const int32_t light[] = {rawFromReal(light_.x) >> 2, rawFromReal(light_.y) >> 2, rawFromReal(light_.z) >> 2};
    const bool ball = isBall();
    int root = -1;
    const int end = 2 * (patch.first + patch.count);
    for (int i = 2 * patch.first + (regular ? 0 : 1); i < end; i += regular && extras ? 1 : 2) {
        Seed& s = seeds_[i];
        const Rest& rest = rest_[i];
        if (s.root != root) {
            root = s.root;
            roots_[root] = centre_ + pose_ * rootRest_[root];
        }
        const Real x = rest.path.x, y = rest.path.y, z = rest.path.z;
        s.path = {m.m[0][0] * x + m.m[0][1] * y + m.m[0][2] * z, m.m[1][0] * x + m.m[1][1] * y + m.m[1][2] * z,
                  m.m[2][0] * x + m.m[2][1] * y + m.m[2][2] * z};
        if (tapers_ && patch.state == PATCH_AT_REST) {
            // What matters at rest is which way the surface faces.
            s.dirX = static_cast<int16_t>(turnStep(0, rest.normal));
            s.dirY = static_cast<int16_t>(turnStep(1, rest.normal));
            s.dirZ = static_cast<int16_t>(turnStep(2, rest.normal));
        } else if (tapers_) {
            const Normal direction = normalise(s.path);
            s.dirX = static_cast<int16_t>(direction.x);
            s.dirY = static_cast<int16_t>(direction.y);
            s.dirZ = static_cast<int16_t>(direction.z);
        } else {
            s.dirX = toDirection(s.path.x * inverseRadius_);
            s.dirY = toDirection(s.path.y * inverseRadius_);
            s.dirZ = toDirection(s.path.z * inverseRadius_);
        }
        const int32_t cosine = (s.dirX * light[0] + s.dirY * light[1] + s.dirZ * light[2]) >> 14;
        const int32_t step = (cosine * 63 + 8192) >> 14;
        s.restBrightness = static_cast<uint8_t>(step < 0 ? 0 : step > 63 ? 63 : step);
        if (patch.state == PATCH_AT_REST)
            s.voxel.brightness = s.restBrightness;
        s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
        if ((s.flags & (SEED_VALID | SEED_PLACED)) == SEED_VALID)
            s.flags |= SEED_FRONT;
        if (ball)
            continue;
        for (int part = 0; part < 3; ++part) {
            s.along[part] = toCell(turnStep(part, rest.along));
            s.across[part] = toCell(turnStep(part, rest.across));
        }
    }
}

void SoftObject::poseAll() const
{
    if (!stale_)
        return;
    stale_ = false;
    for (int p = 0; p < patchCount_; ++p)
        if (patches_[p].stale != STALE_NONE)
            posePatch(patches_[p], true);
}

void SoftObject::shadeRest(const Vector& light)
{
    light_ = light;
    recalc_ = true;
    if (rest_ != nullptr) {
        for (int p = 0; p < patchCount_; ++p) {
            patches_[p].state = PATCH_UNKNOWN;
            patches_[p].stale = STALE_ALL;
            patches_[p].laid = drift_;
        }
        stale_ = true;
        return;
    }
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
}

// --- Operations

// A vector of nearly the same length as `like`, made to have it: its largest component takes up the difference. Exact
// to half a last bit each time, and never to one side, so that a million turns keep a distance.
static Vector withSquare(const Vector& v, const Vector& like)
{
#if FB_REAL == FB_FIXED
    const auto square = [](const Vector& u) {
        return static_cast<int64_t>(u.x.raw) * u.x.raw + static_cast<int64_t>(u.y.raw) * u.y.raw +
               static_cast<int64_t>(u.z.raw) * u.z.raw;
    };
    Vector r = v;
    Real* largest = &r.x;
    if (absolute(r.y) > absolute(*largest))
        largest = &r.y;
    if (absolute(r.z) > absolute(*largest))
        largest = &r.z;
    if (*largest == Real(0))
        return r;
    const int64_t lack = square(like) - square(r);
    const uint32_t twice = 2 * static_cast<uint32_t>(rawFromReal(absolute(*largest)));
    uint32_t rest;
    const int32_t change = static_cast<int32_t>(
        divide64(static_cast<uint64_t>(lack < 0 ? -lack : lack) + twice / 2, twice, &rest));
    const bool outwards = (lack > 0) == (*largest > Real(0));
    *largest += Real::fromRaw(outwards ? change : -change);
    return r;
#else
    return withLength(v, length(like));
#endif
}

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
    translate(withSquare(by * arm, arm) - arm);
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
    const Vector columns[] = {x, y, z};
    Matrix square = Matrix::identity();
    bool same = true;
    for (int j = 0; j < 3; ++j) {
        square.m[0][j] = columns[j].x;
        square.m[1][j] = columns[j].y;
        square.m[2][j] = columns[j].z;
        for (int i = 0; i < 3; ++i)
            same = same && square.m[i][j] == turn_.m[i][j];
    }
    if (same)
        return;
    // A ball looks the same from everywhere.
    const bool ball = isBall();
    if (!ball)
        tellNeighbours();
    turn_ = square;
    placeCore();
    if (ball)
        return;
    if (seeds_ != nullptr)
        poseSeeds();
    recalc_ = true;
    tellNeighbours();
}

void SoftObject::setSize(Real wanted)
{
    const Real size = clamp(wanted, Real(SIZE_LEAST), Real(SIZE_MOST));
    if (size == size_)
        return;
    tellNeighbours();
    if (seeds_ != nullptr && rest_ == nullptr && size_ == laidSize_)
        keepRest();
    size_ = size;
    radius_ = shiftDown(size, 1);
    inverse_ = Real(16) / size;
    placeCore();
    if (seeds_ != nullptr) {
        const Real drift = size_ / laidSize_;
        const bool far = drift > Real(1) + DRIFT_MOST || drift < Real(1) - DRIFT_MOST;
        if (far && resample(wanted_))
            restStale_ = true;
        else
            poseSeeds();
    }
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
    // Seeds that others pull out lie as far as the field does. Squares are compared: every pair of a model comes by here.
    const int64_t reach = rawFromReal(coreReach() + other.coreReach() + size_ + other.size_);
    return squaredDistance(centre_, other.centre_) < reach * reach;
}

// What seeds know of the surface around them is void.
void SoftObject::linkChanged()
{
    recalc_ = true;
    linksChanged_ = true;
}

bool SoftObject::link(SoftObject* other, Real weight)
{
    Link* there = skel_.find({other, Real(0), {}, {}, {}, {}, {}, {}});
    if (there != nullptr)
        there->weight = weight;
    else if (!skel_.append({other, weight, {}, {}, {}, {}, {}, {}}))
        return false;
    linkChanged();
    return true;
}

void SoftObject::unlink(SoftObject* other)
{
    if (skel_.remove({other, Real(0), {}, {}, {}, {}, {}, {}}))
        linkChanged();
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

void SoftObject::describeAs(const char* kind, const Real* numbers, int count, char* to, int size) const
{
    int used = snprintf(to, static_cast<size_t>(size), "%s %d", kind, number_);
    for (int i = 0; i < count && used < size; ++i) {
        char text[24];
        formatReal(text, sizeof text, numbers[i]);
        used += snprintf(to + used, static_cast<size_t>(size - used), " %s", text);
    }
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
    if (restStale_) {
        shadeRest(look.light);
        restStale_ = false;
    }
    if (look.printed)
        updatePrinted(look);
    else
        updateQuick(look);
    recalc_ = false;
}

void SoftObject::draw(const Look& look, VoxelList& list, int room, int* next)
{
    const Vector place = centre_ - look.eye;
    list.x = rawFromReal(place.x) >> 8;
    list.y = rawFromReal(place.y) >> 8;
    list.z = rawFromReal(place.z) >> 8;
    list.ramp = ramp_;
    if (look.printed)
        drawPrinted(look, list, room, next);
    else
        drawQuick(look, list, room, next);
}
