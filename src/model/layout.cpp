// Laying out seeds: regular seeds ring by ring as the primitive says, and an oversampled seed beside each (report, Appendix C).
// Also the warping of a layout. How seeds move is not known here.
#include "math/alloc.h"
#include "math/normal.h"
#include "math/text.h"
#include "model/softobj.h"
#include "model/stop.h"

namespace {

// The size of an oversampled seed's cell, in eighths of a regular seed's cell: it lies between seeds that have cells of their
// own.
constexpr int EXTRA_CELL = 5;

// An object with a smaller radius than this is thin: it gets as many seeds around it as an object of this radius, though
// at most twice as close. Units.
constexpr Real THIN(4.5);

// A ridge lies between two seeds at rest that are no farther apart than RIDGE_WIDEST, in spacings, if the surface bends outwards
// and the cosine of their normals (1.0 = 2^14) is at most RIDGE_BENDS; if the object tapers, also where the normals differ by
// CORNER more than those of a ball would whose radius is the length of the paths there.
constexpr Real RIDGE_WIDEST(1.25), CORNER(0.1);
constexpr int32_t RIDGE_BENDS = 13000;

// Value of `neighbour` in an oversampled seed that has not been laid out yet.
constexpr int32_t NOT_LAID = -2;

// Number of roots that the 16 bits of Seed::root can tell apart.
constexpr int ROOTS_MAX = UINT16_MAX + 1;

int8_t toCell(int32_t steps)
{
    return static_cast<int8_t>(steps > 127 ? 127 : steps < -127 ? -127 : steps);
}

// Stores a half axis of a seed's cell in 1/64 of the spacing; `inverse` is 64 / spacing.
void setAxis(int8_t* to, const Vector& half, Real inverse)
{
    const auto cell = [&](Real part) { return toCell(floorToInt(part * inverse + Real(0.5))); };
    to[0] = cell(half.x);
    to[1] = cell(half.y);
    to[2] = cell(half.z);
}

// A half axis as a vector, in 1/64 of the spacing.
Vector vectorOf(const int8_t steps[3])
{
    return {Real(static_cast<int>(steps[0])), Real(static_cast<int>(steps[1])), Real(static_cast<int>(steps[2]))};
}

// Stores the direction of a seed's path, given as a unit vector.
void setWay(Seed& s, const Direction14& n)
{
    s.way[0] = toCell((n.x * 127 + 8192) >> 14);
    s.way[1] = toCell((n.y * 127 + 8192) >> 14);
    s.way[2] = toCell((n.z * 127 + 8192) >> 14);
}

void setWay(Seed& s)
{
    const Normal n = normalise(s.path);
    setWay(s, {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)});
}

// Computes the area of the cell of a seed with normal `n`.
void setArea(Seed& s, const Direction14& n)
{
    const int8_t *const a = s.along, *const b = s.across;
    const int32_t area = ((a[1] * b[2] - a[2] * b[1]) * n.x + (a[2] * b[0] - a[0] * b[2]) * n.y +
                          (a[0] * b[1] - a[1] * b[0]) * n.z) >> 14;
    s.area = static_cast<uint16_t>((area < 0 ? -area : area) + 1);
}

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

// The direction of a vector of any length.
Direction14 direction(const Vector& v)
{
    const Normal n = normalise(v);
    return {static_cast<int16_t>(n.x), static_cast<int16_t>(n.y), static_cast<int16_t>(n.z)};
}

// The reason why the latest failed resample() failed.
char trouble[128];

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

// How far a seed lies behind the tangent plane of another, units; both are at rest.
Real SoftObject::Layout::behind(const Seed& s, const Seed& other) const
{
    return dot(rest(other) - rest(s), unitVector(other.normal));
}

// Records that a ridge lies between a seed and another, unless there is one nearer to the seed.
void SoftObject::Layout::noteBeyond(Seed& s, int other) const
{
    if (s.beyond < 0 || behind(s, seeds[other]) < behind(s, seeds[s.beyond >> 1]))
        s.beyond = 2 * other;
}

