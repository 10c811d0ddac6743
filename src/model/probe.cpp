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

// The field F of a part's body at the point (body.h). `*strongest` receives the slot of the body's strongest part.
Real FieldProbe::fieldOf(const Part& one, int* strongest)
{
    const Bodies& bodies = *model_->knownBodies();
    Real sum(0), most(0), above(0), squares(0);
    for (const Part* part = parts_; part < end_; ++part) {
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
    for (Part* part = parts_; part < end_; ++part) {
        if (part->body != one.body)
            continue;
        Real weighted = part->field;
        for (const Part* other = parts_; other < end_; ++other)
            weighted += other->field * bodies.weight(part->slot, other->slot);
        // Far inside the body the sum of so many might overflow.
        part->weighted = clamp(weighted, Real(-240), Real(240));
        part->share = quotient(part->field, most);
        const Real square = part->share * part->share;
        above += square * part->weighted;
        squares += square;
    }
    return squares > Real(0) ? above / squares : Real(0);
}

Real FieldProbe::implicitAt(const Point& p, int* strongest, const SoftObject* member)
{
    const Bodies* const bodies = model_->knownBodies();
    *strongest = -1;
    chosen_ = nullptr;
    if (bodies == nullptr)
        return Real(0);
    if (count_ < 0 || !isAround(p, middle_))
        gather(p, *bodies);
    end_ = parts_;
    for (const Near *near = near_, *const last = near_ + count_; near < last; ++near) {
        end_->field = near->object->fieldFunc(p, &end_->place);
        if (end_->field > Real(0)) {
            end_->slot = near->slot;
            end_->body = near->body;
            ++end_;
        }
    }
    highest_ = Real(0);
    SoftObject* const *last = nullptr, *const *const only = member == nullptr ? nullptr : bodies->members(*member);
    for (const Part* part = parts_; part < end_; ++part) {
        if (part->body == nullptr || part->body == last || (only != nullptr && part->body != only))
            continue;
        last = part->body;
        int own = -1;
        const Real field = fieldOf(*part, &own);
        if (field > highest_ || *strongest < 0) {
            highest_ = field;
            *strongest = own;
            chosen_ = part;
        }
    }
    return ::max(highest_, Real(0));
}

// With g_i for the sum of member i, f_i for its field, w_ik for the weight that object k has in that sum, and s_i = f_i / f_max:
// F = sum(s_i^2 g_i) / sum(s_i^2), and so dF/df_k = (2 s_k^2 (g_k - F) / f_k + s_k^2 + sum(s_i^2 w_ik)) / sum(s_i^2), where
// the first two terms are there for members alone. In a plain body it is 1.
Vector FieldProbe::gradient() const
{
    Vector sum{Real(0), Real(0), Real(0)};
    if (chosen_ == nullptr || highest_ < FAINT)
        return sum;
    const Bodies& bodies = *model_->knownBodies();
    const bool plain = bodies.plainBody(chosen_->slot);
    Real squares(0);
    for (const Part* i = parts_; i < end_ && !plain; ++i)
        if (i->body == chosen_->body)
            squares += i->share * i->share;
    for (const Part* part = parts_; part < end_; ++part) {
        const bool isMember = part->body == chosen_->body;
        Real factor(isMember ? 1 : 0);
        if (!plain) {
            if (isMember) {
                // The sum of a member is farther from the field only in the depth of a crowd, where the factor might overflow.
                const Real square = part->share * part->share, above = clamp(part->weighted - highest_, Real(-2), Real(2));
                factor = square + square / part->field * above * Real(2);
            }
            for (const Part* i = parts_; i < end_; ++i)
                if (i->body == chosen_->body)
                    factor += i->share * i->share * bodies.weight(i->slot, part->slot);
            factor = factor / squares;
        }
        if (factor != Real(0))
            sum = sum + model_->actor(part->slot).object->gradientAt(part->place) * factor;
    }
    return sum;
}
