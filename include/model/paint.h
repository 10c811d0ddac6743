// Paint: what an object shows besides its brightness under the light: its colour, its finish, its pattern, and whether its
// colour mixes with those of the objects it blends with. A scene says so in words (Coat); Paints chooses the colours that
// this takes, and a Paint tells the surface which of them a place has.
#ifndef FB_PAINT_H
#define FB_PAINT_H

#include "math/vec.h"

class Model;

struct Colour {
    uint8_t red, green, blue;  // 0..255

    bool operator==(const Colour& c) const { return red == c.red && green == c.green && blue == c.blue; }
};

// The colour of an object that is given none, by how many there are before it.
Colour usualColour(int before);

// What a scene's lines `finish` and `pattern` say, in the order of their words.
enum Finish : uint8_t { FINISH_MATT, FINISH_SHINY, FINISH_MIRROR };
enum Pattern : uint8_t { PATTERN_NONE, PATTERN_CHECKS, PATTERN_STRIPES, PATTERN_MARBLE };
constexpr int FINISHES = 3, PATTERNS = 4;
extern const char* const FINISH_WORDS[FINISHES];
extern const char* const PATTERN_WORDS[PATTERNS];  // the first is no word of a scene

struct Coat {
    Finish finish = FINISH_MATT;
    Pattern pattern = PATTERN_NONE;
    Real grain{0};             // size of the pattern, units, before any scaling of the object
    Colour colour{0, 0, 0};    // the pattern's other colour
};

class Paints;

// The paint of one object, as its surface works with it. Places in the colours' box are counted as Paints has them.
struct Paint {
    Finish finish;
    Pattern pattern;
    bool mixes;
    uint8_t other;         // number of the pattern's colour
    Real grain, made;      // as the coat has it, and the size that the object had when it was made
    Vector at, otherAt;    // the object's own colour and the pattern's, in the box
    Paints* paints;
    const uint8_t* ramp;   // of the own colour; as SoftObject::ramp() while nothing else is wanted of the object
    const uint8_t* ramps;  // of all numbers, one every rampRoom bytes
    int rampRoom;
    uint8_t number;        // of the own colour

    bool shines() const { return finish != FINISH_MATT; }
};

// The colours of a model: each object's, those of patterns, and what lies between them where they mix. A colour that shines
// is another than the same colour that is matt, because its ramp ends in white.
class Paints {
public:
    static constexpr int MOST = 240;

    // Chooses the colours, fills in a paint for each object (but for its ramps) and hands it over. Where more colours are
    // wanted than there may be, neighbouring mixtures become one. False: each object has a colour of its own, matt, and no
    // paint is made.
    bool choose(const Model& model, Paint* paints);

    // The colours, numbered from 0: first those of the objects, in their order.
    int count() const { return count_; }
    const Colour& colour(int number) const { return colours_[number]; }
    bool shines(int number) const { return shines_[number]; }
    // How much more than others a colour is seen: one of its own most, a mixture of three least.
    int weight(int number) const { return number < own_ ? 8 : number < pairs_ ? 2 : 1; }
    // The number of a colour that was chosen; else of the nearest.
    int numberOf(const Colour& colour, bool shines) const;

    // A colour in the box that holds all that mix: 0..SIDE - 1 along each axis.
    static constexpr int SIDE = 16;
    Vector inBox(const Colour& colour) const;
    const Vector& placeOf(int number) const { return places_[number]; }
    // The number of the colour at a place of the box.
    uint8_t numberAt(const Vector& place, bool shines)
    {
        const int cell = cellOf(place);
        return cells_[shines][cell] < WANTED ? cells_[shines][cell] : fill(cell, shines);
    }

private:
    // What a cell has that holds no colour; and one that will.
    static constexpr uint8_t EMPTY = 255, WANTED = 254;

    static int cellOf(const Vector& place)
    {
        const Real half(0.5);
        return (floorToInt(place.x + half) * SIDE + floorToInt(place.y + half)) * SIDE + floorToInt(place.z + half);
    }
    int add(const Colour& colour, bool shines);
    void measureBox();
    void markPairs();
    void markTriples();
    void mark(const Vector& place, bool shines);
    void markLine(const Vector& a, const Vector& b, bool shines);
    void markTriangle(const Vector& a, const Vector& b, const Vector& c, bool shines);
    Colour inCell(int x, int y, int z) const;
    int blocks(int side, bool shines, bool make);
    void takeCoats(const Model& model, Paint* paints);
    void chooseMixtures(const Model& model, const Paint* paints);
    void chooseWanted();
    uint8_t fill(int cell, bool shines);

    int count_ = 0;
    // Those before objects_ are objects' own, those before own_ are asked for by name, those from pairs_ on are mixtures of three.
    int objects_ = 0, own_ = 0, pairs_ = 0;
    Colour colours_[MOST];
    bool shines_[MOST];
    Vector places_[MOST];
    int least_[3] = {0, 0, 0}, most_[3] = {0, 0, 0};  // red, green and blue of the box
    uint8_t cells_[2][SIDE * SIDE * SIDE];  // matt, shining: the number of the colour there
    int wanted_[2] = {0, 0};                // and how many wait for one
};

#endif
