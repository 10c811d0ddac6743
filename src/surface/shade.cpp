// From settled seeds to voxels, in whole numbers, because this is done for every visible seed. What the seeds of a patch have in
// common is computed once for the patch.
#include "shade.h"

#include "bend.h"
#include "border.h"
#include "limb.h"
#include "math/normal.h"
#include "math/whole.h"
#include "paint.h"
#include "rt.h"
#include "slopes.h"
#include "voxels.h"

namespace {

// The slopes of the object that is being shaded. They are too large for the stack, and their table need not be cleared for the next
// object.
Slopes slopes;

// 1/256 unit: a scale in the territory of another object is moved this much deeper, so that it is seen only where that object has
// none.
constexpr int32_t BEHIND = 64;

// 1/256 unit: at a smaller depth scales cover the whole of their cells, because so near the viewer a ring is no straight band.
constexpr int32_t WHOLE_BEFORE = 64 * 256;

// Half spacings: where the limb is nearer than this a scale covers the whole of its cell, because the next scale of its band, which
// would cover the rest, may face away.
constexpr int32_t WHOLE_AT_LIMB = 4;

// 1/32 unit: the greatest radius of curvature that is told from flat.
constexpr int32_t LONGEST_RADIUS = 8000;

// 1/4 step: a patch bends unevenly if its gradient predicts the brightness of some seed with an error greater than this. The first
// is for patches at rest of objects that are not shaped, the second for all others.
constexpr int32_t UNEVEN_AT_REST = 9, UNEVEN_SHADING = 6;

// Spacings: of patches at rest that bend unevenly, scales are domed if the radius of the object is smaller than this.
constexpr Real THIN_RADIUS(3.5);

// Spacings: upper bound on the change of depth from the middle of a scale that ends to its corner. Without it, scales next to the
// limb would come far beyond the outline where seeds have parted.
constexpr int32_t DEEPEST = 8;

// A scale that is domed ends farther behind its centre by the depth of a dome where scales overlap, the spacing over 2^DOME_SHIFT.
constexpr int DOME_SHIFT = 4;

// Spacings: scales that end are drawn as far as this before their centres. Farther before them the tangent plane is well before the
// surface, and the scales beside them cover it.
constexpr int32_t FRONT = 1;

// Turns the seeds of one object into voxels. One is made for each object and frame.
class Shader {
public:
    Shader(SoftObject& object, const OwnFrame& own, const FrameContext& frame);

    // Lists the voxels of those patches from `first` on that may be seen, as long as there is room for `room` voxels. Those of an
    // object that has a paint go through the painter. Returns the first patch that is left.
    template <bool PAINTED>
    int shade(Patch* patches, int count, int first, VoxelList& list, int room, Painter* painter, Keeper& keeper);

    // The spacing of the object's seeds, 1/256 unit.
    int32_t spacing() const { return spacing_; }

private:
    // How the voxels of a patch are listed.
    struct Listing {
        bool shines;    // the object's finish shines
        bool knows;     // some seeds know how the light changes about their voxels
        bool domed;     // its scales are domed, but those that end at a limb that is known
        int regular;    // so many of the voxels are those of regular seeds; they come first
        int sloped;     // so many of them get slopes from those beside them
        int32_t sight;  // Slopes::add() of these
    };

