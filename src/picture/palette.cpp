// Palette: makes the ramps of brightness. Where they need more palette entries than there are, similar colours are merged: the set
// of all wanted colours is divided again and again in the subset of greatest error (like median cut, but at the mean).
#include "picture/palette.h"

#include "rt.h"

namespace {

// Lower bound of the grey ramp's brightness, of 64 steps: unlit surface still differs from the background.
constexpr int DARKEST = 2;

// DAC values of Palette::INK and of the background.
constexpr uint8_t INK_COLOUR[3] = {63, 63, 56};
constexpr uint8_t BACKGROUND_COLOUR[3] = {1, 1, 6};

// Computes the DAC values of a colour at one step of brightness; each component is rounded once. A highlight adds only the part of
// white that is perpendicular to the colour (as vectors of red, green and blue). The component along the colour stays
// proportional to the light, so that the `ramp` line of a dump holds for highlights too. A shining colour turns into pure white.
void shade(const Colour& colour, bool shines, int step, uint8_t* to)
{
    constexpr int WHOLE = 255 * 63;
    const int parts[3] = {colour.red, colour.green, colour.blue};
    const int sum = parts[0] + parts[1] + parts[2];
    const int square = parts[0] * parts[0] + parts[1] * parts[1] + parts[2] * parts[2];
    for (int p = 0; p < 3; ++p) {
        // The component times the light; full scale is 63 WHOLE.
        int value = parts[p] * (63 * Palette::AMBIENT + step * (63 - Palette::AMBIENT));
        if (shines && step > Palette::GLOSS) {
            value += (63 * WHOLE - value) / (63 - Palette::GLOSS) * (step - Palette::GLOSS);
        } else if (!shines && step > Palette::HIGHLIGHT && square > 0) {
            const int white = 255 - 255 * sum * parts[p] / square;
            value += white * 63 * 63 * (step - Palette::HIGHLIGHT) / (2 * (63 - Palette::HIGHLIGHT));
        }
        value = value < 0 ? 0 : value > 63 * WHOLE ? 63 * WHOLE : value;
        to[p] = static_cast<uint8_t>((value + WHOLE / 2) / WHOLE);
    }
}

// A palette entry that a ramp would like to have: for `steps` steps of brightness, from `step` on, that have equal DAC values.
struct Wish {
    uint8_t part[3];  // red, green, blue as DAC values
    uint8_t colour;   // number of the ramp
    uint8_t step, steps;
    uint8_t weight;   // of each step
};

// The wishes `from` to before `to`, which share one palette entry: their mean.
struct Box {
    int from, to;
    uint32_t weight;  // sum of weights
    uint32_t sum[3];  // weighted sum of each component
    int widest;       // the component that varies most
    uint32_t error;   // weighted sum of the squared distances from the mean
    uint32_t light;   // mean of the steps of brightness, in halves
};

Box measured(const Wish* wishes, int from, int to)
{
    Box box{from, to, 0, {0, 0, 0}, 0, 0, 0};
    uint32_t squares[3] = {0, 0, 0}, light = 0;
    for (int i = from; i < to; ++i) {
        const uint32_t weight = static_cast<uint32_t>(wishes[i].steps * wishes[i].weight);
        box.weight += weight;
        light += weight * static_cast<uint32_t>(2 * wishes[i].step + wishes[i].steps - 1);
        for (int p = 0; p < 3; ++p) {
            const uint32_t part = wishes[i].part[p];
            box.sum[p] += weight * part;
            squares[p] += weight * part * part;
        }
    }
    box.light = light / box.weight;
    uint32_t most = 0;
    for (int p = 0; p < 3; ++p) {
        const uint32_t even = static_cast<uint32_t>(divide64(static_cast<uint64_t>(box.sum[p]) * box.sum[p], box.weight));
        const uint32_t error = squares[p] - even;
        box.error += error;
        if (error > most) {
            most = error;
            box.widest = p;
        }
    }
    return box;
}

// Sorts the wishes of a box into those not above the mean of its widest component and those above; returns where the latter begin.
// Neither half is empty unless all wishes are equal.
int divide(Wish* wishes, const Box& box)
{
    int from = box.from, to = box.to;
    while (from < to) {
        if (wishes[from].part[box.widest] * box.weight <= box.sum[box.widest]) {
            ++from;
        } else {
            const Wish wish = wishes[from];
            wishes[from] = wishes[--to];
            wishes[to] = wish;
        }
    }
    return from;
}

// Divides all wishes into `most` boxes at most; always divides the box with the greatest error. Returns the number of boxes.
int divideAll(Wish* wishes, int wished, Box* boxes, int most)
{
    int used = 1;
    boxes[0] = measured(wishes, 0, wished);
    while (used < most) {
        int worst = 0;
        for (int i = 1; i < used; ++i)
            if (boxes[i].error > boxes[worst].error)
                worst = i;
        if (boxes[worst].error == 0)
            break;
        const Box box = boxes[worst];
        const int middle = divide(wishes, box);
        boxes[worst] = measured(wishes, box.from, middle);
        boxes[used++] = measured(wishes, middle, box.to);
    }
    return used;
}

// Sorts boxes by their brightness.
void sort(Box* boxes, int count)
{
    for (int i = 1; i < count; ++i) {
        const Box box = boxes[i];
        int at = i;
        for (; at > 0 && boxes[at - 1].light > box.light; --at)
            boxes[at] = boxes[at - 1];
        boxes[at] = box;
    }
}

// Writes the wishes of one colour's ramp; returns their number.
int wishesOf(const Colour& colour, bool shines, int number, int weight, Wish* wishes)
{
    int wished = 0;
    for (int step = 0; step < Palette::STEPS; ++step) {
        uint8_t part[3];
        shade(colour, shines, step, part);
        if (step > 0 && memcmp(wishes[wished - 1].part, part, sizeof part) == 0) {
            ++wishes[wished - 1].steps;
            continue;
        }
        Wish& wish = wishes[wished++];
        memcpy(wish.part, part, sizeof part);
        wish.colour = static_cast<uint8_t>(number);
        wish.step = static_cast<uint8_t>(step);
        wish.steps = 1;
        wish.weight = static_cast<uint8_t>(weight);
    }
    return wished;
}

// The palette entry of a step, of `steps`, of ramp `number` of `count` that have entries of their own. They are in the order of
// brightness.
int evenEntry(int step, int steps, int number, int count)
{
    return 1 + number + step * (Palette::INK - 1 - count) / (steps - 1);
}

// Collects the distinct colours of the objects, and the number of each object's colour. Returns how many colours there are.
int coloursOf(const Model& model, Colour* colours, int* colourOf)
{
    int count = 0;
    for (int i = 0; i < model.count(); ++i) {
        int c = 0;
        while (c < count && !(colours[c] == model.actor(i).colour))
            ++c;
        if (c == count)
            colours[count++] = model.actor(i).colour;
        colourOf[i] = c;
    }
    return count;
}

// Repeats both ends of a ramp SHADING_MOST times, and adds the step of each palette entry; returns the ramp.
const uint8_t* lengthen(uint8_t* ramp)
{
    for (int i = 1; i <= SHADING_MOST; ++i) {
        ramp[-i] = ramp[0];
        ramp[Palette::STEPS - 1 + i] = ramp[Palette::STEPS - 1];
    }
    memset(ramp + STEP_OF, 0, 256);
    for (int i = 0; i < Palette::STEPS; ++i)
        ramp[STEP_OF + ramp[i]] = static_cast<uint8_t>(i - STEP_BIAS);
    return ramp;
}

}  // namespace

