// The field of a model at a point: that of the strongest body there.
#include "model/probe.h"

namespace {

// Half the edge of the cube whose objects are kept for the next points, units.
constexpr Real AROUND(5);

inline bool isAround(const Point& p, const Point& middle)
{
    return absolute(p.x - middle.x) < AROUND && absolute(p.y - middle.y) < AROUND && absolute(p.z - middle.z) < AROUND;
}

}  // namespace

// An object whose field reaches a point. `body` is the first of its body's members, or null if the object has no surface.
struct FieldProbe::Part {
    int slot;
    SoftObject* const* body;
    Real field;
};

// Finds the objects that may reach points around `p`.
void FieldProbe::gather(const Point& p, const Bodies& bodies)
{
    middle_ = p;
    count_ = 0;
    for (int i = 0; i < model_->count(); ++i) {
        const SoftObject& object = *model_->actor(i).object;
        if (!object.isFar(p, AROUND))
            near_[count_++] = {&object, i, object.hasSurface() ? bodies.members(object) : nullptr};
    }
}

// The field F of the body of one of the parts at the point that they reach (body.h). `*strongest` receives the slot of the body's
// strongest part.
Real FieldProbe::fieldOf(const Part& one, const Part* parts, const Part* end, int* strongest) const
{
    const Bodies& bodies = *model_->knownBodies();
    Real sum(0), most(0), above(0), squares(0);
    for (const Part* part = parts; part < end; ++part) {
        if (part->body != one.body)
            continue;
        sum += part->field;
        if (part->field > most) {
            most = part->field;
            *strongest = part->slot;
        }
    }
    if (bodies.plainBody(one.slot))
        return sum;
    for (const Part* part = parts; part < end; ++part) {
        if (part->body != one.body)
            continue;
        Real weighted = part->field;
        for (const Part* other = parts; other < end; ++other)
            weighted += other->field * bodies.weight(part->slot, other->slot);
        const Real share = quotient(part->field, most), square = share * share;
        // Far inside the body the sum of so many might overflow.
        above += square * clamp(weighted, Real(-240), Real(240));
        squares += square;
    }
    return squares > Real(0) ? above / squares : Real(0);
}

Real FieldProbe::implicitAt(const Point& p, int* strongest, const SoftObject* member)
{
    const Bodies* const bodies = model_->knownBodies();
    *strongest = -1;
    if (bodies == nullptr)
        return Real(0);
    if (count_ < 0 || !isAround(p, middle_))
        gather(p, *bodies);
    Part parts[Model::OBJECTS_MOST], *end = parts;
    for (const Near *near = near_, *const last = near_ + count_; near < last; ++near) {
        const Real field = near->object->fieldFunc(p);
        if (field > Real(0))
            *end++ = {near->slot, near->body, field};
    }
    Real highest(0);
    SoftObject* const *last = nullptr, *const *const only = member == nullptr ? nullptr : bodies->members(*member);
    for (const Part* part = parts; part < end; ++part) {
        if (part->body == nullptr || part->body == last || (only != nullptr && part->body != only))
            continue;
        last = part->body;
        int own = -1;
        const Real field = fieldOf(*part, parts, end, &own);
        if (field > highest || *strongest < 0) {
            highest = field;
            *strongest = own;
        }
    }
    return ::max(highest, Real(0));
}
