// Profiles of pairs of balls, from a table that holds for all of them.
#include "model/field.h"
#include "surface/profile.h"

namespace {

// The own field along a path and the neighbour's make up the isovalue together: at the position where the own one is the
// isovalue less F(t), the neighbour has to be at t. By steps of t, from where its field begins to where it is alone.
constexpr int STEPS = 22;
constexpr Real FIRST(0.90), STEP(0.03);

struct Step {
    Real t, position, inverse;
};
Step steps[STEPS];

}  // namespace

void makeProfileSteps()
{
    for (int i = 0; i < STEPS; ++i) {
        Step& step = steps[i];
        step.t = FIRST - STEP * i;
        const Real own = ISOVALUE - geoff(step.t);
        int32_t low = 65536, high = 2 * 65536;
        while (low < high) {
            const int32_t middle = (low + high + 1) >> 1;
            const Real position = realFromRaw(middle);
            if (geoff(shiftDown(position * position, 2)) >= own)
                low = middle;
            else
                high = middle - 1;
        }
        step.position = realFromRaw(low);
        step.inverse = Real(1) / step.position;
    }
}

void Profile::make(Real a0, Real c0, Real least, Real border)
{
    // The b of the path that leaves the surface at the position of each step. Where it grows again paths with that b have
    // left it before.
    int32_t b[STEPS];
    int32_t lowest = INT32_MAX;
    int count = 0;
    while (count < STEPS) {
        const Step& step = steps[count];
        b[count] = rawFromReal((step.t - a0) * step.inverse - step.position * c0);
        lowest = b[count] < lowest ? b[count] : lowest;
        if (b[count++] < rawFromReal(least))
            break;
    }
    top_ = b[0];
    depth_ = top_ - lowest;
    fine_ = 0;
    while (depth_ >> (fine_ + 8) >= CELLS)
        ++fine_;

    Cell* cell = cells_;
    const int32_t width = 1 << (fine_ + 8);
    int32_t low = top_, at = top_ - width;  // the least b up to here; the lower end of the cell at hand
    cell->position = rawFromReal(steps[0].position);
    int32_t end = cell->position, edgeFrom = rawFromReal(border);
    edge_ = realFromRaw(lowest);
    bool whole = true;
    for (int i = 1; i < count; ++i) {
        const int32_t next = b[i];
        if (next >= low)
            continue;
        const int32_t from = rawFromReal(steps[i - 1].position);
        end = rawFromReal(steps[i].position);
        if (end >= edgeFrom) {
            edge_ = realFromRaw(next);
            edgeFrom = INT32_MAX;
        }
        // Over a gap nothing is in between: all of the cell is taken to lie before it.
        if (b[i - 1] > low)
            whole = false;
        low = next;
        if (next > at)
            continue;
        const int32_t slope = mulDiv(end - from, 65536, b[i - 1] - next);
        int32_t position = from + mulShift16(b[i - 1] - at, slope);
        cell->rise = whole ? position - cell->position : 0;
        whole = true;
        (++cell)->position = position;
        at -= width;
        if (next > at)
            continue;
        const int32_t rise = mulShift16(width, slope);
        do {
            cell->rise = rise;
            position += rise;
            (++cell)->position = position;
            at -= width;
        } while (next <= at);
    }
    cell->rise = 0;
    // The last cell is seldom filled: its slope is as if it were.
    const int32_t rest = at + width - low;
    if (whole && rest > width >> 3)
        cell->rise = mulDiv(end - cell->position, width, rest);
}