// Whether the normals of two seeds differ as much as beside a ridge.
bool SoftObject::Layout::bendSharply(const Seed& a, const Seed& b, bool tapers) const
{
    const int32_t cosine = (a.normal.x * b.normal.x + a.normal.y * b.normal.y + a.normal.z * b.normal.z) >> 14;
    if (cosine <= RIDGE_BENDS || !tapers)
        return cosine <= RIDGE_BENDS;
    // On a ball normals differ by the seeds' distance divided by the radius. The radius may be next to 0: nothing is divided by it.
    const Real differ = length(unitVector(a.normal) - unitVector(b.normal)), radius = min(length(a.path), length(b.path));
    return (differ - CORNER) * radius > length(rest(a) - rest(b));
}

// Records for two seeds that a ridge lies between them, if one does.
void SoftObject::Layout::noteRidge(int one, int other, bool tapers) const
{
    if (other < 0 || other >= regular)
        return;
    Seed &a = seeds[one], &b = seeds[other];
    if (!bendSharply(a, b, tapers) || squareOf(rest(a) - rest(b)) > squareOf(spacing * RIDGE_WIDEST) || behind(a, b) <= Real(0) ||
        behind(b, a) <= Real(0))
        return;
    noteBeyond(a, other);
    noteBeyond(b, one);
}

// Finds the ridges between each seed and those beside it: the next of its ring, and three of the ring before. (At the ends of a
// ring some of these numbers are those of seeds that lie far away.)
void SoftObject::Layout::findRidges(bool tapers) const
{
    for (int i = 0; i < regular; ++i) {
        noteRidge(i, i + 1, tapers);
        const int n = seeds[i].neighbour >> 1;
        for (int j = n - 1; n >= 0 && j <= n + 1; ++j)
            noteRidge(i, j, tapers);
    }
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
        return false;
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
        return false;
    memcpy(layout.seeds, from.seeds, sizeof(Seed) * static_cast<size_t>(from.regular));
    memcpy(layout.roots, from.roots, sizeof(Vector) * static_cast<size_t>(from.rootRoom));
    memcpy(layout.ringStarts, from.ringStarts, sizeof(int32_t) * static_cast<size_t>(from.rings + 1));
    memcpy(layout.rootsBetween, from.rootsBetween, sizeof(int32_t) * static_cast<size_t>(from.rings + 1));
    return true;
}

// The length of the path of a seed between two others, as if the object were not stretched.
Real SoftObject::restLength(const Layout& layout, const Seed& a, const Seed& b) const
{
    return tapers_ ? shiftDown(length(unstretched(a.path)) + length(unstretched(b.path)), 1) : layout.size * restRoot_;
}

// Computes the point of the core nearest to the middle of two seeds (`*root`) and the vector from it to the middle (`*out`), as
// if the object were not stretched. Returns false if the middle lies too close to the core to give a direction.
bool SoftObject::rootBetween(const Layout& layout, const Seed& one, const Seed& other, Vector* root, Vector* out) const
{
    const Vector middle = unstretched(layout.rest(one) + layout.rest(other)) * Real(0.5);
    *out = fromCore(middle * (Real(CORE_SIZE) / layout.size)) * shiftDown(layout.size, 4);
    *root = middle - *out;
    return length(*out) >= shiftDown(layout.size, 4);
}

