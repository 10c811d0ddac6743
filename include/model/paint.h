// Paint: what an object shows besides its brightness under the light: its colour, its finish, its pattern, and whether its
// colour mixes with those of the objects it blends with. A scene describes this in words (Coat). Paints chooses the colours
// that are needed, and a Paint tells the surface which of them each place shows. Palettes are made elsewhere.
#ifndef FB_PAINT_H
#define FB_PAINT_H

#include "math/vec.h"

class Model;

struct Colour {
    uint8_t red, green, blue;  // 0..255

    bool operator==(const Colour& c) const { return red == c.red && green == c.green && blue == c.blue; }
};

// The colour of an object that is given none, when there are `before` objects before it. The eight colours repeat.
Colour usualColour(int before);

// The words of a scene's lines `finish` and `pattern` are in the order of these enumerations.
enum Finish : uint8_t { FINISH_MATT, FINISH_SHINY, FINISH_MIRROR };
enum Pattern : uint8_t { PATTERN_NONE, PATTERN_CHECKS, PATTERN_STRIPES, PATTERN_MARBLE };
constexpr int FINISHES = 3, PATTERNS = 4;
extern const char* const FINISH_WORDS[FINISHES];
extern const char* const PATTERN_WORDS[PATTERNS];  // the first is not used in scenes

struct Coat {
    Finish finish = FINISH_MATT;
    Pattern pattern = PATTERN_NONE;
    Real grain{0};             // size of the pattern, units, before any scaling of the object
    Colour colour{0, 0, 0};    // the pattern's other colour
};

class Paints;

// The paint of one object in the form that its surface uses. Places in the box of colours are as defined by Paints::inBox().
struct Paint {
    Finish finish;
    Pattern pattern;
    bool mixes;
    uint8_t other;         // number of the pattern's colour
    Real grain, made;      // size of the pattern from the coat; size of the object when it was made
    Vector at, otherAt;    // places in the box of the object's own colour and of the pattern's
    Paints* paints;
    const uint8_t* ramp;   // of the own colour; SoftObject::ramp() differs from it while the object is shown otherwise
    const uint8_t* ramps;  // the ramps of all colours by number, one every rampRoom bytes
    int rampRoom;
    uint8_t number;        // number of the own colour

    bool shines() const { return finish != FINISH_MATT; }
};

// The colours of a model: the objects' own, those of the patterns, and mixtures of them. A shining colour is not the same as a
// matt colour of equal red, green and blue, because the ramp of a shining colour ends in white.
class Paints {
public:
    static constexpr int MOST = 240;

    // Chooses the colours, fills in a paint for each object (all but its ramps) and gives it to the object. If more colours are
    // wanted than MOST, neighbouring mixtures share one. Returns false if no paint is needed, because every object is matt and
    // plain and colours do not mix.
    bool choose(const Model& model, Paint* paints);

    // The colours, numbered from 0; the objects' own colours come first, in the order of the objects.
    int count() const { return count_; }
    const Colour& colour(int number) const { return colours_[number]; }
    bool shines(int number) const { return shines_[number]; }
    // How much a colour matters in the picture: most for an own colour or a pattern's, least for a mixture of three.
    int weight(int number) const { return number < own_ ? 8 : number < pairs_ ? 2 : 1; }
    // The number of a chosen colour, or of the one nearest to it that shines (or is matt) likewise.
    int numberOf(const Colour& colour, bool shines) const;

    // The place of a colour in the smallest box of red, green and blue that holds all colours to be mixed: 0..SIDE - 1 along
    // each axis.
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
    // Contents of a cell without a colour, and of a cell that is to get one.
    static constexpr uint8_t EMPTY = 255, WANTED = 254;

    static int cellOf(const Vector& place)
    {
        const Real half(0.5);
        return (floorToInt(place.x + half) * SIDE + floorToInt(place.y + half)) * SIDE + floorToInt(place.z + half);
    }
    int add(const Colour& colour, bool shines);
    void measureBox();
    class Links;
    void markPairs(const Links& linked);
    void markTriples(const Links& linked);
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
    // Colours before objects_ are objects' own, those before own_ are named in the scene, those from pairs_ on are mixtures of
    // three.
    int objects_ = 0, own_ = 0, pairs_ = 0;
    Colour colours_[MOST];
    bool shines_[MOST];
    Vector places_[MOST];
    int least_[3] = {0, 0, 0}, most_[3] = {0, 0, 0};  // range of red, green and blue in the box
    uint8_t cells_[2][SIDE * SIDE * SIDE];  // [matt, shining]: number of each cell's colour
    int wanted_[2] = {0, 0};                // [matt, shining]: number of WANTED cells
};

#endif
