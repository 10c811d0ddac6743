// Reader: the table of statements, and the names by which lines refer to items.
#include "reader.h"

// The statements besides the kinds of objects. A complaint lists them in this order.
const Reader::Statement Reader::STATEMENTS[] = {
    {"group", &Reader::group},     {"blend", &Reader::blend}, {"dent", &Reader::dent},       {"strength", &Reader::strength},
    {"circle", &Reader::circle},   {"path", &Reader::path},   {"spin", &Reader::spin},       {"swing", &Reader::swing},
    {"pulse", &Reader::pulse},     {"taper", &Reader::taper}, {"twist", &Reader::twist},     {"bend", &Reader::bend},
    {"keys", &Reader::keys},       {"key", &Reader::key},     {"colours", &Reader::colours}, {"finish", &Reader::finish},
    {"pattern", &Reader::pattern}, {"eye", &Reader::eye},     {"look", &Reader::look},       {"roll", &Reader::roll},
    {"focal", &Reader::focal},     {"light", &Reader::light}, {"title", &Reader::title},
};

bool Reader::read()
{
    bool there;
    for (;;) {
        if (!nextLine(&there))
            return false;
        if (!there)
            break;
        if (nextWord() && !statement())
            return false;
    }
    word_ = "end of file";
    return model_.count() > 0 ? true : expected("at least one object");
}

bool Reader::statement()
{
    const Kind* kind = kindNamed(word_);
    if (kind != nullptr)
        return object(kind);
    for (const Statement& known : STATEMENTS)
        if (is(known.word))
            return (this->*known.read)();
    if (is("colors"))
        return colours();
    return expectedStatement();
}

bool Reader::expectedStatement()
{
    char text[300];
    int length = 0;
    const auto add = [&](const char* word, const char* behind) {
        length += snprintf(text + length, sizeof text - static_cast<size_t>(length), "%s%s", word, behind);
    };
    for (int i = 0; i < KIND_COUNT; ++i)
        add(KINDS[i].word, ", ");
    const int last = static_cast<int>(sizeof STATEMENTS / sizeof STATEMENTS[0]) - 1;
    for (int i = 0; i <= last; ++i)
        add(STATEMENTS[i].word, i == last ? "" : i == last - 1 ? " or " : ", ");
    return expected(text);
}

// --- Names of items

// Reads the name of an item (not of a row) that a line above has made.
bool Reader::readKnown(const char* what, Actor** item)
{
    nextWord();
    *item = isEmpty() ? nullptr : model_.itemNamed(word_);
    if (*item == nullptr && is(EYE_NAME)) {
        *item = eyeCarrier();
        return *item != nullptr;
    }
    return *item != nullptr ? true : expected(what);
}

const Row* Reader::rowNamed(const char* name) const
{
    for (int i = 0; i < rows_; ++i)
        if (strcmp(row_[i].name, name) == 0)
            return &row_[i];
    return nullptr;
}

// Finds the items that a name stands for. Returns false, without a complaint, if there are none.
bool Reader::find(const char* name, Row* row) const
{
    const Row* known = rowNamed(name);
    if (known != nullptr) {
        *row = *known;
        return true;
    }
    for (int i = 0; i < model_.items(); ++i) {
        if (strcmp(model_.item(i).name, name) != 0)
            continue;
        row->first = i;
        row->count = 1;
        return true;
    }
    return false;
}

// Reads the name of the items that a line of motion moves.
bool Reader::readMoving(Row* row)
{
    nextWord();
    if (!isEmpty() && find(word_, row))
        return true;
    if (!is(EYE_NAME))
        return expected("the name of an object or a group");
    const Actor* carrier = eyeCarrier();
    return carrier != nullptr && find(carrier->name, row);
}

// Returns true if the latest word stands for an object or a row of objects. Never complains.
bool Reader::isObjects(Row* row) const
{
    return !isEmpty() && find(word_, row) && in(*row, 0).object != nullptr;
}

bool Reader::readObjects(Row* row)
{
    nextWord();
    return isObjects(row) ? true : expected("the name of an object");
}

// The group that the eye moves with, made if necessary. Complains and returns null if there cannot be one.
Actor* Reader::eyeCarrier()
{
    if (model_.camera.carrier == 0) {
        word_ = EYE_NAME;
        if (isTaken(EYE_NAME)) {
            expected("another name for the object or group of that name, for the eye moves");
            return nullptr;
        }
        if (model_.items() - model_.count() == Model::GROUPS_MOST) {
            expectedAtMost(Model::GROUPS_MOST, "groups, the eye that moves among them");
            return nullptr;
        }
    }
    Actor* carrier = model_.eyeCarrier();
    if (carrier == nullptr)
        trouble("not enough memory for the model");
    return carrier;
}
