// The Geoff function and its table (field.h).
#include "model/field.h"

FieldStep fieldSteps[FIELD_STEPS];

Real geoff(Real t)
{
    if (t >= Real(1))
        return Real(0);
    return Real(1) - t * (Real(22.0 / 9) - t * (Real(17.0 / 9) - t * Real(4.0 / 9)));
}

Real geoffSlope(Real t)
{
    if (t >= Real(1))
        return Real(0);
    return t * (Real(34.0 / 9) - t * Real(12.0 / 9)) - Real(22.0 / 9);
}

void makeFieldSteps()
{
    for (int i = 0; i < FIELD_STEPS; ++i) {
        const Real t = realFromRaw((2 * i + 1) * (65536 / FIELD_STEPS / 2));
        fieldSteps[i] = {geoff(t), geoffSlope(t)};
    }
}
