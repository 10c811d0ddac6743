// What single points of the surface look like.
#include "tint.h"

#include "math/whole.h"
#include "surface/finish.h"
#include "surface/voxel.h"

Tint::Tint(const FieldProbe& probe, const ViewAxes& axes) : probe_(probe)
{
    if (probe.model() == nullptr)
        return;
    const Normal light = normalise(probe.model()->light);
    light_[0] = light.x;
    light_[1] = light.y;
    light_[2] = light.z;
    store14(axes.ahead, ahead_);
    store14({Real(0), Real(1), Real(0)}, up_);
}

// The surface's normal at that point. The field rises inwards.
inline Normal Tint::normal() const
{
    const Normal in = normalise(probe_.gradient());
    return {-in.x, -in.y, -in.z};
}

uint8_t Tint::entry(const Point& p, int strongest) const
{
    const SoftObject& object = *probe_.model()->actor(strongest).object;
    if (object.ramp() == nullptr)
        return 0;
    if (object.paint() != nullptr)
        return paintedEntry(p, object);
    const Normal n = normal();
    return object.ramp()[max32(lambert((n.x * light_[0] + n.y * light_[1] + n.z * light_[2]) >> 14), 0)];
}

uint8_t Tint::paintedEntry(const Point& p, const SoftObject& object) const
{
    const Paint& paint = *object.paint();
    const Normal n = normal();
    const int light = paint.shines() ? (Polish(paint.finish, light_, ahead_, up_).brightness8(n) + 128) >> 8
                                     : max32(lambert((n.x * light_[0] + n.y * light_[1] + n.z * light_[2]) >> 14), 0);
    // An object that is shown in another ramp than its own, as when it is selected, shows no colours of its paint.
    if (object.ramp() != paint.ramp)
        return object.ramp()[light];
    const uint8_t mix = paint.mixes ? paint.paints->numberAt(probe_.mixture(), paint.shines()) : paint.number;
    Real grains[3];
    const PatternMap pattern(object);
    pattern.toGrains(p - object.centre(), grains);
    return paint.ramps[pattern.numberAt(grains, mix) * paint.rampRoom + light];
}