    template <bool PAINTED>
    void shadePatch(Patch& patch, VoxelList& list, Painter* painter);
    int findSeen(const Patch& patch, Voxel* voxels, int* regular);
    void shadeSeen(Patch& patch, Voxel* voxels, int count);
    bool cutAtBorder(const Seed& s, Voxel* voxel, VoxelList& list) const;
    static Voxel* listUnpainted(const Seed& s, const Voxel* voxel, VoxelList& list);
    Listing listingOf(const Patch& patch, bool shines, bool uneven, int regular) const;
    template <bool PAINTED>
    bool listVoxel(const Patch& patch, const Listing& how, int i, const Seen& seen, Voxel* voxel, VoxelList& list,
                   Painter* painter);
    template <bool PAINTED>
    void listVoxels(const Patch& patch, Voxel* voxels, int count, const Listing& how, VoxelList& list, Painter* painter);
    int findExtras(const Patch& patch, Seen* seen, Voxel* voxels) const;
    int clipDepth(Seen* seen, Voxel* voxels, int count) const;
    void setPatch(const Patch& patch, const Seen& middle, const Voxel& at);
    void setBend(const Patch& patch, const Seen& middle);
    bool bendsUnevenly(const Patch& patch, const Voxel* voxels, int count) const;
    bool cut(const int32_t inward[3], int32_t apart, Voxel* voxel) const;
    bool cutAtRidge(const Seed& s, Voxel* voxel) const;
    bool endBeside(const Seed& s, Voxel* voxel, VoxelList& list) const;
    template <bool PAINTED>
    void addSloped(const Seed& s, Voxel* shown, int32_t sight, VoxelList& list);
    bool knowsLight(const Seed& s, bool regular, const Voxel& voxel) const;
    void setSlopesOf(const Seed& s, Voxel* voxel) const;
    const Limb* limbOf(const Patch& patch);
    void endAtLimb(const Patch& patch, const Seen& seen, Voxel* voxel);
    void dome(Voxel* voxel) const;
    void endOrDome(const Patch& patch, const Seen& seen, bool regular, bool domed, Voxel* shown);
    bool isUneven(const Patch& patch, const Voxel* voxels, int regular) const;
    // Whether the limb of a patch is known even if the patch bends unevenly: it rests, and the object is not shaped.
    bool knowsLimb(const Patch& patch) const { return patch.state == PATCH_REST && !object_.shaped(); }
    // The component of a vector of own space along axis i of the view.
    template <class Part>
    int32_t along(const Part v[3], const int32_t axis[3], int i) const
    {
        return shading_.turned ? dot(v, axis) >> 14 : v[i];
    }

