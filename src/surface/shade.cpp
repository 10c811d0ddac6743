// From settled seeds to voxels, in whole numbers, because it is done for every seed that is seen. What does not change as long as
// a seed stays where it is gets measured once and kept in it; what neighbours share is worked out once for their patch.
#include "shade.h"

#include "math/normal.h"
#include "paint.h"
#include "voxels.h"

namespace {

template <class Part, class Other>
inline int32_t product(const Part a[3], const Other b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Part>
inline int32_t product(const Direction14& a, const Part b[3])
{
    return a.x * b[0] + a.y * b[1] + a.z * b[2];
}

inline int32_t magnitude(int32_t a)
{
    return a < 0 ? -a : a;
}

inline int32_t limited(int32_t a, int32_t most)
{
    return a > most ? most : a < -most ? -most : a;
}

inline int32_t larger(int32_t a, int32_t b)
{
    return a < b ? b : a;
}

inline int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

// No scale is stretched to more than two and a half times its cell by blending: cosine of path and normal.
constexpr int32_t LEAST_COSINE = 6500;

// Below this cosine of path and normal a cell lies in no even band of its ring.
constexpr int32_t UNEVEN = 15500;

// By how much scales of two objects overlap at their border, 1/256 unit.
constexpr int32_t BORDER_MARGIN = 40;

// Depth before which the whole of a cell is covered: so near the viewer a ring is no straight band in the picture; 1/256 unit.
constexpr int32_t WHOLE_BEFORE = 64 * 256;

// The greatest radius of curvature, 1/32 unit, and the cosine of normal and viewer from which on it does not matter.
constexpr int32_t FLATTEST = 8000;
constexpr int32_t FACES_VIEWER = 16000;

// Seeds of a patch, oversampled ones included.
constexpr int SEEDS_MOST = 2 * PATCH_RINGS * PATCH_SEEDS;

// By how much the view of a patch may turn, and it may grow, after it was shaded; 1.0 = 2^14.
constexpr int32_t MOST_TURN = 400;

// Turns the seeds of one object into voxels. Made once for an object and a frame.
class Shader {
public:
    Shader(SoftObject& object, const OwnFrame& own, const FrameContext& frame);

    // Lists the voxels of a patch, by way of the painter of objects that have a paint.
    template <bool PAINTED>
    void shadePatch(Patch& patch, bool turn, VoxelList& list, Painter* painter);

private:
    bool keepPatch(Patch& patch, VoxelList& list) const;
    int measureSeen(Patch& patch, Seen* seen, int count, bool* anew);
    int leaveNear(Seen* seen, int count) const;
    void measurePlace(Seed& s) const;
    void measureCell(Seed& s) const;
    void setLength(const Vector& path, int32_t u[3]) const;
    void measureBend(Patch& patch) const;
    void setPatch(const Patch& patch, const Seen& middle);
    void setBend(const Patch& patch, const Seen& middle);
    bool cut(const Seed& s, Voxel* voxel) const;
    // What of a vector of own space lies along axis i of the view.
    template <class Part>
    int32_t along(const Part v[3], const int32_t axis[3], int i) const
    {
        return shading_.turned ? product(v, axis) >> 14 : v[i];
    }

    SoftObject& object_;
    const Seed* const seeds_;  // the regular ones
    const Vector* const roots_;
    const OwnFrame own_;
    Shading shading_;
    int32_t centre_[3];       // of the object from the eye, 1/256 unit
    bool ball_, near_;        // near: some seeds may be nearer than NEAREST_DEPTH
    int placeShift_;          // bits of Real below those of places
    int32_t facesViewer_;     // FACES_VIEWER times the distance of the eye, steps of places
    int viewShift_;           // brings the way to the eye to 14 bits
    int pathShift_;           // brings the length of a path to 2^11 .. 2^12
    int32_t leastCosine_, uneven_;  // LEAST_COSINE and UNEVEN times that
    const bool hollow_;       // the seeds sample a hollow
    int32_t ballGradient_[3]; // of the brightness over a ball, axes of the view, 1/8 step a unit with 8 bits of fraction
    int32_t ballHorizon_;     // Shading::horizonShare of what bends like a ball
    int32_t horizonScale_;    // of a radius of curvature in steps of places / 8
    int32_t gradientScale_;   // brings gradients of patches to 1/8 step a unit with 8 bits of fraction
    int32_t cellScale_;       // the spacing, 1/256 unit, times a power of 2 that leaves cells 16 bits: 3072 to 6143
    uint32_t areaScale_;      // squared spacing
    // Of the patch.
    int32_t shearX_, shearY_; // of the ray through it, 10 bits of fraction
};

Shader::Shader(SoftObject& object, const OwnFrame& own, const FrameContext& frame)
    : object_(object), seeds_(&object.regular(0)), roots_(&object.root(0)), own_(own), hollow_(!object.hasSurface())
{
    const Vector place = frame.inView(object.centre());
    centre_[0] = rawFromReal(place.x) >> 8;
    centre_[1] = rawFromReal(place.y) >> 8;
    centre_[2] = rawFromReal(place.z) >> 8;
    ball_ = object.isBall();
    // No seed leaves the reach of its object. Places have 16 bits.
    const int32_t reach = rawFromReal(object.reach()) >> 8;
    near_ = centre_[2] - reach < NEAREST_DEPTH || centre_[2] + reach >= FARTHEST_DEPTH;
    placeShift_ = 8;
    for (int32_t most = rawFromReal(object.laidReach()) >> 8; most > 32000; most >>= 1)
        ++placeShift_;
    // A step of places in 1/256 unit of the world, 16 bits of fraction.
    const int32_t step = rawFromReal(own.growth) << (placeShift_ - 8);
    shading_.turned = !ball_ || object.size() != object.laidSize() || frame.axes.turned;
    shading_.depth = centre_[2];
    const int32_t* const axes[] = {own.right, own.up, own.ahead};
    const int32_t radius = rawFromReal(object.radius());
    for (int i = 0; i < 3; ++i) {
        shading_.eye[i] = mulDiv(own.eye32[i], 1 << 16, step);
        shading_.right[i] = mulDiv(own.right[i], 1 << 16, step);
        shading_.up[i] = mulDiv(own.up[i], 1 << 16, step);
        shading_.toRight[i] = mulShift16(own.right[i], step);
        shading_.toUp[i] = mulShift16(own.up[i], step);
        shading_.toAhead[i] = mulShift16(own.ahead[i], step);
        ballGradient_[i] = (product(own.light, axes[i]) >> 14) * (BRIGHTEST * 32) / ((radius >> 8) + 1);
    }
    // On a ball a scale that is seen nearly edge-on adds next to nothing to those before it; on flat parts it may be all
    // there is.
    const int32_t distance = mulDiv(own.distance32, 1 << 16, step);
    shading_.limb = ball_ ? distance * 5 >> 4 : distance >> 4;
    facesViewer_ = (distance * (FACES_VIEWER >> 6)) >> 5;
    viewShift_ = larger(0, 18 - __builtin_clz(static_cast<uint32_t>(distance + 4096)));
    ballHorizon_ = mulShift16((smaller(radius >> 11, FLATTEST) << 12) / own.distance32, step);
    horizonScale_ = mulShift16(mulDiv(step, 1 << 12, own.distance32), step);
    gradientScale_ = mulDiv(BRIGHTEST, 1 << (24 - placeShift_), rawFromReal(own.growth));
    const int32_t spacing = smaller(rawFromReal(object.spacing() * own.growth) >> 8, 2800);
    areaScale_ = static_cast<uint32_t>(mulShift16(spacing * spacing << 7, step));
    shading_.cellShift = __builtin_clz(static_cast<uint32_t>(spacing)) - 19;
    if (spacing << shading_.cellShift > 6143)
        --shading_.cellShift;
    cellScale_ = spacing << shading_.cellShift;
    const int32_t path = rawFromReal(object.laidRadius());
    pathShift_ = 20 - __builtin_clz(static_cast<uint32_t>(path));
    leastCosine_ = (path >> pathShift_) * LEAST_COSINE >> 14;
    uneven_ = (path >> pathShift_) * UNEVEN >> 14;
}

// Where the seed is, and how high above the origin the plane lies that touches the surface there. Its cell stays as long as the
// seed has moved little.
inline void Shader::measurePlace(Seed& s) const
{
    const Vector place = roots_[s.root] + (s.flags & SEED_RESTING ? s.path : s.path * s.position);
    s.place[0] = static_cast<int16_t>(rawFromReal(place.x) >> placeShift_);
    s.place[1] = static_cast<int16_t>(rawFromReal(place.y) >> placeShift_);
    s.place[2] = static_cast<int16_t>(rawFromReal(place.z) >> placeShift_);
    s.height = static_cast<int16_t>(product(s.normal, s.place) >> 14);
    const uint8_t position = static_cast<uint8_t>(rawFromReal(s.position) >> 9);
    if (s.cellPosition != position) {
        s.cellPosition = position;
        s.cellArea = 0;
    }
}

// The path of a shaped object's seed, as long as if it were not shaped.
SELDOM void Shader::setLength(const Vector& path, int32_t u[3]) const
{
    const Normal n = normalise(path);
    const int32_t length = rawFromReal(object_.laidRadius()) >> pathShift_;
    u[0] = n.x * length >> 14;
    u[1] = n.y * length >> 14;
    u[2] = n.z * length >> 14;
}

// The cell of the unblended surface that is the seed's own, grown with the position, as it falls along the path onto the
// tangent plane. A half axis e becomes e - u (e.n) / (u.n) with u the path.
SELDOM void Shader::measureCell(Seed& s) const
{
    int32_t n[] = {s.normal.x, s.normal.y, s.normal.z};
    // Oversampled seeds lie between those of rings, and make no band.
    bool even = !(s.flags & SEED_ACTIVE);
    if (s.flags & SEED_RESTING) {
        for (int i = 0; i < 3; ++i) {
            s.cellAlong[i] = s.along[i];
            s.cellAcross[i] = s.across[i];
        }
    } else {
        int32_t u[] = {rawFromReal(s.path.x) >> pathShift_, rawFromReal(s.path.y) >> pathShift_,
                       rawFromReal(s.path.z) >> pathShift_};
        if (object_.shaped())
            setLength(s.path, u);
        int32_t cosine = product(u, n) >> 14, position = rawFromReal(s.position) >> 4;
        if (hollow_) {
            // A hollow faces its roots. Nearer to a long or flat core than where they rest, seeds are no nearer to each other
            // along it.
            for (int i = 0; i < 3 && cosine < 0; ++i)
                n[i] = -n[i];
            cosine = magnitude(cosine);
            position = ball_ ? position : larger(position, 1 << 12);
        }
        const int32_t share = (position << 14) / larger(cosine, leastCosine_);
        const int32_t along = mulShift16(product(s.along, n), share) >> 5, across = mulShift16(product(s.across, n), share) >> 5;
        const bool torn = cosine < uneven_;
        const auto part = [&](int32_t axis, int32_t path, int32_t off) {
            const int32_t sum = (axis * position - (path * off >> 7) + 2048) >> 12;
            return static_cast<int8_t>(torn ? limited(sum, 127) : sum);
        };
        for (int i = 0; i < 3; ++i) {
            s.cellAlong[i] = part(s.along[i], u[i], along);
            s.cellAcross[i] = part(s.across[i], u[i], across);
        }
        even = even && !torn;
    }
    s.cellArea = WHOLE_CELL;
    if (!even)
        return;
    const int8_t *const a = s.cellAlong, *const b = s.cellAcross;
    const int32_t area = (a[1] * b[2] - a[2] * b[1]) * n[0] + (a[2] * b[0] - a[0] * b[2]) * n[1] +
                         (a[0] * b[1] - a[1] * b[0]) * n[2];
    s.cellArea = static_cast<uint16_t>(smaller((magnitude(area) >> 14) + WHOLE_CELL + 1, 16383));
}

// How the surface bends, from the normals of its valid seeds: along the middle ring, and from the first ring to the last.
SELDOM void Shader::measureBend(Patch& patch) const
{
    Bend& bend = patch.bend;
    bend.stale = false;
    bend.inverse = 0;
    if (ball_ && patch.state == PATCH_REST)
        return;
    const Seed *from[2] = {nullptr, nullptr}, *to[2] = {nullptr, nullptr};
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        const Seed *first = seeds_ + patch.first[ring], *last = first + patch.count[ring] - 1;
        while (first <= last && !(first->flags & SEED_VALID))
            ++first;
        while (first <= last && !(last->flags & SEED_VALID))
            --last;
        if (first > last)
            continue;
        if (from[0] == to[0] || (ring == PATCH_RINGS / 2 && first != last)) {
            from[0] = first;
            to[0] = last;
        }
        if (from[1] == nullptr)
            from[1] = first;
        to[1] = first;
    }
    if (from[0] == to[0] || from[1] == to[1])
        return;
    const Seed& centre = object_.regular(patch.centre);
    const Direction14 n = centre.flags & SEED_VALID ? centre.normal : from[0]->normal;
    bend.normal = n;
    int32_t step[2][3], size[2];
    for (int k = 0; k < 2; ++k) {
        const Seed &a = *from[k], &b = *to[k];
        int32_t* const d = step[k];
        for (int i = 0; i < 3; ++i)
            d[i] = b.place[i] - a.place[i];
        size[k] = larger(larger(magnitude(d[0]), magnitude(d[1])), magnitude(d[2]));
        bend.turn[k][0] = static_cast<int16_t>(b.normal.x - a.normal.x);
        bend.turn[k][1] = static_cast<int16_t>(b.normal.y - a.normal.y);
        bend.turn[k][2] = static_cast<int16_t>(b.normal.z - a.normal.z);
        // This step times the normal, or for the second the normal times this step.
        int16_t* const dual = bend.dual[1 - k];
        dual[0] = static_cast<int16_t>((k == 0 ? n.y * d[2] - n.z * d[1] : d[1] * n.z - d[2] * n.y) >> 14);
        dual[1] = static_cast<int16_t>((k == 0 ? n.z * d[0] - n.x * d[2] : d[2] * n.x - d[0] * n.z) >> 14);
        dual[2] = static_cast<int16_t>((k == 0 ? n.x * d[1] - n.y * d[0] : d[0] * n.y - d[1] * n.x) >> 14);
    }
    const int32_t area = product(bend.dual[0], step[0]);
    if (smaller(size[0], size[1]) < 64 || magnitude(area) <= size[0] * size[1] >> 2)
        return;
    // Nothing bends more than a ball of half a unit.
    for (int k = 0; k < 2; ++k)
        if (larger(larger(magnitude(bend.turn[k][0]), magnitude(bend.turn[k][1])), magnitude(bend.turn[k][2])) > size[k] << 7)
            return;
    bend.inverse = (1 << 30) / area;
    // The greater curvature of the two: in its direction the normal of the patch's other seeds differs.
    const int32_t one = product(bend.turn[0], bend.dual[0]), other = product(bend.turn[1], bend.dual[1]);
    bend.most = limited(mulShift16(magnitude(one) > magnitude(other) ? one : other, bend.inverse) >> 4, 1 << 16);
}

// How the brightness changes over a patch, and where it bends out of sight.
inline void Shader::setBend(const Patch& patch, const Seen& middle)
{
    const Bend& bend = patch.bend;
    const auto steps = [&](const int32_t v[3], int k) {
        return (product(bend.dual[k], v) >> 14) * bend.inverse >> 12;
    };
    const int32_t n[] = {bend.normal.x, bend.normal.y, bend.normal.z};
    const int32_t inward = (bend.most * (product(n, own_.light) >> 14)) >> 20;
    const int32_t one = steps(own_.light, 0), other = steps(own_.light, 1);
    int32_t change[3];
    for (int i = 0; i < 3; ++i)
        change[i] = mulShift16(bend.turn[0][i] * one + bend.turn[1][i] * other + n[i] * inward, gradientScale_);
    shading_.gradient[0] = along(change, own_.right, 0) << 3;
    shading_.gradient[1] = along(change, own_.up, 1) << 3;
    shading_.gradientAhead = along(change, own_.ahead, 2) << 3;
    shading_.horizonShare = mulShift16(FLATTEST, horizonScale_);
    if (middle.facing >= facesViewer_)
        return;
    // The curvature along the view.
    const int16_t* const p = middle.seed->place;
    int32_t view[3], away[3];
    for (int i = 0; i < 3; ++i)
        view[i] = (shading_.eye[i] - (p[i] >> 3)) >> viewShift_;
    const int32_t up = product(n, view) >> 14;
    for (int i = 0; i < 3; ++i)
        away[i] = view[i] - (n[i] * up >> 14);
    const int32_t curvature = (product(bend.turn[0], away) >> 14) * steps(away, 0) +
                              (product(bend.turn[1], away) >> 14) * steps(away, 1);
    const int32_t square = product(away, away);
    // A quarter more than the radius at rest, for what scales differ from their cells: next to the limb there may be no other that
    // covers it. What blends bends no less than a ball half as large again.
    const bool rests = patch.state == PATCH_REST;
    if (!rests)
        shading_.horizonShare = ballHorizon_ * 3 >> 1;
    if (curvature > square >> 11)
        shading_.horizonShare = smaller(shading_.horizonShare,
                                        mulShift16((rests ? square * 5 >> 1 : square * 2) / curvature, horizonScale_));
}

// To be called before the seeds of a patch that are seen.
inline void Shader::setPatch(const Patch& patch, const Seen& middle)
{
    const int16_t* const p = middle.seed->place;
    const int32_t depth = larger(centre_[2] + along(p, shading_.toAhead, 2), NEAREST_DEPTH);
    const int32_t depth16 = depth >> 4, most = depth16 + (depth16 >> 1);
    shearX_ = (limited((centre_[0] + along(p, shading_.toRight, 0)) >> 4, most) << 10) / depth16;
    shearY_ = (limited((centre_[1] + along(p, shading_.toUp, 1)) >> 4, most) << 10) / depth16;
    for (int i = 0; i < 3; ++i) {
        const int32_t ahead = own_.ahead[i] * cellScale_ >> 16;
        const int32_t column = ((own_.right[i] * cellScale_ >> 6) - ahead * shearX_ + 8192) >> 14;
        const int32_t row = ((own_.up[i] * cellScale_ >> 6) - ahead * shearY_ + 8192) >> 14;
        shading_.cell[i] = (static_cast<uint32_t>(column) << 16) + static_cast<uint32_t>(row);
    }
    shading_.wholeMost = depth < WHOLE_BEFORE ? 0xffff : WHOLE_CELL;
    const uint32_t share = areaScale_ / static_cast<uint32_t>(depth >> 3);
    shading_.areaShare = static_cast<int32_t>((share < 0x3ffff ? share : 0x3ffff) << 13);
    if (patch.bend.inverse == 0) {
        shading_.gradient[0] = ballGradient_[0];
        shading_.gradient[1] = ballGradient_[1];
        shading_.gradientAhead = ballGradient_[2];
        shading_.horizonShare = ballHorizon_;
    } else {
        setBend(patch, middle);
    }
    if (hollow_)
        shading_.horizonShare = mulShift16(FLATTEST, horizonScale_);
    shading_.gradientAhead = (shading_.gradientAhead + (shading_.gradient[0] * (shearX_ >> 2) >> 8) +
                              (shading_.gradient[1] * (shearY_ >> 2) >> 8)) >> 4;
}

// Where another object is the strongest the scale ends: a straight line, for the difference of two fields is nearly linear
// across it. False: nothing is left.
bool Shader::cut(const Seed& s, Voxel* voxel) const
{
    const int32_t border[] = {s.border.x, s.border.y, s.border.z};
    const int32_t x = along(border, own_.right, 0), y = along(border, own_.up, 1), z = along(border, own_.ahead, 2);
    // A step across the view leads along the ray as well, as far as the scale is tilted.
    const int32_t ahead = z + ((x * shearX_ + y * shearY_) >> 10);
    int32_t cutX = x + (voxel->tiltX * (ahead >> 2) >> 6), cutY = y + (voxel->tiltY * (ahead >> 2) >> 6);
    int32_t at = (s.apart + BORDER_MARGIN) * 64, unit = 1 << 14;
    while (magnitude(cutX) > 127 || magnitude(cutY) > 127) {
        cutX >>= 1;
        cutY >>= 1;
        at >>= 1;
        unit >>= 1;
    }
    if (unit < 16 || (cutX | cutY) == 0)
        return true;
    const int32_t corner = (magnitude(cutX) * voxel->wide + magnitude(cutY) * voxel->high) >> 8;
    if (at >= corner)
        return true;
    if (at <= -corner)
        return false;
    voxel->cutX = static_cast<int8_t>(cutX);
    voxel->cutY = static_cast<int8_t>(cutY);
    voxel->cutAt = static_cast<int16_t>(limited(at, 32000));
    return true;
}

// Measures those of the seeds found that have settled anew, and leaves out those that the viewer does not see. Where two objects
// meet, `anew` becomes true: the border may have moved.
int Shader::measureSeen(Patch& patch, Seen* seen, int count, bool* anew)
{
    int left = 0;
    for (int i = 0; i < count; ++i) {
        Seed& s = *seen[i].seed;
        int32_t facing = seen[i].facing;
        if (facing == 0) {
            measurePlace(s);
            facing = facingOf(s, shading_);
            // What faces away is likely to have moved when it comes into view.
            if (facing > shading_.limb || (s.flags & SEED_RESTING)) {
                if (s.cellArea == 0) {
                    measureCell(s);
                    patch.bend.stale = true;
                }
                s.flags |= SEED_MEASURED;
            }
            if (facing <= shading_.limb)
                continue;
            *anew = *anew || (s.flags & SEED_BORDER);
        }
        seen[left++] = {&s, facing, seen[i].voxel};
    }
    return left;
}

// Leaves out those that are too near or too far.
int Shader::leaveNear(Seen* seen, int count) const
{
    int left = 0;
    for (int i = 0; i < count; ++i) {
        const int32_t depth = centre_[2] + along(seen[i].seed->place, shading_.toAhead, 2);
        if (depth >= NEAREST_DEPTH && depth < FARTHEST_DEPTH)
            seen[left++] = seen[i];
    }
    return left;
}

// Lists a patch as it was shaded last, with its seeds where they are now. False: one of them has settled or ended since.
inline bool Shader::keepPatch(Patch& patch, VoxelList& list) const
{
    if (patch.extras || patch.voxels == nullptr)
        return false;
    int count = list.count;
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        const Seed* s = seeds_ + patch.first[ring];
        Voxel* voxel = patch.voxels + ring * PATCH_SEEDS;
        for (const Seed* const end = s + patch.count[ring]; s < end; ++s, ++voxel) {
            // Seeds that were out of sight stay so: the view has turned by less than what a scale at the limb may face away.
            if ((s->flags & (SEED_VALID | SEED_MEASURED)) == SEED_VALID)
                return false;
            if (voxel->wide <= 0)
                continue;
            if (!(s->flags & SEED_VALID))
                return false;
            placeVoxel(shading_, *s, *voxel);
            list.voxels[count++] = *voxel;
        }
    }
    list.count = count;
    return true;
}

