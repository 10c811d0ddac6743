// The Geoff function and its table (field.h).
#include "model/field.h"

FieldStep fieldSteps[FIELD_STEPS];

void makeFieldSteps()
{
    for (int i = 0; i < FIELD_STEPS; ++i) {
        const Real t = realFromRaw((2 * i + 1) * (65536 / FIELD_STEPS / 2));
        fieldSteps[i] = {geoff(t), geoffSlope(t)};
    }
}
