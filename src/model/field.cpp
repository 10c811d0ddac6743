// The Geoff function and its table.
#include "model/field.h"

FieldStep fieldSteps[FIELD_STEPS];
OwnStep ownSteps[OWN_STEPS];

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
    // Each entry stands for the middle of its step.
    for (int i = 0; i < FIELD_STEPS; ++i) {
        const Real t = realFromRaw((2 * i + 1) * (65536 / FIELD_STEPS / 2));
        fieldSteps[i] = {geoff(t), geoffSlope(t)};
    }
    for (int i = 0; i < OWN_STEPS; ++i) {
        const Real position = realFromRaw((2 * (OWN_FIRST + i) + 1) * 32);
        const Real t = shiftDown(position * position, 2);
        const Real own = geoff(t);
        int32_t low = 0, high = 65536;
        while (low < high) {
            const int32_t middle = (low + high + 1) >> 1;
            if (geoff(realFromRaw(middle)) >= ISOVALUE - own)
                low = middle;
            else
                high = middle - 1;
        }
        ownSteps[i] = {own, geoffSlope(t), geoffSlope(t) * shiftDown(position, 1), geoffSlope(realFromRaw(low))};
    }
}
