// From settled seeds to voxels, in whole numbers, because it is done for every seed that is seen.
#include "shade.h"

#include "math/normal.h"
#include "paint.h"

namespace {

template <class Part>
inline int32_t product(const Part a[3], const int32_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline int32_t product(const Direction14& a, const int32_t b[3])
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

// Nearer than this (1/32 unit) nothing is drawn.
constexpr int32_t NEAREST = 32;

// No scale is stretched to more than two and a half times its cell by blending: cosine of path and normal.
constexpr int32_t LEAST_COSINE = 6500;

// What a scale is larger than its cell to each side: a part of the cell (1/32), and what places are uncertain by (1/256 unit).
constexpr int32_t MARGIN = 1;
constexpr int32_t MARGIN_UNITS = 14;

// Beyond this cosine of path and normal a cell lies in no even band of its ring; inverse, 12 bits of fraction.
constexpr int32_t UNEVEN = 4329;

// By how much scales of two objects overlap at their border, 1/256 unit.
constexpr int32_t BORDER_MARGIN = 40;

// Depth, 1/32 unit, before which the whole of a cell is covered: so near the viewer a ring is no straight band in the picture.
constexpr int32_t WHOLE_BEFORE = 64 * 32;

// No depth changes more than this across a scale, 8 bits of fraction.
constexpr int32_t STEEPEST_TILT = 20000;

// Change of brightness (1/8 step) from the middle of a scale to its corner below which it has one brightness.
constexpr int32_t FLAT = 8;

// Half of a way along the surface as it falls on the picture, 1/256 unit, and what the brightness changes by over it, 8 bits
// of fraction.
struct Way {
    int32_t x, y, change;
};

// Two ways, the half axes of a cell, and the area between them.
struct Cell {
    Way along, across;
    int32_t area;
    bool uneven;  // blending has torn its ring out of line
};

// What a scale is besides its place.
struct Scale {
    int32_t facing;        // the seed's normal times the vector to the eye, 1/32 unit
    int32_t depth;         // of the seed along the viewing axis, 1/32 unit
    int32_t tiltX, tiltY;  // as those of its voxel
    int32_t wide, high;
};

// Turns the seeds of one object into voxels. Made once for an object and a frame, and only here, so that the compiler may keep
// it on the stack, where it needs no register to be found. TURNED: the own axes are not those of the view.
template <bool TURNED>
class Shader {
public:
    Shader(const SoftObject& object, const OwnFrame& own, const FrameContext& frame);

    // To be called before the seeds of a patch: from where the viewer sees it.
    void setPatch(const Patch& patch);

    // Lists the voxels of a patch, by way of the painter of objects that have a paint.
    template <bool RESTING, bool PAINTED>
    void shadeSeeds(const Patch& patch, VoxelList& list, Painter* painter) const;

private:
    template <bool RESTING>
    __attribute__((always_inline)) bool shade(const Seed& s, bool oversampled, Voxel* voxel) const;
    template <bool RESTING>
    bool place(const Seed& s, Scale& scale, Voxel* voxel) const;
    template <bool RESTING>
    void cell(const Seed& s, Cell& c) const;
    // A length of own space in the world.
    int32_t grown(int32_t length) const { return grown_ ? mulShift16(length, rawFromReal(own_.growth)) : length; }
    bool atEnd(const Seed& s) const;
    int32_t curvature(const Patch& patch, const int32_t middle[3]);
    template <class Part>
    Way onPicture(const Part axis[3]) const;
    void end(const Scale& scale, Voxel* voxel) const;
    void changes(const Seed& s, Cell& c) const;
    void roundSlopes(const Scale& scale, Voxel* voxel) const;
    bool cut(const Seed& s, const Scale& scale, Voxel* voxel) const;

    const SoftObject& object_;
    const OwnFrame own_;      // a copy, for the same reason
    const Seed* seeds_;
    const Seed* lastSeed_;    // the last regular one
    const Vector* roots_;
    bool grown_;
    int32_t spacing_;         // 1/256 unit of the world
    int32_t limb_;            // a seed that faces the viewer less than this is not drawn, 1/32 unit
    int32_t generalHorizon_;  // radius of curvature of a ball, 1/32 unit
    int32_t flattest_;        // the greatest, 1/32 unit
    int32_t core2_;           // squared distance from which on a root lies at the end of the core, 1/16 unit of own space
    int32_t depth_;           // of the object's centre along the viewing axis, 1/32 unit
    int32_t away_[2];         // the centre from the eye, across the view, 1/32 unit
    int32_t inverseRadius_;   // 2^24 / radius in 1/64 unit
    bool round_ = false;      // the patch bends alike everywhere
    int32_t gradient_[3];     // of the brightness over what is round, 1/8 step a unit with 8 bits of fraction
    // Of the patch: the axes of the picture plane, sheared along the ray through its middle, so that a part of a vector along
    // the view shows sideways; 1.0 = 2^14.
    int32_t column_[3], row_[3];
    int32_t shearX_, shearY_;  // 12 bits of fraction
    // Both times the spacing, column in the upper half, row in the lower, rounded so that a cell has 16 bits; and by what to
    // shift what comes of them.
    uint32_t cellBoth_[3];
    int cellShift_;
    int32_t horizonShare_;    // of the horizon: half of it over the distance of the eye, 16 bits of fraction
    int32_t gradientAhead_;   // how that brightness changes with the depth, 1/8 step a unit with 4 bits of fraction
};

template <bool TURNED>
inline Shader<TURNED>::Shader(const SoftObject& object, const OwnFrame& own, const FrameContext& frame)
    : object_(object), own_(own), seeds_(&object.seed(0)), lastSeed_(&object.seed(object.seedSlots() - 2)), roots_(&object.root(0)),
      grown_(object.size() != object.laidSize()), spacing_(rawFromReal(object.spacing() * own.growth) >> 8)
{
    const Vector place = frame.inView(object.centre());
    depth_ = rawFromReal(place.z) >> 11;
    away_[0] = rawFromReal(place.x) >> 11;
    away_[1] = rawFromReal(place.y) >> 11;
    // On a ball a scale that is seen nearly edge-on adds next to nothing to those before it; on flat parts it may be all
    // there is.
    limb_ = object.coreReach() > Real(0) ? own.distance32 >> 7 : own.distance32 * 5 >> 7;
    generalHorizon_ = rawFromReal(object.horizonRadius(own.eye)) >> 11;
    flattest_ = smaller((rawFromReal(object.radius()) >> 11) + (rawFromReal(object.coreReach()) >> 11) * 4, 8000);
    // A ball ends all round.
    const int32_t reach16 = larger((rawFromReal(object.coreReach() / own.growth) >> 12) - 2, 0);
    core2_ = reach16 * reach16;
    const int32_t radius = (rawFromReal(object.radius()) >> 8) + 1;
    for (int i = 0; i < 3; ++i)
        gradient_[i] = own.light[i] * (BRIGHTEST * 32) / radius;
    inverseRadius_ = (1 << 24) / ((rawFromReal(shiftDown(object.laidSize(), 1)) >> 10) + 1);
}

template <bool TURNED>
inline void Shader<TURNED>::setPatch(const Patch& patch)
{
    // The middle of the patch in the view, 1/32 unit.
    int32_t view[3];
    const int32_t middle[] = {grown(patch.middle[0] * 2), grown(patch.middle[1] * 2), grown(patch.middle[2] * 2)};
    const int32_t* const axes[] = {own_.right, own_.up, own_.ahead};
    for (int i = 0; i < 3; ++i)
        view[i] = TURNED ? product(middle, axes[i]) >> 14 : middle[i];
    const int32_t depth = depth_ + view[2] < NEAREST ? NEAREST : depth_ + view[2];
    const int32_t shearX = limited(((away_[0] + view[0]) << 12) / depth, 5 << 12);
    const int32_t shearY = limited(((away_[1] + view[1]) << 12) / depth, 5 << 12);
    shearX_ = shearX;
    shearY_ = shearY;
    for (int i = 0; i < 3; ++i) {
        column_[i] = own_.right[i] - (own_.ahead[i] * shearX >> 12);
        row_[i] = own_.up[i] - (own_.ahead[i] * shearY >> 12);
    }
    // No axis of the picture plane is longer than this, and no half axis of a cell longer than 128: a sum of products has 16 bits.
    const int32_t longest = ((1 << 14) + (larger(magnitude(shearX), magnitude(shearY)) << 2)) * spacing_ >> 8;
    const int bits = 24 - __builtin_clz(static_cast<uint32_t>(longest) | 0xff);
    const int32_t half = 128 << bits;
    for (int i = 0; i < 3; ++i) {
        const int32_t column = (column_[i] * spacing_ + half) >> (bits + 8), row = (row_[i] * spacing_ + half) >> (bits + 8);
        cellBoth_[i] = (static_cast<uint32_t>(column) << 16) + static_cast<uint32_t>(row);
    }
    cellShift_ = 28 - bits;
    int32_t horizon = generalHorizon_;
    if (TURNED && patch.state == PATCH_REST)
        horizon = curvature(patch, middle);
    else if (TURNED)
        horizon = rawFromReal(object_.horizonAt(roots_[object_.seed(patch.centre).root], realFromRaw(generalHorizon_ << 11))) >> 11;
    horizonShare_ = (smaller(horizon, 8000) << 15) / own_.distance32;
    gradientAhead_ = (gradient_[2] + (gradient_[0] * (shearX >> 4) >> 8) + (gradient_[1] * (shearY >> 4) >> 8)) >> 4;
}

// Place, tilt and brightness. False: it faces away.
template <bool TURNED>
template <bool RESTING>
inline bool Shader<TURNED>::place(const Seed& s, Scale& scale, Voxel* voxel) const
{
    Vector place = RESTING || (s.flags & SEED_RESTING) ? s.path : s.path * s.position;
    if (TURNED)
        place = place + roots_[s.root];
    if (grown_)
        place = place * own_.growth;
    const int32_t x = rawFromReal(place.x) >> 8, y = rawFromReal(place.y) >> 8, z = rawFromReal(place.z) >> 8;
    const Direction14 n = s.normal;
    const int32_t facing =
        (n.x * (own_.eye32[0] - (x >> 3)) + n.y * (own_.eye32[1] - (y >> 3)) + n.z * (own_.eye32[2] - (z >> 3))) >> 14;
    if (facing <= limb_)
        return false;
    int32_t ahead = z;
    if (TURNED)
        ahead = (x * own_.ahead[0] + y * own_.ahead[1] + z * own_.ahead[2]) >> 14;
    const int32_t depth = depth_ + (ahead >> 3);
    if (depth < NEAREST)
        return false;
    voxel->z = ahead;
    // The tangent plane: depth changes by n.x depth / (n . to eye) for a unit across the view.
    const int32_t steep = (depth << 8) / facing;
    int32_t tiltX, tiltY;
    if (TURNED) {
        voxel->x = (x * own_.right[0] + y * own_.right[1] + z * own_.right[2]) >> 14;
        voxel->y = (x * own_.up[0] + y * own_.up[1] + z * own_.up[2]) >> 14;
        tiltX = (product(n, own_.right) >> 14) * steep >> 14;
        tiltY = (product(n, own_.up) >> 14) * steep >> 14;
    } else {
        voxel->x = x;
        voxel->y = y;
        tiltX = n.x * steep >> 14;
        tiltY = n.y * steep >> 14;
    }
    if (steep > STEEPEST_TILT) {
        tiltX = limited(tiltX, STEEPEST_TILT);
        tiltY = limited(tiltY, STEEPEST_TILT);
    }
    voxel->tiltX = static_cast<int16_t>(tiltX);
    voxel->tiltY = static_cast<int16_t>(tiltY);
    voxel->cutX = voxel->cutY = 0;
    voxel->cutAt = 0;
    voxel->brightness = static_cast<uint8_t>((s.brightness8 + 128) >> 8);
    scale.facing = facing;
    scale.depth = depth;
    scale.tiltX = tiltX;
    scale.tiltY = tiltY;
    return true;
}

// Whether the root of a seed lies where the core ends.
template <bool TURNED>
inline bool Shader<TURNED>::atEnd(const Seed& s) const
{
    const Vector& root = roots_[s.root];
    const int32_t root16[] = {rawFromReal(root.x) >> 12, rawFromReal(root.y) >> 12, rawFromReal(root.z) >> 12};
    return product(root16, root16) >= core2_;
}

// How a patch at rest bends. All that is no ball is turned about its y axis: round that it bends by n.r / r, with r the way from
// the axis; in the plane of the axis as a ball does where its core ends, else not at all. Returned is the radius of curvature
// along the view and a quarter, 1/32 unit, the greatest where it is flat or hollow. Sets the gradient of the brightness, too.
template <bool TURNED>
inline int32_t Shader<TURNED>::curvature(const Patch& patch, const int32_t middle[3])
{
    const bool end = atEnd(object_.seed(patch.centre));
    const int last = PATCH_RINGS - 1;
    round_ = end == atEnd(seeds_[patch.first[0]]) && (patch.count[last] == 0 || end == atEnd(seeds_[patch.first[last]]));
    const int32_t radius = grown(patch.path * 2);
    const int32_t x = middle[0], y = middle[1], z = middle[2];
    const Normal out = normalise({realFromRaw(x << 8), Real(0), realFromRaw(z << 8)});
    const Normal view = normalise({realFromRaw((x - own_.eye32[0]) << 8), realFromRaw((y - own_.eye32[1]) << 8),
                                   realFromRaw((z - own_.eye32[2]) << 8)});
    const int32_t away = (x * out.x + z * out.z) >> 14;
    const int32_t* const light = own_.light;
    int32_t change[] = {light[0], light[1], light[2]};
    // Radius over radius of curvature, 1.0 = 2^14.
    int32_t bend = 1 << 14;
    if (!end || away > radius >> 1) {
        const int32_t round = (view.z * out.x - view.x * out.z) >> 14;
        const int32_t share = round * round >> 14;
        const int32_t outward = (patch.axis[0] * out.x + patch.axis[2] * out.z) >> 14;
        const int32_t hoop = away > 0 ? limited(outward * radius / away, 1 << 15) : 0;
        bend = (end ? bend - share : 0) + (share * hoop >> 14);
        if (end) {
            const int32_t part = ((hoop - (1 << 14)) * ((light[2] * out.x - light[0] * out.z) >> 14)) >> 14;
            change[0] -= part * out.z >> 14;
            change[2] += part * out.x >> 14;
        } else {
            // Without what points along the straight lines of the surface, which lie in the plane of the axis.
            const int32_t upward = patch.axis[1];
            const int32_t along = (outward * light[1] - upward * ((light[0] * out.x + light[2] * out.z) >> 14)) >> 14;
            const int32_t inward = upward * along >> 14;
            change[0] = hoop * (light[0] + (inward * out.x >> 14)) >> 14;
            change[1] = hoop * (light[1] - (outward * along >> 14)) >> 14;
            change[2] = hoop * (light[2] + (inward * out.z >> 14)) >> 14;
        }
    }
    const int32_t scale = (BRIGHTEST << 10) / (radius + 1);
    gradient_[0] = (product(change, own_.right) >> 14) * scale >> 8;
    gradient_[1] = (product(change, own_.up) >> 14) * scale >> 8;
    gradient_[2] = (product(change, own_.ahead) >> 14) * scale >> 8;
    // A quarter more, for what its scales differ from their cells: next to the limb there may be no other that covers it.
    return bend * (flattest_ >> 4) <= radius << 10 ? flattest_ : (radius * 5 << 12) / bend;
}

// A half axis of a cell, as the seeds have it, or as short a vector: both sums of products are one, each 16 bits wide.
template <bool TURNED>
template <class Part>
inline Way Shader<TURNED>::onPicture(const Part axis[3]) const
{
    const uint32_t sum = static_cast<uint32_t>(axis[0]) * cellBoth_[0] + static_cast<uint32_t>(axis[1]) * cellBoth_[1] +
                         static_cast<uint32_t>(axis[2]) * cellBoth_[2];
    return {static_cast<int32_t>(sum + 0x8000) >> cellShift_, static_cast<int32_t>(sum << 16) >> cellShift_, 0};
}

// The cell of the unblended surface that is the seed's own, grown with the position, as it falls along the path onto the
// tangent plane. A half axis e becomes e - u (e.n) / (u.n) with u the path.
template <bool TURNED>
template <bool RESTING>
inline void Shader<TURNED>::cell(const Seed& s, Cell& c) const
{
    c.along = onPicture(s.along);
    c.across = onPicture(s.across);
    c.uneven = false;
    if (!RESTING && !(s.flags & SEED_RESTING)) {
        // The path over the radius, 1.0 = 2^14, and its cosine to the normal.
        const int32_t u[] = {mulShift16(rawFromReal(s.path.x), inverseRadius_) >> 4,
                             mulShift16(rawFromReal(s.path.y), inverseRadius_) >> 4,
                             mulShift16(rawFromReal(s.path.z), inverseRadius_) >> 4};
        int32_t cosine = product(s.normal, u) >> 14;
        if (cosine < LEAST_COSINE)
            cosine = LEAST_COSINE;
        const int32_t inverse = (1 << 26) / cosine;  // 12 bits of fraction
        c.uneven = inverse > UNEVEN;
        const int32_t position = rawFromReal(s.position) >> 8;
        // (e.n) / (u.n), 1/64 spacing with 8 bits of fraction.
        const int32_t n[] = {s.normal.x, s.normal.y, s.normal.z};
        const int32_t offAlong = (product(s.along, n) >> 8) * inverse >> 10;
        const int32_t offAcross = (product(s.across, n) >> 8) * inverse >> 10;
        const int32_t short7[] = {(u[0] + 64) >> 7, (u[1] + 64) >> 7, (u[2] + 64) >> 7};
        const Way path = onPicture(short7);
        c.along.x = (c.along.x - (offAlong * path.x >> 15)) * position >> 8;
        c.along.y = (c.along.y - (offAlong * path.y >> 15)) * position >> 8;
        c.across.x = (c.across.x - (offAcross * path.x >> 15)) * position >> 8;
        c.across.y = (c.across.y - (offAcross * path.y >> 15)) * position >> 8;
    }
    c.area = c.along.x * c.across.y - c.along.y * c.across.x;
}

// Half width and height of the scale. Beside each other, cells of a ring make a band: rectangles as wide as the way from one
// to the next need not cover the whole of their cells, only, together, the band.
inline void extents(const Cell& c, bool whole, Scale& scale, Voxel* voxel)
{
    int32_t width = magnitude(c.along.x), height = magnitude(c.along.y);
    if (whole) {
        width += magnitude(c.across.x);
        height += magnitude(c.across.y);
    } else if (width > height) {
        height += magnitude(c.area) / width;
    } else if (height > 0) {
        width += magnitude(c.area) / height;
    }
    scale.wide = smaller(width + (width >> 5) * MARGIN + MARGIN_UNITS, 32000);
    scale.high = smaller(height + (height >> 5) * MARGIN + MARGIN_UNITS, 32000);
    voxel->wide = static_cast<int16_t>(scale.wide);
    voxel->high = static_cast<int16_t>(scale.high);
}

// Where a round surface bends out of sight its tangent plane goes on: the scale ends there. The limb is cos^2 radius / 2
// away across the view, with cos the cosine of normal and viewer; along the plane that is cos radius / 2 deep.
template <bool TURNED>
inline void Shader<TURNED>::end(const Scale& scale, Voxel* voxel) const
{
    const int32_t reach = mulShift16(horizonShare_, scale.facing) + 1;
    voxel->reach = 0;
    if (reach < 256 && (magnitude(scale.tiltX) * scale.wide + magnitude(scale.tiltY) * scale.high) >> 11 >= reach)
        voxel->reach = static_cast<uint8_t>(reach);
}

// How the brightness changes across the scale, 1/8 step a unit; not at all when that is next to nothing.
inline void setSlopes(int32_t x, int32_t y, const Scale& scale, Voxel* voxel)
{
    int32_t corner = (magnitude(x) * scale.wide + magnitude(y) * scale.high) >> 8;
    if (corner < FLAT)
        return;
    for (; corner > SHADING_MOST * 8; corner >>= 1) {
        x /= 2;
        y /= 2;
    }
    voxel->slopeX = static_cast<int8_t>(limited(x, 127));
    voxel->slopeY = static_cast<int8_t>(limited(y, 127));
}

// The same from its change along two ways.
inline void slopes(const Cell& c, const Scale& scale, Voxel* voxel)
{
    if ((c.along.change | c.across.change) == 0 || magnitude(c.area) < 512)
        return;
    const int32_t inverse = ((1 << 28) / c.area) * 128;
    setSlopes(mulHigh(c.along.change * c.across.y - c.across.change * c.along.y, inverse),
              mulHigh(c.along.x * c.across.change - c.across.x * c.along.change, inverse), scale, voxel);
}

// The same where nothing blends with it, by its curvature.
template <bool TURNED>
inline void Shader<TURNED>::roundSlopes(const Scale& scale, Voxel* voxel) const
{
    setSlopes((gradient_[0] + (scale.tiltX * gradientAhead_ >> 4)) >> 8, (gradient_[1] + (scale.tiltY * gradientAhead_ >> 4)) >> 8,
              scale, voxel);
}

// Where another object is the strongest the scale ends: a straight line, for the difference of two fields is nearly linear
// across it. False: nothing is left.
template <bool TURNED>
inline bool Shader<TURNED>::cut(const Seed& s, const Scale& scale, Voxel* voxel) const
{
    int32_t x = s.border.x, y = s.border.y, z = s.border.z;
    if (TURNED) {
        x = product(s.border, own_.right) >> 14;
        y = product(s.border, own_.up) >> 14;
        z = product(s.border, own_.ahead) >> 14;
    }
    // A step across the view leads along the ray as well, as far as the scale is tilted.
    const int32_t along = z + ((x * shearX_ + y * shearY_) >> 12);
    int32_t cutX = x + (scale.tiltX * (along >> 2) >> 6), cutY = y + (scale.tiltY * (along >> 2) >> 6);
    int32_t at = (s.apart + BORDER_MARGIN) * 64;
    while (magnitude(cutX) > 127 || magnitude(cutY) > 127) {
        cutX >>= 1;
        cutY >>= 1;
        at >>= 1;
    }
    if ((cutX | cutY) == 0)
        return true;
    const int32_t corner = (magnitude(cutX) * scale.wide + magnitude(cutY) * scale.high) >> 8;
    if (at >= corner)
        return true;
    if (at <= -corner)
        return false;
    voxel->cutX = static_cast<int8_t>(cutX);
    voxel->cutY = static_cast<int8_t>(cutY);
    voxel->cutAt = static_cast<int16_t>(limited(at, 32000));
    return true;
}

// How the brightness changes along the half axes of a cell. Along the ring: to the next seed of it, or at its end from the
// one before. Across: from N.
template <bool TURNED>
inline void Shader<TURNED>::changes(const Seed& s, Cell& c) const
{
    const Seed &next = (&s)[1], &last = (&s)[-1], &n = object_.seed(s.neighbour);
    c.along.change = c.across.change = 0;
    if (&next <= lastSeed_ && (next.flags & SEED_VALID) && next.neighbour >= s.neighbour)
        c.along.change = (next.brightness8 - s.brightness8) >> 1;
    else if (&last >= seeds_ && (last.flags & SEED_VALID))
        c.along.change = (s.brightness8 - last.brightness8) >> 1;
    if (n.flags & SEED_VALID)
        c.across.change = (s.brightness8 - n.brightness8 + (c.along.change * s.aside >> 5)) >> 1;
}

template <bool TURNED>
template <bool RESTING>
inline bool Shader<TURNED>::shade(const Seed& s, bool oversampled, Voxel* voxel) const
{
    Scale scale;
    if (!place<RESTING>(s, scale, voxel))
        return false;
    Cell c;
    cell<RESTING>(s, c);
    extents(c, oversampled || c.uneven || scale.depth < WHOLE_BEFORE, scale, voxel);
    end(scale, voxel);
    if (!RESTING && (s.flags & SEED_BORDER) && !cut(s, scale, voxel))
        return false;
    voxel->slopeX = voxel->slopeY = 0;
    if ((TURNED ? RESTING && round_ : RESTING || (s.flags & SEED_RESTING)) && s.brightness8 > 0) {
        roundSlopes(scale, voxel);
    } else if (!oversampled && s.neighbour >= 0) {
        changes(s, c);
        slopes(c, scale, voxel);
    }
    return true;
}

template <bool TURNED>
template <bool RESTING, bool PAINTED>
inline void Shader<TURNED>::shadeSeeds(const Patch& patch, VoxelList& list, Painter* painter) const
{
    Voxel bare;
    Voxel* voxel = PAINTED ? &bare : list.room();
    const auto add = [&](const Seed& s, bool oversampled) {
        if (shade<RESTING>(s, oversampled, voxel)) {
            if (PAINTED) {
                painter->add(s, bare);
            } else {
                list.take();
                ++voxel;
            }
        }
    };
    for (int ring = 0; ring < PATCH_RINGS; ++ring) {
        for (int i = patch.first[ring], end = i + patch.count[ring]; i < end; ++i) {
            if (RESTING || (seeds_[i].flags & SEED_VALID))
                add(seeds_[i], false);
            // Of those at rest only the regular ones are there.
            const Seed* const extra = RESTING || !patch.extras ? nullptr : object_.extra(2 * i);
            constexpr int NEEDED = SEED_ACTIVE | SEED_VALID;
            if (extra != nullptr && (extra->flags & NEEDED) == NEEDED)
                add(*extra, true);
        }
    }
}

template <bool TURNED, bool PAINTED>
int shadeAs(const SoftObject& object, const OwnFrame& own, const FrameContext& frame, const Patch* patches, int count, int first,
            VoxelList& list, int room, Painter* painter)
{
    Shader<TURNED> shader(object, own, frame);
    // The painter may make two voxels of one.
    const int most = (PAINTED ? 4 : 2) * PATCH_RINGS * PATCH_SEEDS;
    int at = first;
    for (; at < count && list.count + most <= room; ++at) {
        const Patch& patch = patches[at];
        if (patch.state != PATCH_MIXED && (patch.state != PATCH_REST || restsAway(patch, own)))
            continue;
        shader.setPatch(patch);
        if (patch.state == PATCH_REST) {
            shader.template shadeSeeds<true, PAINTED>(patch, list, painter);
        } else {
            shader.template shadeSeeds<false, PAINTED>(patch, list, painter);
        }
    }
    return at;
}

}  // namespace

int shadePatches(const SoftObject& object, const OwnFrame& own, const FrameContext& frame, const Patch* patches, int count,
                 int first, VoxelList& list, int room)
{
    if (object.paint() != nullptr) {
        Painter painter(object, own, list);
        return shadeAs<true, true>(object, own, frame, patches, count, first, list, room, &painter);
    }
    return object.isBall() && !frame.axes.turned ? shadeAs<false, false>(object, own, frame, patches, count, first, list, room, nullptr)
                           : shadeAs<true, false>(object, own, frame, patches, count, first, list, room, nullptr);
}