template <bool PAINTED>
inline void Shader::shadePatch(Patch& patch, bool turn, VoxelList& list, Painter* painter)
{
    if (!PAINTED && !turn && !near_ && !patch.bend.stale && keepPatch(patch, list))
        return;
    // The painter lists copies: what is kept has no paint, and gets the one that it has in this frame.
    const auto put = [&](const Seen& seen) {
        if (PAINTED)
            painter->add(*seen.seed, *seen.voxel);
        else
            list.voxels[list.count++] = *seen.voxel;
    };
    Seen seen[SEEDS_MOST];
    int count = findSeeds(&shading_, object_, &patch, seen);
    bool anew = turn || near_;
    if (!(shading_.flags & SEED_MEASURED << 8))
        count = measureSeen(patch, seen, count, &anew);
    if (near_)
        count = leaveNear(seen, count);
    anew = anew || patch.bend.stale;
    for (int i = 0; i < count && !anew; ++i)
        anew = seen[i].voxel == nullptr || seen[i].voxel->wide == OUT_OF_SIGHT;
    if (!anew) {
        // They have hardly moved.
        for (int i = 0; i < count; ++i) {
            placeVoxel(shading_, *seen[i].seed, *seen[i].voxel);
            put(seen[i]);
        }
        return;
    }
    for (int i = 0; patch.voxels != nullptr && i < PATCH_VOXELS; ++i)
        patch.voxels[i].wide = OUT_OF_SIGHT;
    if (count == 0)
        return;
    if (patch.bend.stale)
        measureBend(patch);
    setPatch(patch, seen[count >> 1]);
    Voxel extras[SEEDS_MOST];
    Voxel* room = extras;
    for (int i = 0; i < count; ++i)
        if (seen[i].voxel == nullptr)
            seen[i].voxel = room++;
    shadeSeeds(&shading_, seen, count);
    for (int i = 0; i < count; ++i) {
        if ((seen[i].seed->flags & SEED_BORDER) && !cut(*seen[i].seed, seen[i].voxel))
            seen[i].voxel->wide = OUT_OF_SIGHT;
        else
            put(seen[i]);
    }
}

