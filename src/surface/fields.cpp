// The fields of neighbours along a path in C++, the readable reference for asm/fields.S.
#include "gather.h"

void addFieldsC(Neighbour* const* first, Neighbour* const* end, Real position, const Vector* path, Fields* fields)
{
    for (Neighbour* const* at = first; at < end; ++at) {
        Along& along = **at;
        if (along.kind != Along::OTHER) {
            if (path != nullptr)
                along.aimNear(*path);
            along.nearParam(position);
        }
        const Real t = along.t;
        if (t >= Real(1)) {
            along.value = along.slope = Real(0);
            continue;
        }
        if (along.kind != Along::OTHER)
            along.findChange(position);
        const FieldStep field = geoffQuick(max(t, Real(0)));
        along.value = field.value;
        along.slope = field.slope;
        fields->sum += field.value;
        fields->slope += field.slope * along.change;
        fields->strongest = max(fields->strongest, field.value);
        ++fields->reaching;
    }
}
