// The fields of neighbours along a path, in C++.
#include "fields.h"

void addFieldsC(Along* first, Along* end, Real position, const Vector* path, Fields* fields)
{
    for (Along* along = first; along < end; ++along) {
        if (along->kind != Neighbour::OTHER) {
            if (path != nullptr)
                along->aim(*path);
            along->nearParam(position);
        }
        const Real t = along->t;
        if (t >= Real(1)) {
            along->value = along->slope = Real(0);
            continue;
        }
        const FieldStep field = geoffQuick(most(t, Real(0)));
        along->value = field.value;
        along->slope = field.slope;
        fields->sum += field.value;
        fields->slope += field.slope * along->change;
        fields->strongest = most(fields->strongest, field.value);
        fields->touched = 1;
    }
}