    SoftObject& object_;
    const OwnFrame own_;
    Shading shading_;
    int32_t spacing_;         // spacing of the seeds, 1/256 unit of the world, at most 2800
    int32_t step_;            // length of a step of places, 1/256 unit of the world with 16 fraction bits
    int32_t ballBend_;        // curvature of a ball: 1 / radius, per unit, 1.0 = 2^14
    int32_t nearLimb_;        // Voxel::back where the limb is WHOLE_AT_LIMB away, 16 more fraction bits
    bool clipsDepth_;         // some seeds may be nearer than NEAREST_DEPTH, or farther than FARTHEST_DEPTH
    int viewShift_;           // right shift that brings vectors to the eye to 14 bits
    const bool hollow_;       // the seeds sample a hollow
    const bool thin_;         // the radius of the object is small against the spacing of its seeds
    int32_t ballGradient_[3]; // gradient of the brightness over a ball, axes of the view, 1/8 step a unit with 8 fraction bits
    int32_t ballHorizon_, flatHorizon_;  // Shading::horizonShare of a ball and of flat patches
    int32_t horizonScale_;    // horizonShare of a radius of curvature of 8 steps of places
    int32_t lights_[3][6];    // products of the light and the axes of the view, scaled so that turns become gradients (setBend())
    int32_t columns_[3], rows_[3], aheads_[3];  // axes of the view for Shading::cell, 14 more fraction bits; aheads_: 4 more
    ViewProducts axes_;       // for findLimb(), if hasAxes_
    bool hasAxes_ = false;
    uint32_t areaScale_;      // squared spacing, for Shading::areaShare
    // The current patch:
    int32_t ahead_;           // gradient of the brightness along the view, 1/8 step a unit with 8 fraction bits
    int32_t shearX_, shearY_; // how far the ray through the patch leads aside over a unit of depth, 10 fraction bits
    int32_t middle_;          // depth of the patch, 1/256 unit
    bool limbSought_, hasLimb_;
    Limb limb_;               // limb of its regular seeds, if hasLimb_
    Seen seen_[PATCH_SEEDS_MOST];   // its seeds of which voxels have been listed
};

Shader::Shader(SoftObject& object, const OwnFrame& own, const FrameContext& frame)
    : object_(object), own_(own), hollow_(!object.hasSurface()),
      thin_(object.laidRadius() < object.spacing() * THIN_RADIUS)
{
    shading_.seeds = &object.regular(0);
    shading_.roots = &object.root(0);
    const int32_t reach = rawFromReal(object.reach()) >> 8;
    clipsDepth_ = own_.centre[2] - reach < NEAREST_DEPTH || own_.centre[2] + reach >= FARTHEST_DEPTH;
    shading_.placeShift = object.placeShift();
    const int32_t step = step_ = rawFromReal(own.growth) << (shading_.placeShift - 8);
    shading_.turned = object.turnsSeeds() || object.size() != object.laidSize() || frame.axes.turned;
    shading_.depth = own_.centre[2];
    const int32_t* const axes[] = {own.right, own.up, own.ahead};
    const int32_t radius = rawFromReal(object.radius());
    const int32_t gradientScale = mulDiv(BRIGHTEST << 15, 1 << (19 - shading_.placeShift), rawFromReal(own.growth));
    for (int i = 0; i < 3; ++i) {
        shading_.eye[i] = own.eye32[i] >> (shading_.placeShift - 8);
        shading_.light[i] = own.light[i];
        shading_.right[i] = mulDiv(own.right[i], 1 << 16, step);
        shading_.up[i] = mulDiv(own.up[i], 1 << 16, step);
        shading_.toRight[i] = mulShift16(own.right[i], step);
        shading_.toUp[i] = mulShift16(own.up[i], step);
        shading_.toAhead[i] = mulShift16(own.ahead[i], step);
        findProducts(own.light, axes[i], lights_[i]);
        for (int32_t& light : lights_[i])
            light = mulShift16(light, gradientScale);
        ballGradient_[i] = (dot(own.light, axes[i]) >> 14) * (BRIGHTEST * 32) / ((radius >> 8) + 1);
    }
    const int32_t distance = own.distance32 >> (shading_.placeShift - 8);
    shading_.limb = distance * own.limb >> 11;
    viewShift_ = max32(0, 18 - __builtin_clz(static_cast<uint32_t>(distance + 4096)));
    // Distance of the eye, 1/32 unit of the world.
    const int32_t distance32 = max32(mulShift16(own.distance32, rawFromReal(own.growth)), 1);
    // horizonShare is multiplied by Seen::facing: the product must not overflow 32 bits.
    const int32_t farthest = distance * 8 + (rawFromReal(object.laidReach()) >> shading_.placeShift);
    const int32_t horizonMost = INT32_MAX / (farthest + 1);
    ballHorizon_ = min32(mulShift16((min32(radius >> 11, LONGEST_RADIUS) << 12) / distance32, step), horizonMost);
    horizonScale_ = mulShift16(mulDiv(step, 1 << 12, distance32), step);
    flatHorizon_ = min32(mulShift16(LONGEST_RADIUS, horizonScale_), horizonMost);
    ballBend_ = (1 << 22) / max32(mulShift16(rawFromReal(object.laidRadius()) >> 8, rawFromReal(own.growth)), 128);
    const int32_t spacing = spacing_ = min32(rawFromReal(object.spacing() * own.growth) >> 8, 2800);
    shading_.deepest = spacing * DEEPEST;
    shading_.front = min32(spacing * FRONT >> 3, ENDS_MOST);
    nearLimb_ = (spacing * WHOLE_AT_LIMB >> 5) << 16;
    areaScale_ = static_cast<uint32_t>(mulShift16(spacing * spacing << 7, step));
    shading_.cellShift = __builtin_clz(static_cast<uint32_t>(spacing)) - 19;
    if (spacing << shading_.cellShift > 6143)
        --shading_.cellShift;
    // The spacing times a power of 2: 3072..6143, so that cells fit 16 bits.
    const int32_t cell = spacing << shading_.cellShift;
    for (int i = 0; i < 3; ++i) {
        columns_[i] = (own.right[i] * cell >> 6) + 8192;
        rows_[i] = (own.up[i] * cell >> 6) + 8192;
        aheads_[i] = own.ahead[i] * cell >> 16;
    }
    // Seeds of a hollow that settle nearer to a long or flat core than where they rest get no nearer to each other along the core.
    shading_.leastPosition = hollow_ && !object.isBall() ? 1 << 8 : 0;
}

// Sets how the brightness changes over a patch, and where the patch bends out of sight.
inline void Shader::setBend(const Patch& patch, const Seen& middle)
{
    const Bend& bend = patch.bend;
    shading_.gradient[0] = turnOf(bend, lights_[0]) >> 11;
    shading_.gradient[1] = turnOf(bend, lights_[1]) >> 11;
    shading_.gradientAhead = turnOf(bend, lights_[2]) >> 11;
    // The curvature along the ray of sight. Next to the limb the ray lies in the tangent plane. Where the patch's middle faces the
    // viewer more, the bend counts along its normal as well, or the curvature would seem to be too small for the seeds at the limb.
    int32_t p[3], view[3];
    findPlace(shading_, *middle.seed, p);
    for (int i = 0; i < 3; ++i)
        view[i] = (shading_.eye[i] - (p[i] >> 3)) >> viewShift_;
    const int32_t square = dot(view, view), curvature = curvatureAlong(bend, view);
    // A blending patch is taken to bend no less than an unblended ball as large as the object.
    shading_.horizonShare = patch.state == PATCH_REST ? flatHorizon_ : ballHorizon_;
    // What bends less is as good as flat, and its radius might overflow.
    if (curvature > square >> 16)
        shading_.horizonShare = min32(shading_.horizonShare, mulShift16(square * 2 / curvature, horizonScale_));
}

// Makes a patch current. Must be called before its visible seeds are shaded.
inline void Shader::setPatch(const Patch& patch, const Seen& middle, const Voxel& at)
{
    const int32_t depth = own_.centre[2] + at.z;
    middle_ = depth;
    limbSought_ = false;
    const int32_t depth16 = depth >> 4, most = depth16 + (depth16 >> 1);
    shearX_ = (limited((own_.centre[0] + at.x) >> 4, most) << 10) / depth16;
    shearY_ = (limited((own_.centre[1] + at.y) >> 4, most) << 10) / depth16;
    for (int i = 0; i < 3; ++i) {
        const int32_t column = (columns_[i] - aheads_[i] * shearX_) >> 14, row = (rows_[i] - aheads_[i] * shearY_) >> 14;
        shading_.cell[i] = (static_cast<uint32_t>(column) << 16) + static_cast<uint32_t>(row);
    }
    const uint32_t share = areaScale_ / static_cast<uint32_t>(depth >> 3);
    shading_.areaShare = static_cast<int32_t>((share < 0x3ffff ? share : 0x3ffff) << 13);
    if (patch.bend.ball) {
        shading_.gradient[0] = ballGradient_[0];
        shading_.gradient[1] = ballGradient_[1];
        shading_.gradientAhead = ballGradient_[2];
        shading_.horizonShare = ballHorizon_;
    } else {
        setBend(patch, middle);
    }
    if (hollow_)
        shading_.horizonShare = flatHorizon_;
    shading_.wholeBefore = depth < WHOLE_BEFORE ? INT32_MAX : nearLimb_ / max32(shading_.horizonShare, 1);
    ahead_ = shading_.gradientAhead;
    shading_.gradientAhead = (shading_.gradientAhead + (shading_.gradient[0] * (shearX_ >> 2) >> 8) +
                              (shading_.gradient[1] * (shearY_ >> 2) >> 8)) >> 4;
    // As many fraction bits as a tilt times gradientAhead has.
    shading_.gradient[0] *= 16;
    shading_.gradient[1] *= 16;
}

// Whether the gradient of the current patch predicts the brightness of its seeds badly.
inline bool Shader::bendsUnevenly(const Patch& patch, const Voxel* voxels, int count) const
{
    const int32_t most = knowsLimb(patch) ? UNEVEN_AT_REST : UNEVEN_SHADING;
    const Voxel& middle = voxels[count >> 1];
    const int32_t gradientX = shading_.gradient[0] >> 10, gradientY = shading_.gradient[1] >> 10, gradientZ = ahead_ >> 6;
    const auto errs = [&](const Voxel& v) {
        const int32_t x = v.x - middle.x, y = v.y - middle.y, z = v.z - middle.z;
        const int32_t change = (gradientX * x + gradientY * y + gradientZ * z) >> 11;
        return v.brightness != 0 && magnitude(change - (v.brightness - middle.brightness) * 4) > most;
    };
    for (int i = 0; i < count; i += 2)
        if (errs(voxels[i]))
            return true;
    return false;
}

// Cuts a voxel at a plane that is `apart` away from its centre, 1/256 unit. `inward` points to the side that stays, own axes.
// Returns false when nothing of the voxel is left.
inline bool Shader::cut(const int32_t inward[3], int32_t apart, Voxel* voxel) const
{
    const int32_t x = along(inward, own_.right, 0), y = along(inward, own_.up, 1), z = along(inward, own_.ahead, 2);
    return cutVoxel(x, y, z, apart, shearX_, shearY_, voxel);
}

// Ends the scale of a seed beside a ridge where the tangent planes of the two sides meet: beyond that line it would stand out over
// the other side. Returns false when nothing of the voxel is left.
SELDOM bool Shader::cutAtRidge(const Seed& s, Voxel* voxel) const
{
    const Seed& beyond = object_.regular(s.beyond);
    if (!(beyond.flags & SEED_VALID) || isCut(*voxel))
        return true;
    const int32_t normal[] = {s.normal.x, s.normal.y, s.normal.z};
    const int32_t inward[] = {-beyond.normal.x, -beyond.normal.y, -beyond.normal.z};
    int32_t here[3], there[3], apart = 0, behind = 0;
    findPlace(shading_, s, here);
    findPlace(shading_, beyond, there);
    for (int i = 0; i < 3; ++i) {
        apart += (here[i] - there[i]) * inward[i] >> 14;
        behind += (here[i] - there[i]) * normal[i] >> 14;
    }
    // Where the surface blends it may bend inwards.
    if (apart <= 0 || behind <= 0)
        return true;
    return cut(inward, min32(mulShift16(apart, step_), INT16_MAX), voxel);
}

// The limb of a patch; null if there is none, or the bend of the patch is not known.
inline const Limb* Shader::limbOf(const Patch& patch)
{
    if (!limbSought_) {
        limbSought_ = true;
        if (hollow_) {
            hasLimb_ = false;
        } else if (patch.bend.ball) {
            hasLimb_ = object_.isBall() && patch.state == PATCH_REST && findLimb(ballBend_, shearX_, shearY_, middle_, &limb_);
        } else {
            if (!hasAxes_)
                findViewProducts(own_, &axes_);
            hasAxes_ = true;
            hasLimb_ = findLimb(patch.bend, axes_, step_, shearX_, shearY_, middle_, &limb_);
        }
    }
    return hasLimb_ ? &limb_ : nullptr;
}

// Ends the voxel of a regular seed, which is not cut, at the limb, if the tangent plane goes on beyond the limb.
inline void Shader::endAtLimb(const Patch& patch, const Seen& seen, Voxel* voxel)
{
    if (voxel->back == 0)
        return;
    if (const Limb* const limb = limbOf(patch))
        ::endAtLimb(*limb, mulDiv(mulShift16(seen.facing, step_), 1 << 14, own_.centre[2] + voxel->z), voxel);
}

// Domes a voxel, unless it is cut at a border and so domed already, and lets it end as much deeper as its dome is deep.
inline void Shader::dome(Voxel* voxel) const
{
    if (!isCut(*voxel))
        cutNowhere(voxel);
    if (voxel->back != 0)
        voxel->back = static_cast<uint8_t>(min32(voxel->back + (spacing_ >> (3 + DOME_SHIFT)), ENDS_MOST));
}

// Finds the visible oversampled and fine seeds of a patch, as findSeeds() finds the regular ones.
SELDOM int Shader::findExtras(const Patch& patch, Seen* seen, Voxel* voxels) const
{
    int count = 0;
    forSeeds(object_, patch, [&](const Seed& s) {
        const int i = object_.slotOf(s);
        const Seed* const extra = object_.extra(i);
        if (extra != nullptr && (extra->flags & SEED_ACTIVE) && findSeed(shading_, *extra, seen + count, voxels + count))
            ++count;
        const Seed* const fine = patch.fine || patch.islands ? object_.fine(i) : nullptr;
        for (int which = 0; which < SoftObject::FINE_SEEDS && fine != nullptr; ++which)
            if ((fine[which].flags & SEED_ACTIVE) && findSeed(shading_, fine[which], seen + count, voxels + count))
                ++count;
    });
    return clipsDepth_ ? clipDepth(seen, voxels, count) : count;
}

// Removes the seeds that are too near or too far, in place, and returns how many are left.
SELDOM int Shader::clipDepth(Seen* seen, Voxel* voxels, int count) const
{
    int left = 0;
    for (int i = 0; i < count; ++i) {
        const int32_t depth = own_.centre[2] + voxels[i].z;
        if (depth >= NEAREST_DEPTH && depth < FARTHEST_DEPTH) {
            seen[left] = seen[i];
            voxels[left++] = voxels[i];
        }
    }
    return left;
}

// Finds the visible seeds of a patch and sets the places of their voxels: first `*regular` regular seeds, then oversampled and fine
// ones. Returns how many they are together.
inline int Shader::findSeen(const Patch& patch, Voxel* voxels, int* regular)
{
    int count = findSeeds(&shading_, &patch, seen_, voxels);
    if (clipsDepth_)
        count = clipDepth(seen_, voxels, count);
    *regular = count;
    if (patch.extras || patch.islands)
        count += findExtras(patch, seen_ + count, voxels + count);
    return count;
}

// Sets the rest of the voxels that findSeen() has begun.
inline void Shader::shadeSeen(Patch& patch, Voxel* voxels, int count)
{
    const Seen& middle = seen_[count >> 1];
    if (!patch.bend.known)
        measureBend(object_, shading_, patch);
    setPatch(patch, middle, voxels[count >> 1]);
    shadeSeeds(&shading_, seen_, voxels, count);
}

// Ends a scale where another object is the strongest: at the border of its seed. Returns false when nothing of the voxel is left.
inline bool Shader::cutAtBorder(const Seed& s, Voxel* voxel, VoxelList& list) const
{
    // At a straight line, because the difference of two fields is nearly linear across the scale.
    const int32_t inward[] = {s.border.x, s.border.y, s.border.z};
    if (!cut(inward, s.apart, voxel))
        return false;
    list.bordered = true;
    if (s.apart < 0)
        voxel->z += BEHIND;
    return true;
}

// Sets the slopes of a voxel's brightness from how the light changes around its seed.
inline void Shader::setSlopesOf(const Seed& s, Voxel* voxel) const
{
    const int32_t gradient[] = {s.lightChange[0], s.lightChange[1], s.lightChange[2]};
    const int32_t x = along(gradient, own_.right, 0), y = along(gradient, own_.up, 1);
    const int32_t z = along(gradient, own_.ahead, 2) + ((x * shearX_ + y * shearY_) >> 10);
    setSlopes((x + (voxel->tiltX * z >> 8)) >> 4, (y + (voxel->tiltY * z >> 8)) >> 4, voxel);
}

// Whether a seed of a patch that blends knows how the light changes about its voxel (ltchange.cpp).
inline bool Shader::knowsLight(const Seed& s, bool regular, const Voxel& voxel) const
{
    return (!regular || isBesideBorder(s)) && voxel.brightness != 0 && s.lightChange[0] != Seed::LIGHT_UNKNOWN;
}

// Adds an unpainted voxel to a list, or to its guests. Returns its place there.
inline Voxel* Shader::listUnpainted(const Seed& s, const Voxel* voxel, VoxelList& list)
{
    Voxel* const shown = s.flags & SEED_GUEST ? list.roomForGuest(s.host) : list.voxels + list.count++;
    if (shown != voxel)
        *shown = *voxel;
    return shown;
}

// Ends or domes a voxel that is listed. `regular`: it is that of a regular seed; `domed`: the voxels of its patch are domed, but
// those that end at a limb that is known.
inline void Shader::endOrDome(const Patch& patch, const Seen& seen, bool regular, bool domed, Voxel* shown)
{
    if ((domed && (shown->back == 0 || !knowsLimb(patch))) || isCut(*shown))
        dome(shown);
    else if (regular)
        endAtLimb(patch, seen, shown);
}

// Ends a voxel at a border and at a ridge, if its seed lies beside one. Returns false when nothing is left of it.
inline bool Shader::endBeside(const Seed& s, Voxel* voxel, VoxelList& list) const
{
    return (!(s.flags & SEED_BORDER) || cutAtBorder(s, voxel, list)) && (s.beyond < 0 || cutAtRidge(s, voxel));
}

// Whether a patch bends unevenly, or its seeds have parted. Then its gradient is not known. Balls at rest bend evenly.
inline bool Shader::isUneven(const Patch& patch, const Voxel* voxels, int regular) const
{
    return (patch.state == PATCH_MIXED || !object_.isBall()) && (patch.extras || bendsUnevenly(patch, voxels, regular));
}

// Adds a listed voxel to the slopes, with the second one that the painter may have made of it.
template <bool PAINTED>
inline void Shader::addSloped(const Seed& s, Voxel* shown, int32_t sight, VoxelList& list)
{
    slopes.add(&s, static_cast<int>(&s - shading_.seeds), shown, sight);
    if (PAINTED && list.room() > shown + 1)
        slopes.addCopy(shown + 1, shown);
}

// How the voxels of a patch are listed, of which the first `regular` are those of regular seeds.
inline Shader::Listing Shader::listingOf(const Patch& patch, bool shines, bool uneven, int regular) const
{
    const bool blends = patch.state == PATCH_MIXED, bends = shines || uneven || patch.ridged;
    Listing how;
    how.shines = shines;
    how.knows = blends && !shines;
    how.regular = regular;
    how.sloped = blends || bends || object_.shaped() ? regular : 0;
    how.sight = bends ? Slopes::sight(shearX_, shearY_) : Slopes::STAYS;
    // The scales of an uneven patch are stretched or bend fast, so that each has to leave the place beside it to the next one
    // (scales.h).
    how.domed = uneven && (!knowsLimb(patch) || thin_);
    return how;
}

// Lists voxel number `i` of a patch. Returns false when nothing of it is left.
template <bool PAINTED>
inline bool Shader::listVoxel(const Patch& patch, const Listing& how, int i, const Seen& seen, Voxel* voxel, VoxelList& list,
                              Painter* painter)
{
    const Seed& s = *seen.seed;
    const bool knows = how.knows && knowsLight(s, i < how.regular, *voxel);
    if (knows)
        setSlopesOf(s, voxel);
    if (!endBeside(s, voxel, list))
        return false;
    Voxel* const shown = PAINTED ? painter->add(s, *voxel) : listUnpainted(s, voxel, list);
    endOrDome(patch, seen, i < how.regular, how.domed, shown);
    // A dark voxel keeps its slopes. With a finish that shines, brightness 0 does not mean that the light ends there.
    const bool stays = knows || (!how.shines && shown->brightness == 0);
    if (i < how.sloped)
        addSloped<PAINTED>(s, shown, stays ? Slopes::STAYS : how.sight, list);
    return true;
}

// Lists the voxels of a patch that blends, has a ridge or bends unevenly, or whose object is shaped or has a paint.
template <bool PAINTED>
inline void Shader::listVoxels(const Patch& patch, Voxel* voxels, int count, const Listing& how, VoxelList& list, Painter* painter)
{
    int listed = 0;
    for (int i = 0; i < count; ++i)
        if (listVoxel<PAINTED>(patch, how, i, seen_[i], voxels + i, list, painter))
            seen_[listed++] = seen_[i];
}

template <bool PAINTED>
inline void Shader::shadePatch(Patch& patch, VoxelList& list, Painter* painter)
{
    // The painter makes one or two voxels of each of these.
    Voxel unpainted[PAINTED ? PATCH_SEEDS_MOST : 1];
    Voxel* const voxels = PAINTED ? unpainted : list.room();
    int regular;
    const int count = findSeen(patch, voxels, &regular);
    if (count == 0)
        return;
    shadeSeen(patch, voxels, count);
    const bool uneven = isUneven(patch, voxels, regular);
    if (PAINTED || patch.state != PATCH_REST || patch.ridged || uneven || object_.shaped()) {
        const Listing how = listingOf(patch, PAINTED && painter->shines(), uneven, regular);
        listVoxels<PAINTED>(patch, voxels, count, how, list, painter);
        return;
    }
    for (int i = 0; i < count; ++i)
        endAtLimb(patch, seen_[i], voxels + i);
    list.count += count;
}

// Whether some of a patch may be seen; the caller has tested whether the patch rests facing away. A patch that the last
// update has settled was found not to be hidden then.
bool isSeen(const Patch& patch, const OwnFrame& own)
{
    if (patch.state == PATCH_REST)
        return !outOfSight(patch, own) && !isHidden(patch, own);
    return patch.state == PATCH_MIXED && (patch.settled || !isHidden(patch, own));
}

// Adds the guests of a list to its voxels, those of each host as a run of its own.
SELDOM void listGuests(VoxelList& list, const Bodies& bodies)
{
    Voxel* const guests = list.voxels + VOXELS_AT_ONCE - list.guests;
    uint8_t* const hosts = list.number + VOXELS_AT_ONCE - list.guests;
    if (list.count > 0)
        list.run[list.runs++] = {list.ramp, list.count};
    for (int done = 0; done < list.guests;) {
        const uint8_t host = hosts[done];
        for (int i = done; i < list.guests; ++i) {
            if (hosts[i] != host)
                continue;
            const Voxel voxel = guests[i];
            guests[i] = guests[done];
            guests[done] = voxel;
            hosts[i] = hosts[done];
            hosts[done++] = host;
        }
        list.run[list.runs++] = {bodies.object(host).ramp(), list.count + done};
    }
    memmove(list.voxels + list.count, guests, static_cast<size_t>(list.guests) * sizeof *guests);
    list.count += list.guests;
}

template <bool PAINTED>
int Shader::shade(Patch* patches, int count, int first, VoxelList& list, int room, Painter* painter, Keeper& keeper)
{
    // The painter may make two voxels of one seed. Guests are listed from the other end on, while the voxels of the patch still
    // stand at this one.
    constexpr int most = 2 * PATCH_SEEDS_MOST;
    static_assert(most <= DRAW_ROOM);
    // A pattern may move over seeds that stand still.
    const bool keeps = !PAINTED || painter->isPlain();
    int i = first;
    for (; i < count; ++i) {
        Patch& patch = patches[i];
        if (patch.state == PATCH_REST && !patch.islands && restsAway(patch, own_))
            continue;
        const bool goesOn = keeps && keeper.goesOn(i, patch);
        if (!goesOn && !patch.islands && !isSeen(patch, own_))
            continue;
        if (list.count + list.guests + most > room)
            break;
        if (goesOn || (keeps && keeper.stands(i, patch))) {
            keeper.list(i, goesOn, list, slopes);
            continue;
        }
        const int begin = list.count, guests = list.guests, sloped = slopes.count();
        shadePatch<PAINTED>(patch, list, painter);
        if (keeps && list.guests == guests)
            keeper.keep(i, patch, {list.voxels + begin, seen_, list.count - begin, sloped, list.bordered}, slopes);
    }
    return i;
}

}  // namespace

int shadePatches(SoftObject& object, const OwnFrame& own, const FrameContext& frame, Patch* patches, int count, int first,
                 VoxelList& list, int room, Keeper& keeper)
{
    Shader shader(object, own, frame);
    slopes.begin();
    int left;
    if (object.shown()->paint() == nullptr) {
        left = shader.shade<false>(patches, count, first, list, room, nullptr, keeper);
    } else {
        Painter painter(object, own, list);
        left = shader.shade<true>(patches, count, first, list, room, &painter, keeper);
    }
    slopes.set(shader.spacing());
    if (list.guests > 0)
        listGuests(list, *frame.bodies);
    return left;
}
