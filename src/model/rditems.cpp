// Reader: the lines that make objects, groups and rows of them, and the lines that say what blends with what.
#include "reader.h"

namespace {

// "blend all" visits every pair; no scene needs it often. The number of pairs in lines that link or dent rows is limited
// likewise.
constexpr int ALL_MOST = 8;
constexpr int ROW_PAIRS_MOST = 65024;

// Gives an item of a row its name: the row's name and a number. The caller has checked that both fit.
void nameInRow(Actor& actor, const Row& row, int i)
{
    char name[NAME_ROOM + 12];
    snprintf(name, sizeof name, "%s%d", row.name, i + 1);
    memcpy(actor.name, name, NAME_ROOM);
}

}  // namespace

// --- Objects and groups

const Reader::Clause Reader::CLAUSES[] = {
    {"at", true, true, &Reader::itemPlace},          {"turn", true, true, &Reader::itemTurn},
    {"in", true, true, &Reader::itemParent},         {"repeat", true, true, &Reader::itemRepeat},
    {"step", true, true, &Reader::itemStep},         {"colour", true, false, &Reader::itemColour},
    {"color", true, false, &Reader::itemColour},     {"stretch", true, false, &Reader::itemStretch},
    {"scale", false, true, &Reader::itemScale},
};

// Reads a line that makes an object of a kind, or a group (`kind` null).
bool Reader::object(const Kind* kind)
{
    ItemLine line;
    line.actor.kind = kind;
    line.actor.colour = usualColour(model_.count());
    if (!itemName(line))
        return false;
    while (nextWord())
        if (!itemClause(line))
            return false;
    for (int i = 0; kind != nullptr && i < kind->measures; ++i)
        if ((line.given & 1 << i) == 0)
            return expected(kind->measure[i].word);
    const char* fits = Model::expects(line.actor);
    if (fits != nullptr) {
        word_ = line.actor.name;
        return expected(fits);
    }
    if (line.count > Real(1))
        return addRow(line);
    if (line.stepped) {
        word_ = "step";
        return expected("repeat as well, for step to count");
    }
    // Checked only after all clauses, because with `in eye` the eye may have become the last group.
    word_ = line.actor.name;
    if (!roomFor(kind == nullptr, 1))
        return false;
    return model_.addItem(line.actor) != nullptr ? true : trouble("not enough memory for the model");
}

bool Reader::itemName(ItemLine& line)
{
    if (!readName("a name of 1 to 15 letters, digits, - or _, a letter first"))
        return false;
    if (is("all"))
        return expected("another name; all stands for every object");
    if (isTaken(word_))
        return expected("a name that is not taken yet");
    strcpy(line.actor.name, word_);
    return true;
}

// Returns true if there is room for `count` more groups or objects; complains if not.
bool Reader::roomFor(bool groups, int count)
{
    const int taken = groups ? model_.items() - model_.count() : model_.count();
    const int most = groups ? Model::GROUPS_MOST : Model::OBJECTS_MOST;
    return taken + count <= most ? true : expectedAtMost(most, groups ? "groups" : "objects");
}

// Reads the clause that the latest word begins.
bool Reader::itemClause(ItemLine& line)
{
    const Kind* kind = line.actor.kind;
    const int measures = kind == nullptr ? 0 : kind->measures;
    for (int i = 0; i < measures; ++i) {
        const Measure& m = kind->measure[i];
        if (!is(m.word))
            continue;
        line.given |= 1 << i;
        return readReal(m.word, m.least, m.most, &line.actor.measure[i]);
    }
    for (const Clause& clause : CLAUSES)
        if (is(clause.word) && (kind != nullptr ? clause.ofObjects : clause.ofGroups))
            return (this->*clause.read)(line);
    char text[120];
    int length = 0;
    for (int i = 0; i < measures; ++i)
        length += snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s, ", kind->measure[i].word);
    snprintf(text + length, sizeof text - static_cast<size_t>(length), "at, turn, %s, repeat, step or in",
             kind != nullptr ? "colour, stretch" : "scale");
    return expected(text);
}

bool Reader::itemPlace(ItemLine& line)
{
    Vector v;
    if (!readPlace("a place, ", &v))
        return false;
    line.actor.motion.centre = toPoint(v);
    return true;
}

bool Reader::itemTurn(ItemLine& line)
{
    line.actor.motion.parts |= MOTION_TURN;
    return readVector("degrees about ", -DEGREES_MOST, DEGREES_MOST, &line.actor.motion.turn);
}

bool Reader::itemParent(ItemLine& line)
{
    Actor* parent;
    if (!readKnown("a group or an object of a line above", &parent))
        return false;
    line.actor.motion.parent = parent->number;
    return true;
}

