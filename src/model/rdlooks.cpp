// Reader: the title, colours and coats, the eye and the light.
#include "reader.h"

// The title is the rest of the line with its upper and lower case.
bool Reader::title()
{
    word_ = "title";
    if (model_.title[0] != 0)
        return expected("one title only");
    int length;
    const char* text = restOfLine(&length);
    bool plain = true;
    for (int i = 0; i < length; ++i)
        plain = plain && text[i] >= ' ' && text[i] <= '~';
    if (length == 0 || length >= TITLE_ROOM || !plain) {
        quote(text, length);
        return expected("a title of 1 to 47 plain letters, digits and signs");
    }
    memcpy(model_.title, text, static_cast<size_t>(length));
    model_.title[length] = 0;
    return true;
}

// --- Colours and coats

bool Reader::colours()
{
    nextWord();
    if (!is("mixed") && !is("apart"))
        return expected("mixed or apart");
    model_.mixed = is("mixed");
    return readEnd();
}

bool Reader::finish()
{
    Row row;
    if (!readObjects(&row))
        return false;
    nextWord();
    for (int f = 0; f < FINISHES; ++f) {
        if (!is(FINISH_WORDS[f]))
            continue;
        for (int i = 0; i < row.count; ++i)
            in(row, i).coat.finish = static_cast<Finish>(f);
        return readEnd();
    }
    return expected("matt, shiny or mirror");
}

bool Reader::pattern()
{
    Row row;
    if (!readObjects(&row))
        return false;
    nextWord();
    Coat coat;
    for (int p = PATTERN_NONE + 1; p < PATTERNS; ++p)
        if (is(PATTERN_WORDS[p]))
            coat.pattern = static_cast<Pattern>(p);
    if (coat.pattern == PATTERN_NONE)
        return expected("checks, stripes or marble");
    if (!readReal("the size of a pattern", GRAIN_LEAST, GRAIN_MOST, &coat.grain) || !readColour(&coat.colour))
        return false;
    for (int i = 0; i < row.count; ++i) {
        coat.finish = in(row, i).coat.finish;
        in(row, i).coat = coat;
    }
    return readEnd();
}

// --- The viewer and the light

// Reads the eye's place. With `turn` or `in` the eye becomes a group.
bool Reader::eye()
{
    Vector place, turn{Real(0), Real(0), Real(0)};
    if (!readPlace("the eye's place, ", &place))
        return false;
    const Actor* parent = nullptr;
    bool turned = false;
    while (nextWord()) {
        bool good;
        if (is("turn")) {
            turned = true;
            good = readVector("degrees about ", -DEGREES_MOST, DEGREES_MOST, &turn);
        } else if (is("in")) {
            good = eyeParent(&parent);
        } else {
            good = expected("turn, in or the end of the line");
        }
        if (!good)
            return false;
    }
    if (parent != nullptr && parent->number == model_.camera.carrier) {
        word_ = parent->name;
        return expected("another group than the eye's own");
    }
    model_.camera.eye = toPoint(place);
    if (!turned && parent == nullptr && model_.camera.carrier == 0)
        return true;
    Actor* carrier = eyeCarrier();
    if (carrier == nullptr)
        return false;
    carrier->motion.centre = toPoint(place);
    carrier->motion.turn = turn;
    carrier->motion.parent = parent == nullptr ? 0 : parent->number;
    return true;
}

// Reads the name of the item that carries the eye. It must come before the eye's group, as parents come before their children.
bool Reader::eyeParent(const Actor** parent)
{
    Actor* known;
    if (!readKnown("a group or an object of a line above", &known))
        return false;
    for (int i = 0; &model_.item(i) != known; ++i)
        if (model_.item(i).number == model_.camera.carrier)
            return expected("a group or an object above the first line that moves the eye");
    *parent = known;
    return true;
}

// Reads what the eye looks at: a place, an object or a group.
bool Reader::look()
{
    Camera& camera = model_.camera;
    const char* behind = at_;
    nextWord();
    if (isEmpty())
        return expected("a place, or the name of an object or a group");
    if (isLetter(word_[0])) {
        const Actor* item = model_.itemNamed(word_);
        if (item == nullptr || item->number == camera.carrier)
            return expected("the name of an object or a group of a line above");
        camera.looks = Camera::AT_ITEM;
        camera.item = item->number;
        return readEnd();
    }
    at_ = behind;
    Vector place;
    if (!readPlace("the place looked at, ", &place))
        return false;
    camera.target = toPoint(place);
    camera.looks = Camera::AT_POINT;
    return readEnd();
}

bool Reader::roll()
{
    return readReal("degrees", -DEGREES_MOST, DEGREES_MOST, &model_.camera.roll) && readEnd();
}

bool Reader::light()
{
    return readDirection("the direction to the light, ", &model_.light) && readEnd();
}

bool Reader::focal()
{
    const Real low(FOCAL_LEAST), high(FOCAL_MOST);
    Camera& camera = model_.camera;
    if (!readReal("pixels across", low, high, &camera.focalX))
        return false;
    // A pixel is 5 wide to 6 high.
    camera.focalY = max(realFromRaw(mulDiv(rawFromReal(camera.focalX), 5, 6)), low);
    const char* behind = at_;
    if (!nextWord())
        return true;
    at_ = behind;
    return readReal("pixels down", low, high, &camera.focalY) && readEnd();
}