void Palette::make(Model& model, bool grey, bool plain)
{
    memset(dac_, 0, sizeof dac_);
    for (int i = 0; i < model.count(); ++i)
        model.actor(i).object->setPaint(nullptr);
    const bool painted = !plain && paints_.choose(model, paint_);
    // Seeds store the numbers of their mixed colours, which may have changed.
    if (painted && model.mixed)
        model.settleAnew();
    memcpy(dac_ + 3 * INK, INK_COLOUR, sizeof INK_COLOUR);
    grey_ = grey;
    if (grey)
        makeGrey(model, painted);
    else
        makeColours(model, painted);
}

// Makes one grey ramp for all objects. Of their paint only the finish is kept.
void Palette::makeGrey(Model& model, bool painted)
{
    for (int i = 0; i < STEPS; ++i) {
        const uint8_t value = static_cast<uint8_t>(i < DARKEST ? DARKEST : i);
        const int entry = evenEntry(i, STEPS, 0, 1);
        memset(dac_ + 3 * entry, value, 3);
        ramps_[0][SHADING_MOST + i] = static_cast<uint8_t>(entry);
    }
    describeEntries(1);
    for (int i = 0; i < model.count(); ++i) {
        model.actor(i).object->setRamp(ramp(1));
        if (!painted)
            continue;
        if (paint_[i].finish == FINISH_MATT)
            model.actor(i).object->setPaint(nullptr);
        paint_[i].pattern = PATTERN_NONE;
        paint_[i].mixes = false;
        paint_[i].number = 0;
        handRamps(paint_[i]);
    }
}

