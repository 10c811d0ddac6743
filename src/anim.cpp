// Objects on their paths.
#include "anim.h"

#include "model.h"

Point placeAt(const Motion& motion, Time time)
{
    const Angle angle = motion.phase + static_cast<Angle>((time * motion.rate) >> 16);
    return motion.centre + motion.u * cosine(angle) + motion.v * sine(angle);
}

void Anim::move(Model& model, Time time)
{
    for (int i = 0; i < model.count(); ++i)
        model.actor(i).object->moveTo(placeAt(model.actor(i).motion, time));
}
