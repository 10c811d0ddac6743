// The field of a model at a point: that of the strongest body there.
#include "model/probe.h"

namespace {

// The edge of a cube is 2^CUBE units.
constexpr int CUBE = 3;

}  // namespace

void FieldProbe::begin()
{
    const Bodies& bodies = *model_->knownBodies();
    memberCount_ = model_->count();
    for (int i = 0; i < memberCount_; ++i) {
        const SoftObject& object = *model_->actor(i).object;
        members_[i] = {&object, object.hasSurface() ? bodies.members(object) : nullptr};
    }
}

// Finds the objects that may reach the cube of a cell.
void FieldProbe::gather(Cell& cell) const
{
    constexpr int EDGE = 1 << CUBE, HALF = EDGE / 2;
    const Point middle{Real(cell.x * EDGE + HALF), Real(cell.y * EDGE + HALF), Real(cell.z * EDGE + HALF)};
    // How far a place is beyond the cube along an axis, given how far it is from the middle.
    const auto beyond = [](Real away) { return ::max(absolute(away) - Real(HALF), Real(0)); };
    cell.count = 0;
    for (int i = 0; i < memberCount_; ++i) {
        const SoftObject& object = *members_[i].object;
        // Most objects are so far away that their boxes tell.
        if (object.isFar(middle, Real(HALF)))
            continue;
        const Vector away = object.centre() - middle;
        if (squareOf(Vector{beyond(away.x), beyond(away.y), beyond(away.z)}) < squareOf(object.reach()))
            cell.slots[cell.count++] = static_cast<uint8_t>(i);
    }
}

// Returns the cell of the cube that a point lies in. Cubes side by side have different cells.
inline const FieldProbe::Cell& FieldProbe::cellAt(const Point& p)
{
    const int x = floorToInt(p.x) >> CUBE, y = floorToInt(p.y) >> CUBE, z = floorToInt(p.z) >> CUBE;
    Cell& cell = cells_[static_cast<uint32_t>(x + 3 * y + 11 * z) % CELLS];
    if (cell.count < 0 || cell.x != x || cell.y != y || cell.z != z) {
        cell.x = x;
        cell.y = y;
        cell.z = z;
        gather(cell);
    }
    return cell;
}

// The sum of the fields of one body at the point. `*strongest` becomes its strongest part.
inline Real FieldProbe::sumOf(SoftObject* const* body, const Part** strongest) const
{
    Real sum(0), most(0);
    for (const Part* part = parts_; part < end_; ++part) {
        if (part->body != body)
            continue;
        sum += part->field;
        if (part->field > most) {
            most = part->field;
            *strongest = part;
        }
    }
    return sum;
}

// The field F of one body at the point (body.h), where not all of its members are linked with each other. `most` is the field of
// its strongest part.
Real FieldProbe::blendOf(SoftObject* const* body, Real most)
{
    const Bodies& bodies = *model_->knownBodies();
    Real above(0), squares(0);
    for (Part* part = parts_; part < end_; ++part) {
        if (part->body != body)
            continue;
        Real weighted = part->field;
        for (const Part* other = parts_; other < end_; ++other)
            weighted += other->field * bodies.weight(part->slot, other->slot);
        // Far inside the body the sum of so many might overflow.
        part->weighted = clamp(weighted, Real(-240), Real(240));
        const Real share = quotient(part->field, most);
        part->square = share * share;
        above += part->square * part->weighted;
        squares += part->square;
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
    if (memberCount_ < 0)
        begin();
    // (A copy stays in registers: the parts that are written might overlap with `p`.)
    const Point at = p;
    const Cell& cell = cellAt(at);
    Part* end = parts_;
    for (const uint8_t *slot = cell.slots, *const last = slot + cell.count; slot < last; ++slot) {
        const Member& one = members_[*slot];
        if (one.object->isFar(at))
            continue;
        end->field = one.object->fieldNear(at, &end->place);
        if (end->field <= Real(0))
            continue;
        end->slot = *slot;
        end->body = one.body;
        ++end;
    }
    end_ = end;
    highest_ = Real(0);
    SoftObject* const *last = nullptr, *const *const only = member == nullptr ? nullptr : bodies->members(*member);
    for (const Part* part = parts_; part < end_; ++part) {
        if (part->body == nullptr || part->body == last || (only != nullptr && part->body != only))
            continue;
        last = part->body;
        const Part* own = part;
        const Real sum = sumOf(last, &own), field = bodies->plainBody(part->slot) ? sum : blendOf(last, own->field);
        if (field > highest_ || *strongest < 0) {
            highest_ = field;
            *strongest = own->slot;
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
            squares += i->square;
    for (const Part* part = parts_; part < end_; ++part) {
        const bool isMember = part->body == chosen_->body;
        Real factor(isMember ? 1 : 0);
        if (!plain) {
            if (isMember) {
                // The sum of a member is farther from the field only in the depth of a crowd, where the factor might overflow.
                const Real above = clamp(part->weighted - highest_, Real(-2), Real(2));
                factor = part->square + part->square / part->field * above * Real(2);
            }
            for (const Part* i = parts_; i < end_; ++i)
                if (i->body == chosen_->body)
                    factor += i->square * bodies.weight(i->slot, part->slot);
            factor = factor / squares;
        }
        if (factor != Real(0))
            sum = sum + model_->actor(part->slot).object->gradientAt(part->place) * factor;
    }
    return sum;
}

Vector FieldProbe::mixture() const
{
    Vector sum{Real(0), Real(0), Real(0)};
    Real fields(0);
    for (const Part* part = parts_; part < end_; ++part) {
        if (chosen_ == nullptr || part->body != chosen_->body)
            continue;
        sum = sum + members_[part->slot].object->paint()->at * part->field;
        fields += part->field;
    }
    return fields > Real(0) ? sum * (Real(1) / fields) : sum;
}