// Lays out the oversampled seed of regular seed `number` of a ring, half way to its neighbour N. If it has no neighbour, no
// root or no direction, the oversampled seed is a copy of the regular one.
void SoftObject::layOutExtra(Layout& layout, int number, int ring, Seed& extra) const
{
    const Seed& one = layout.seeds[number];
    extra = one;
    extra.flags = 0;
    if (one.neighbour < 0)
        return;
    const Seed& other = layout.seeds[one.neighbour >> 1];
    if (one.root == other.root) {
        extra.path = withLength(unstretched(one.path + other.path), restLength(layout, one, other));
    } else {
        // Each seed has a root of its own, or the whole ring shares one: that of its first seed.
        const bool shared = layout.rootsBetween[ring + 1] - layout.rootsBetween[ring] == 1;
        const int first = layout.ringStarts[ring], index = layout.rootsBetween[ring] + (shared ? 0 : number - first);
        Vector root, out;
        if (index >= ROOTS_MAX || !rootBetween(layout, one, other, &root, &out))
            return;
        const Seed& start = layout.seeds[first];
        Vector unused;
        if (shared && !rootBetween(layout, start, layout.seeds[start.neighbour >> 1], &root, &unused))
            return;
        layout.roots[index] = stretchedOut(root);
        extra.root = static_cast<uint16_t>(index);
        extra.path = withLength(out, restLength(layout, one, other));
    }
    if (tapers_) {
        // The mean of the two lengths is only close: correct it to end where the field has the surface's value.
        Vector unused;
        const Vector rest = unstretched(layout.roots[extra.root]) + extra.path;
        const Real t = plainParam(rest * (Real(CORE_SIZE) / layout.size), &unused);
        extra.path = extra.path * (restRoot_ / squareRoot(t));
    }
    extra.path = stretchedOut(extra.path);
    for (int part = 0; part < 3; ++part) {
        extra.along[part] = static_cast<int8_t>(one.along[part] * EXTRA_CELL / 8);
        extra.across[part] = static_cast<int8_t>(one.across[part] * EXTRA_CELL / 8);
    }
}

// Returns true if a block holds oversampled seeds that are in use.
bool SoftObject::isUsed(const Seed* block)
{
    bool used = false;
    for (int i = 0; !used && i < EXTRA_BLOCK; ++i)
        used = block[i].flags != 0;
    return used;
}

// Takes the memory of a block of oversampled seeds that are no longer in use. Returns null if all blocks are in use.
Seed* SoftObject::blockFromOthers()
{
    for (int i = 0; i < laid_.blocks(); ++i) {
        Seed* const block = laid_.extras[i];
        if (block != nullptr && !isUsed(block)) {
            laid_.extras[i] = nullptr;
            return block;
        }
    }
    return nullptr;
}

// The ring of a regular seed.
int SoftObject::ringOf(int number) const
{
    int ring = 0;
    for (int after = laid_.rings; after - ring > 1;) {
        const int middle = (ring + after) >> 1;
        (laid_.ringStarts[middle] <= number ? ring : after) = middle;
    }
    return ring;
}

// Allocates a block of oversampled seeds; each is laid out when it is asked for. Returns null when there is no memory.
Seed* SoftObject::layOutBlock(int index)
{
    Seed* block = allocate<Seed>(EXTRA_BLOCK);
    if (block == nullptr)
        block = blockFromOthers();
    if (block == nullptr)
        return nullptr;
    for (int i = 0; i < EXTRA_BLOCK; ++i) {
        block[i] = Seed();
        block[i].neighbour = NOT_LAID;
    }
    laid_.extras[index] = block;
    return block;
}

Seed& SoftObject::laidExtra(int slot)
{
    // Returned when there is no memory: a copy of the regular seed, which is not drawn.
    static Seed unseen;
    const int block = slot >> (EXTRA_BITS + 1), number = slot >> 1;
    if (laid_.extras[block] == nullptr && layOutBlock(block) == nullptr) {
        unseen = seed(slot - 1);
        unseen.flags = 0;
        return unseen;
    }
    Seed& s = *extra(slot);
    if (s.neighbour != NOT_LAID)
        return s;
    Layout plain = laid_.plain();
    layOutExtra(plain, number, ringOf(number), s);
    if (warped_)
        warpExtra(plain, s);
    s.normal = restNormal(s);
    s.area = 0;
    setWay(s);
    return s;
}