bool Reader::itemRepeat(ItemLine& line)
{
    const Real most(line.actor.kind != nullptr ? Model::OBJECTS_MOST : Model::GROUPS_MOST);
    if (!readReal("a whole number", Real(Row::LEAST), most, &line.count))
        return false;
    return line.count == Real(floorToInt(line.count)) ? true : expected("a whole number");
}

bool Reader::itemStep(ItemLine& line)
{
    line.stepped = true;
    return readPlace("a step, ", &line.step);
}

bool Reader::itemColour(ItemLine& line)
{
    line.coloured = true;
    return readColour(&line.actor.colour);
}

bool Reader::itemStretch(ItemLine& line)
{
    return readVector("a factor along ", STRETCH_LEAST, STRETCH_MOST, &line.actor.stretch);
}

bool Reader::itemScale(ItemLine& line)
{
    return readReal("a scale", SCALE_LEAST, SCALE_MOST, &line.actor.motion.scale);
}

// Adds as many items as the line says, NAME1, NAME2 and so on, each a step away from the previous one.
bool Reader::addRow(ItemLine& line)
{
    Actor& actor = line.actor;
    const bool group = actor.kind == nullptr;
    Row row;
    strcpy(row.name, actor.name);
    row.first = model_.items();
    row.count = floorToInt(line.count);
    word_ = row.name;
    if (!roomFor(group, row.count))
        return false;
    const int digits = row.count > 99 ? 3 : row.count > 9 ? 2 : 1;
    if (static_cast<int>(strlen(row.name)) + digits >= NAME_ROOM)
        return expectedAtMost(NAME_ROOM - 1 - digits, "characters in the name of such a row");
    word_ = actor.name;
    for (int i = 0; i < row.count; ++i) {
        nameInRow(actor, row, i);
        if (isTaken(actor.name))
            return expected("a name that is not taken yet");
        if (i > 0)
            actor.motion.centre = actor.motion.centre + line.step;
        if (!isInSpace(actor.motion.centre))
            return expected("steps that stay between -250 and 250");
        if (!group && !line.coloured)
            actor.colour = usualColour(model_.count());
        if (model_.addItem(actor) == nullptr)
            return trouble("not enough memory for the model");
    }
    row_[rows_++] = row;
    return true;
}

// --- What blends with what

// Reads two names of objects or rows; the first is the latest word.
bool Reader::readPair(const char* what, Row* a, Row* b)
{
    if (!isObjects(a))
        return expected(what);
    nextWord();
    const bool second = isObjects(b);
    if (!second || (a->first == b->first && a->count == 1 && b->count == 1))
        return expected("the name of a second object");
    if (a->count > 1 || b->count > 1)
        rowPairs_ += a->count * b->count;
    return rowPairs_ <= ROW_PAIRS_MOST ? true : expectedAtMost(ROW_PAIRS_MOST, "pairs in all lines that blend or dent rows");
}

// Reads a weight, which may be missing, and the end of the line.
bool Reader::readWeight(Real* weight)
{
    *weight = Real(1);
    const char* behind = at_;
    if (!nextWord())
        return true;
    at_ = behind;
    return readReal("a weight", Real(0), WEIGHT_MOST, weight) && readEnd();
}

bool Reader::dent()
{
    nextWord();
    Row a, b;
    Real weight;
    if (!readPair("the name of an object", &a, &b) || !readWeight(&weight))
        return false;
    bool good = true;
    for (int i = 0; i < a.count; ++i)
        for (int j = 0; j < b.count; ++j)
            if (a.first + i != b.first + j)
                good = good && model_.dent(in(a, i).object, in(b, j).object, weight);
    return good ? true : trouble("not enough memory for the dents");
}

bool Reader::blend()
{
    nextWord();
    const bool all = is("all");
    Row a, b;
    if (!all && !readPair("all, or the name of an object", &a, &b))
        return false;
    if (all && ++allBlended_ > ALL_MOST)
        return expected("blend all in at most 8 lines");
    Real weight;
    if (!readWeight(&weight))
        return false;
    bool good = all ? model_.linkAll(weight) : true;
    for (int i = 0; !all && i < a.count; ++i)
        for (int j = 0; j < b.count; ++j)
            if (a.first + i != b.first + j)
                good = good && model_.link(in(a, i).object, in(b, j).object, weight);
    return good ? true : trouble("not enough memory for the links");
}

bool Reader::strength()
{
    Row row;
    if (!readObjects(&row))
        return false;
    Real strength;
    if (!readReal("a strength", STRENGTH_LEAST, STRENGTH_MOST, &strength) || !readEnd())
        return false;
    for (int i = 0; i < row.count; ++i) {
        in(row, i).strength = strength;
        in(row, i).object->setStrength(strength);
    }
    return true;
}
