// What single points of the surface look like.
#include "tint.h"

// The brightness of finishes, in the axes of the world. Without a model none will be asked for.
static Polish polishOf(const Model* model, const ViewAxes& axes)
{
    const Vector upwards{Real(0), Real(1), Real(0)};
    const Normal n = normalise(model == nullptr ? upwards : model->light);
    const int32_t light[] = {n.x, n.y, n.z};
    int32_t ahead[3], up[3];
    store14(axes.ahead, ahead);
    store14(upwards, up);
    return {light, ahead, up};
}

Tint::Tint(const FieldProbe& probe, const ViewAxes& axes) : probe_(probe), polish_(polishOf(probe.model(), axes)) {}

uint8_t Tint::entry(const Point& p, int strongest) const
{
    const SoftObject& object = *probe_.model()->actor(strongest).object;
    const Paint* const paint = object.paint();
    const uint8_t* const ramp = paint == nullptr ? object.ramp() : rampAt(p, object);
    if (ramp == nullptr)
        return 0;
    // The field rises inwards.
    const Normal in = normalise(probe_.gradient());
    return ramp[polish_.brightness(paint == nullptr ? FINISH_MATT : paint->finish, {-in.x, -in.y, -in.z})];
}

// The ramp of a painted object at a point; null if it has none.
const uint8_t* Tint::rampAt(const Point& p, const SoftObject& object) const
{
    const Paint& paint = *object.paint();
    // An object that is shown in another ramp than its own, as when it is selected, shows no colours of its paint.
    if (object.ramp() != paint.ramp)
        return object.ramp();
    const uint8_t mix = paint.mixes ? paint.paints->numberAt(probe_.mixture(), paint.shines()) : paint.number;
    const PatternMap pattern(object);
    Real grains[3];
    pattern.toGrains(p - object.centre(), grains);
    return paint.ramps + pattern.numberAt(grains, mix) * paint.rampRoom;
}