bool SoftObject::layOutBetween(int i, int other)
{
    const Seed& one = regular(i);
    Seed& extra = seed(i + 1);
    if (extra.neighbour == other)
        return false;
    layOutExtra(laid_, i >> 1, ringOf(i >> 1), extra);
    if (other != one.neighbour) {
        extra.neighbour = other;
        extra.root = one.root;
        extra.path = withLength(one.path + regular(other).path, length(one.path));
    }
    extra.normal = restNormal(extra);
    extra.area = 0;
    setWay(extra);
    return true;
}

Seed* SoftObject::madeFine(int i)
{
    Seed*& block = laid_.fine[i >> (EXTRA_BITS + 1)];
    if (block == nullptr) {
        block = allocate<Seed>(FINE_SEEDS * EXTRA_BLOCK);
        for (int j = 0; block != nullptr && j < FINE_SEEDS * EXTRA_BLOCK; ++j)
            block[j].flags = 0;
    }
    return fine(i);
}

void SoftObject::layOutFine(int i, int which)
{
    const Seed &middle = seed(i + 1), &end = which == FINE_NEAR ? regular(i) : regular(middle.neighbour);
    Seed& s = fine(i)[which];
    s = middle;
    s.path = withLength(middle.path + end.path, length(middle.path));
    layAtRest(s, restNormal(s));
    setWay(s);
}

void SoftObject::layBetween(Seed& s, const Seed& a, const Seed& b, Real position, Real share) const
{
    const bool nearA = share < Real(0.5);
    const Seed &near = nearA ? a : b, &far = nearA ? b : a;
    Vector way = far.path - near.path;
    if (far.root != near.root)
        way = way + (root(far.root) - root(near.root)) * (Real(1) / position);
    s.root = near.root;
    s.path = withLength(near.path + way * (nearA ? share : Real(1) - share), length(near.path));
    setWay(s);
}

bool SoftObject::layOutExtras()
{
    for (int i = 0; i < laid_.blocks(); ++i)
        if (laid_.extras[i] == nullptr && layOutBlock(i) == nullptr)
            return false;
    for (int i = 0; i < laid_.regular; ++i)
        laidExtra(2 * i + 1);
    return true;
}

// Keeps copies of a layout's seeds and roots as they are without the warp. Returns false when there is no memory.
bool SoftObject::keepPlain(Layout& layout) const
{
    layout.plainSeeds = allocate<Seed>(static_cast<uint32_t>(layout.regular));
    layout.plainRoots = allocate<Vector>(static_cast<uint32_t>(layout.rootRoom));
    if (layout.plainSeeds == nullptr || layout.plainRoots == nullptr) {
        free(layout.plainSeeds);
        free(layout.plainRoots);
        layout.plainSeeds = nullptr;
        layout.plainRoots = nullptr;
        return false;
    }
    memcpy(layout.plainSeeds, layout.seeds, sizeof(Seed) * static_cast<size_t>(layout.regular));
    memcpy(layout.plainRoots, layout.roots, sizeof(Vector) * static_cast<size_t>(layout.rootRoom));
    for (int i = 0; i < layout.regular; ++i)
        layout.plainSeeds[i].normal = plainNormal(layout.rest(layout.seeds[i]), layout.seeds[i].path);
    return true;
}

// Warps a seed whose root has been warped already: its resting place, its cell, and its normal if it is at rest. Returns the
// normal at the resting place.
Direction14 SoftObject::warpSeed(const Seed& plain, const Vector& plainRoot, Seed& to, Warp::Way& way) const
{
    to.path = warp_.out((plainRoot + plain.path) * (Real(CORE_SIZE) / laid_.size), way) * shiftDown(laid_.size, 4) - root(to.root);
    const auto cell = [&](const int8_t from[3], int8_t into[3]) {
        setAxis(into, warp_.stepOut(way, vectorOf(from)), Real(1));
    };
    cell(plain.along, to.along);
    cell(plain.across, to.across);
    setWay(to);
    const Direction14 normal = direction(warp_.slopeOut(way, unitVector(plain.normal)));
    setArea(to, normal);
    if (to.flags & SEED_RESTING)
        layAtRest(to, normal);
    return normal;
}