template <bool PAINTED>
int shadeAs(SoftObject& object, const OwnFrame& own, const FrameContext& frame, Patch* patches, int count, int first,
            const ViewBefore& before, VoxelList& list, int room, Painter* painter)
{
    Shader shader(object, own, frame);
    // The painter may make two voxels of one.
    const int most = (PAINTED ? 2 : 1) * SEEDS_MOST;
    int at = first;
    for (; at < count && list.count + most <= room; ++at) {
        Patch& patch = patches[at];
        if (patch.state == PATCH_MIXED || (patch.state == PATCH_REST && !restsAway(patch, own)))
            shader.shadePatch<PAINTED>(patch, ((static_cast<uint32_t>(at) + before.frames) & before.mask) == 0, list, painter);
    }
    return at;
}

}  // namespace

void ViewBefore::turn(const OwnFrame& own)
{
    int32_t now[10];
    for (int i = 0; i < 3; ++i) {
        now[i] = mulDiv(own.eye32[i], 1 << 14, own.distance32);
        now[i + 3] = own.right[i];
        now[i + 6] = own.ahead[i];
    }
    now[9] = rawFromReal(own.growth) >> 2;
    int32_t most = 0;
    for (int i = 0; i < 10; ++i) {
        most = larger(most, magnitude(now[i] - seen[i]));
        seen[i] = now[i];
    }
    ++frames;
    mask = 0;
    while (mask < 7 && most * static_cast<int32_t>(2 * mask + 1) <= MOST_TURN)
        mask = 2 * mask + 1;
}

int shadePatches(SoftObject& object, const OwnFrame& own, const FrameContext& frame, Patch* patches, int count, int first,
                 ViewBefore& before, VoxelList& list, int room)
{
    if (first == 0)
        before.turn(own);
    if (object.paint() == nullptr)
        return shadeAs<false>(object, own, frame, patches, count, first, before, list, room, nullptr);
    Painter painter(object, own, list);
    return shadeAs<true>(object, own, frame, patches, count, first, before, list, room, &painter);
}
