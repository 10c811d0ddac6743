// Paints: chooses the colours of a model. Knows neither the palette nor the screen.
#include "model/paint.h"

#include "model/model.h"
#include "rt.h"

const char* const FINISH_WORDS[] = {"matt", "shiny", "mirror"};
const char* const PATTERN_WORDS[] = {"none", "checks", "stripes", "marble"};

Colour usualColour(int before)
{
    static const Colour COLOURS[] = {{255, 64, 48},  {64, 208, 72},  {72, 112, 255}, {255, 200, 48},
                                     {224, 80, 224}, {64, 208, 216}, {255, 136, 40}, {208, 208, 208}};
    return COLOURS[before % 8];
}

namespace {

// Number of steps in which mixtures are looked for along a line, and along a side of a triangle.
constexpr int LINE_STEPS = 2 * Paints::SIDE, TRIANGLE_STEPS = Paints::SIDE;

// With more colours of objects than this, no mixtures of three are chosen; the nearest colour is used for them.
constexpr int TRIPLES_MOST = 16;

Vector between(const Vector& a, const Vector& b, int step, int steps)
{
    return a + (b - a) * (Real(step) / Real(steps));
}

int component(const Colour& c, int i)
{
    return i == 0 ? c.red : i == 1 ? c.green : c.blue;
}

}  // namespace

int Paints::add(const Colour& colour, bool shines)
{
    for (int i = 0; i < count_; ++i)
        if (colours_[i] == colour && shines_[i] == shines)
            return i;
    if (count_ == MOST)
        return -1;
    colours_[count_] = colour;
    shines_[count_] = shines;
    return count_++;
}

int Paints::numberOf(const Colour& colour, bool shines) const
{
    int nearest = 0, least = 0x7fffffff;
    for (int i = 0; i < count_; ++i) {
        const int red = colours_[i].red - colour.red, green = colours_[i].green - colour.green,
                  blue = colours_[i].blue - colour.blue;
        const int square = red * red + green * green + blue * blue;
        if (square < least && shines_[i] == shines) {
            least = square;
            nearest = i;
        }
    }
    return nearest;
}

// Computes the box around all colours chosen so far.
void Paints::measureBox()
{
    for (int p = 0; p < 3; ++p) {
        least_[p] = 255;
        most_[p] = 0;
        for (int i = 0; i < count_; ++i) {
            const int value = component(colours_[i], p);
            least_[p] = value < least_[p] ? value : least_[p];
            most_[p] = value > most_[p] ? value : most_[p];
        }
    }
    for (int i = 0; i < count_; ++i)
        places_[i] = inBox(colours_[i]);
}

Vector Paints::inBox(const Colour& colour) const
{
    const auto along = [&](int p) {
        return most_[p] == least_[p] ? Real(0) : Real((component(colour, p) - least_[p]) * (SIDE - 1)) / Real(most_[p] - least_[p]);
    };
    return {along(0), along(1), along(2)};
}

Colour Paints::inCell(int x, int y, int z) const
{
    const auto value = [&](int p, int at) {
        return static_cast<uint8_t>(least_[p] + ((most_[p] - least_[p]) * at + (SIDE - 1) / 2) / (SIDE - 1));
    };
    return {value(0, x), value(1, y), value(2, z)};
}

void Paints::mark(const Vector& place, bool shines)
{
    uint8_t& cell = cells_[shines][cellOf(place)];
    if (cell != EMPTY)
        return;
    cell = WANTED;
    ++wanted_[shines];
}

void Paints::markLine(const Vector& a, const Vector& b, bool shines)
{
    for (int i = 0; i <= LINE_STEPS; ++i)
        mark(between(a, b, i, LINE_STEPS), shines);
}

void Paints::markTriangle(const Vector& a, const Vector& b, const Vector& c, bool shines)
{
    for (int i = 1; i < TRIANGLE_STEPS; ++i) {
        const Vector from = between(a, b, i, TRIANGLE_STEPS), to = between(a, c, i, TRIANGLE_STEPS);
        for (int j = 1; j < i; ++j)
            mark(between(from, to, j, i), shines);
    }
}

// Tells which objects' own colours belong to linked objects: of_[a][b] for the colours numbered a and b.
class Paints::Links {
public:
    explicit Links(const Model& model);
    bool are(int a, int b) const { return of_[a][b]; }

private:
    bool of_[Model::OBJECTS_MOST][Model::OBJECTS_MOST] = {};
};

Paints::Links::Links(const Model& model)
{
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject* const object = model.actor(i).object;
        for (const List<Link>::Node* node = object->skel().first(); node != nullptr; node = node->next)
            if (node->item.weight > Real(0))
                of_[object->paint()->number][node->item.object->paint()->number] = true;
    }
}

// Marks the mixtures of two colours whose objects are linked.
void Paints::markPairs(const Links& linked)
{
    for (int a = 0; a < objects_; ++a)
        for (int b = 0; b < objects_; ++b)
            if (a != b && linked.are(a, b))
                markLine(places_[a], places_[b], shines_[a]);
}