// Makes a ramp for each colour that the paints have chosen or, without paint, that the objects have.
void Palette::makeColours(Model& model, bool painted)
{
    memcpy(dac_, BACKGROUND_COLOUR, sizeof BACKGROUND_COLOUR);
    Colour colours[RAMPS_MOST];
    bool shines[RAMPS_MOST] = {};
    int rampOf[Model::OBJECTS_MOST];
    int count = 0;
    if (painted) {
        for (; count < paints_.count(); ++count) {
            colours[count] = paints_.colour(count);
            shines[count] = paints_.shines(count);
        }
    } else {
        count = coloursOf(model, colours, rampOf);
    }
    if (count == 0)
        return;
    if (count > EVEN_MOST)
        share(colours, shines, count, painted ? &paints_ : nullptr);
    else
        shareEvenly(colours, shines, count);
    describeEntries(count);
    for (int i = 0; i < model.count(); ++i) {
        if (painted) {
            rampOf[i] = paint_[i].number;
            handRamps(paint_[i]);
        }
        model.actor(i).object->setRamp(ramps_[rampOf[i]] + SHADING_MOST);
    }
}

// Lengthens the ramps, and finds the brightness and the ramp of each entry.
void Palette::describeEntries(int count)
{
    constexpr uint8_t SHARED = 255;  // for now: several ramps have the entry
    static_assert(RAMPS_MOST < SHARED);
    memset(rampOf_, 0, sizeof rampOf_);
    for (int c = 0; c < count; ++c) {
        const uint8_t* const ramp = lengthen(ramps_[c] + SHADING_MOST);
        const uint8_t number = static_cast<uint8_t>(c + 1);
        for (int i = 0; i < STEPS; ++i) {
            steps_[ramp[i]] = static_cast<uint8_t>(i);
            uint8_t& of = rampOf_[ramp[i]];
            of = of == 0 || of == number ? number : SHARED;
        }
    }
    for (uint8_t& of : rampOf_)
        of = of == SHARED ? 0 : of;
}

void Palette::handRamps(Paint& paint) const
{
    paint.ramps = ramps_[0] + SHADING_MOST;
    paint.rampRoom = RAMP;
    paint.ramp = paint.ramps + paint.number * RAMP;
}

// Gives each ramp the same number of palette entries of its own.
void Palette::shareEvenly(const Colour* colours, const bool* shines, int count)
{
    const int steps = ENTRIES / count < STEPS ? ENTRIES / count : STEPS;
    for (int c = 0; c < count; ++c) {
        for (int i = 0; i < STEPS; ++i)
            ramps_[c][SHADING_MOST + i] = static_cast<uint8_t>(evenEntry((i * (steps - 1) + 31) / 63, steps, c, count));
        for (int i = 0; i < steps; ++i) {
            const int step = (i * 63 + (steps - 1) / 2) / (steps - 1);
            shade(colours[c], shines[c], step, dac_ + 3 * evenEntry(i, steps, c, count));
        }
    }
}

// Divides the wishes of all ramps into as many boxes as there are palette entries.
void Palette::share(const Colour* colours, const bool* shines, int count, const Paints* weights)
{
    static Wish wishes[RAMPS_MOST * STEPS];
    int wished = 0;
    for (int c = 0; c < count; ++c)
        wished += wishesOf(colours[c], shines[c], c, weights == nullptr ? 1 : weights->weight(c), wishes + wished);
    Box boxes[ENTRIES];
    const int used = divideAll(wishes, wished, boxes, ENTRIES);
    sort(boxes, used);
    for (int i = 0; i < used; ++i) {
        const Box& box = boxes[i];
        for (int p = 0; p < 3; ++p)
            dac_[3 * (1 + i) + p] = static_cast<uint8_t>((box.sum[p] + box.weight / 2) / box.weight);
        for (int w = box.from; w < box.to; ++w)
            memset(ramps_[wishes[w].colour] + SHADING_MOST + wishes[w].step, 1 + i, wishes[w].steps);
    }
    for (int c = 0; c < count; ++c)
        neverDarken(ramps_[c] + SHADING_MOST);
}

// A shared entry may be a little darker than the entry of the step before. Such steps repeat that entry, so that no ramp gets
// darker towards the light.
void Palette::neverDarken(uint8_t* ramp) const
{
    const auto light = [&](int step) {
        const uint8_t* entry = dac_ + 3 * ramp[step];
        return entry[0] + entry[1] + entry[2];
    };
    for (int step = 1; step < STEPS; ++step)
        if (light(step) < light(step - 1))
            ramp[step] = ramp[step - 1];
}

const uint8_t* Palette::raised(const uint8_t* ramp, int steps)
{
    raisedNumber_ = numberOf(ramp);
    for (int i = 0; i < STEPS; ++i) {
        const int step = i + steps;
        raised_[SHADING_MOST + i] = ramp[step < 0 ? 0 : step > STEPS - 1 ? STEPS - 1 : step];
    }
    return lengthen(raised_ + SHADING_MOST);
}