// Warps an oversampled seed, as layOutExtra() left it, and its root.
void SoftObject::warpExtra(const Layout& plain, Seed& s) const
{
    const Seed before = s;
    Warp::Way way;
    const Vector& plainRoot = plain.roots[s.root];
    laid_.roots[s.root] = warp_.out(plainRoot * (Real(CORE_SIZE) / laid_.size), way) * shiftDown(laid_.size, 4);
    warpSeed(before, plainRoot, s, way);
}

// Warps roots and resting places; paths lead straight from one to the other. Seeds keep their positions along the paths.
void SoftObject::reshape()
{
    const Real inward = Real(CORE_SIZE) / laid_.size, outward = shiftDown(laid_.size, 4);
    Warp::Way way;
    findSteps();
    for (int i = 0; i < laid_.rootsBetween[0]; ++i)
        laid_.roots[i] = warp_.out(laid_.plainRoots[i] * inward, way) * outward;
    for (int i = 0; i < laid_.regular; ++i) {
        Seed& plain = laid_.plainSeeds[i];
        plain.border = warpSeed(plain, laid_.plainRoots[plain.root], laid_.seeds[i], way);
    }
    // Only oversampled seeds in use are warped; the others are laid out again when they are needed.
    for (int at = 0; at < laid_.blocks(); ++at) {
        free(laid_.fine[at]);
        laid_.fine[at] = nullptr;
    }
    Layout plain = laid_.plain();
    for (int at = 0; at < laid_.blocks(); ++at) {
        Seed* const block = laid_.extras[at];
        if (block != nullptr && !isUsed(block)) {
            free(block);
            laid_.extras[at] = nullptr;
            continue;
        }
        for (int i = 0; block != nullptr && i < EXTRA_BLOCK; ++i) {
            const int number = (at << EXTRA_BITS) + i;
            Seed& s = block[i];
            if (number >= laid_.regular || s.neighbour == NOT_LAID)
                continue;
            Seed fresh;
            layOutExtra(plain, number, ringOf(number), fresh);
            warpExtra(plain, fresh);
            s.path = fresh.path;
            memcpy(s.along, fresh.along, sizeof s.along);
            memcpy(s.across, fresh.across, sizeof s.across);
            setWay(s);
            if (s.flags & SEED_RESTING)
                layAtRest(s, restNormal(s));
        }
    }
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

Real SoftObject::ownSpacing(Real asked) const
{
    return asked * clamp(radius_ * (Real(1) / THIN), Real(0.5), Real(1));
}

int SoftObject::seedsAt(Real spacing) const
{
    Counter counter(false);
    layOutSeeds(counter, spacing);
    return counter.seeds;
}

bool SoftObject::resample(Real spacing, SurfaceMaker makeSurface, const SoftObject* like)
{
    snprintf(trouble, sizeof trouble, "not enough memory for seeds that close");
    findRest();
    Layout layout;
    layout.spacing = spacing;
    layout.size = size_;
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
    for (int ring = 0; ring < laid_.rings && !stopAsked(); ++ring)
        for (int i = laid_.ringStarts[ring]; i < laid_.ringStarts[ring + 1]; ++i) {
            Seed& s = laid_.seeds[i];
            layAtRest(s, like != nullptr ? s.normal : plainNormal(laid_.rest(s), s.path));
            if (like != nullptr)
                continue;
            // Unless paths slant, a path leads along the normal.
            if (slants())
                setWay(s);
            else
                setWay(s, s.normal);
            setArea(s, s.normal);
        }
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
        return false;
    }
    before.release();
    destroy(surface_);
    surface_ = surface;
    makeSurface_ = makeSurface;
    displaced_ = false;
    recalc_ = true;
    return true;
}