// Marks the mixtures of three colours whose objects are linked with each other.
void Paints::markTriples(const Links& linked)
{
    for (int a = 0; objects_ <= TRIPLES_MOST && a < objects_; ++a)
        for (int b = 0; b < objects_; ++b)
            for (int c = 0; c < b; ++c)
                if (b != a && c != a && linked.are(a, b) && linked.are(a, c) && linked.are(b, c))
                    markTriangle(places_[a], places_[b], places_[c], shines_[a]);
}

// Counts the blocks of cells, `side` cells to an edge, that contain a wanted cell. With `make`, the wanted cells of each block
// get one colour, the mean of their places.
int Paints::blocks(int side, bool shines, bool make)
{
    int count = 0;
    if (wanted_[shines] == 0)
        return 0;
    // Then each cell is a block.
    if (side == 1 && !make)
        return wanted_[shines];
    for (int block = 0; block < SIDE * SIDE * SIDE / (side * side * side); ++block) {
        const int row = SIDE / side;
        const int x = block / (row * row) * side, y = block / row % row * side, z = block % row * side;
        int sum[3] = {0, 0, 0}, cells = 0;
        const auto each = [&](auto does) {
            for (int i = x; i < x + side; ++i)
                for (int j = y; j < y + side; ++j)
                    for (int k = z; k < z + side; ++k)
                        if (cells_[shines][(i * SIDE + j) * SIDE + k] == WANTED)
                            does(i, j, k);
        };
        each([&](int i, int j, int k) {
            sum[0] += i;
            sum[1] += j;
            sum[2] += k;
            ++cells;
        });
        if (cells == 0)
            continue;
        ++count;
        if (!make)
            continue;
        const auto mean = [&](int p) { return (sum[p] + cells / 2) / cells; };
        const Colour colour = inCell(mean(0), mean(1), mean(2));
        const uint8_t number = static_cast<uint8_t>(add(colour, shines));
        places_[number] = inBox(colour);
        each([&](int i, int j, int k) { cells_[shines][(i * SIDE + j) * SIDE + k] = number; });
    }
    return count;
}

// Gives a colour to each wanted cell; if there are too many, one colour to each block of them, with blocks as small as
// possible.
void Paints::chooseWanted()
{
    for (int side = 1; side <= SIDE; side *= 2) {
        if (count_ + blocks(side, false, false) + blocks(side, true, false) > MOST)
            continue;
        blocks(side, false, true);
        blocks(side, true, true);
        wanted_[0] = wanted_[1] = 0;
        break;
    }
}

// A cell without a colour of its own gets the nearest colour when it is first asked for.
uint8_t Paints::fill(int cell, bool shines)
{
    const Colour colour = inCell(cell / (SIDE * SIDE), cell / SIDE % SIDE, cell % SIDE);
    return cells_[shines][cell] = static_cast<uint8_t>(numberOf(colour, shines));
}

bool Paints::choose(const Model& model, Paint* paints)
{
    count_ = 0;
    bool any = model.mixed, boxed = model.mixed;
    for (int i = 0; i < model.count(); ++i) {
        const Coat& coat = model.actor(i).coat;
        any = any || coat.finish != FINISH_MATT || coat.pattern != PATTERN_NONE;
        boxed = boxed || coat.pattern == PATTERN_MARBLE;
    }
    if (!any)
        return false;
    takeCoats(model, paints);
    own_ = pairs_ = count_;
    if (boxed)
        chooseMixtures(model, paints);
    return true;
}

// Adds the colours that the scene names, and fills in the paints.
void Paints::takeCoats(const Model& model, Paint* paints)
{
    for (int i = 0; i < model.count(); ++i) {
        const Actor& actor = model.actor(i);
        Paint& paint = paints[i];
        paint.finish = actor.coat.finish;
        paint.pattern = actor.coat.pattern;
        paint.mixes = model.mixed;
        paint.grain = actor.coat.grain;
        paint.made = actor.made;
        paint.paints = this;
        paint.number = static_cast<uint8_t>(add(actor.colour, paint.shines()));
        actor.object->setPaint(&paint);
    }
    objects_ = count_;
    for (int i = 0; i < model.count(); ++i)
        if (paints[i].pattern != PATTERN_NONE)
            add(model.actor(i).coat.colour, paints[i].shines());
    measureBox();
    for (int i = 0; i < model.count(); ++i) {
        Paint& paint = paints[i];
        const Colour& other = model.actor(i).coat.colour;
        paint.other = static_cast<uint8_t>(numberOf(other, paint.shines()));
        paint.at = places_[paint.number];
        paint.otherAt = places_[paint.other];
    }
}

// Adds mixtures of the two colours of a marble and, where colours mix, of two and three linked objects.
void Paints::chooseMixtures(const Model& model, const Paint* paints)
{
    memset(cells_, EMPTY, sizeof cells_);
    wanted_[0] = wanted_[1] = 0;
    for (int i = count_ - 1; i >= 0; --i)
        cells_[shines_[i]][cellOf(places_[i])] = static_cast<uint8_t>(i);
    for (int i = 0; i < model.count(); ++i)
        if (paints[i].pattern == PATTERN_MARBLE)
            markLine(paints[i].at, paints[i].otherAt, paints[i].shines());
    const Links linked(model);
    if (model.mixed)
        markPairs(linked);
    chooseWanted();
    pairs_ = count_;
    if (model.mixed) {
        markTriples(linked);
        chooseWanted();
    }
}
