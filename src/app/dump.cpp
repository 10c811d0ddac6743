// Frames to files.
#include "app/dump.h"

#include "rt.h"
#include "math/text.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr int ROWS_AT_ONCE = 10;

// The files of an older dump are looked for until so many frames in a row are missing.
constexpr int GAP_MOST = 32;
constexpr int NUMBER_MOST = 9999999;

}  // namespace

const char* Dump::complain()
{
    char plain[160];
    snprintf(problem_, sizeof problem_, "%s: %s", plainText(plain, sizeof plain, name_), machine::fileTrouble());
    return problem_;
}

const char* Dump::open(const char* directory)
{
    directory_ = directory;
    snprintf(name_, sizeof name_, "%s", directory);
    if (strlen(directory) > 120) {
        char plain[80];
        snprintf(problem_, sizeof problem_, "%s: the name is too long", plainText(plain, sizeof plain, directory));
        return problem_;
    }
    if (!machine::makeDirectory(directory))
        return complain();
    const int file = create(0, "TXT");
    if (file < 0 || !machine::closeFile(file))
        return complain();
    // Frames of an older dump would be mixed with the new ones; this takes the empty file along.
    static const char* const EXTENSIONS[] = {"PPM", "Z", "TXT"};
    for (int number = 0, missing = 0; missing < GAP_MOST && number <= NUMBER_MOST; ++number) {
        bool some = false;
        for (const char* extension : EXTENSIONS) {
            snprintf(name_, sizeof name_, "%s/F%07d.%s", directory_, number, extension);
            some = machine::removeFile(name_) || some;
        }
        missing = some ? 0 : missing + 1;
    }
    return nullptr;
}

int Dump::create(int number, const char* extension)
{
    snprintf(name_, sizeof name_, "%s/F%07d.%s", directory_, number, extension);
    return machine::createFile(name_);
}

const char* Dump::frame(int number, Time time, int rate, const Model& model, const View& view, const Palette& palette,
                        bool grey)
{
    // The picture, as the palette shows it.
    int file = create(number, "PPM");
    if (file < 0)
        return complain();
    static uint8_t buffer[ROWS_AT_ONCE * WIDTH * 4];
    static const char HEADER[] = "P6\n320 200\n255\n";
    bool good = machine::writeFile(file, HEADER, sizeof HEADER - 1) == sizeof HEADER - 1;
    for (int y = 0; good && y < HEIGHT; y += ROWS_AT_ONCE) {
        uint8_t* to = buffer;
        const uint8_t* from = view.frame() + y * WIDTH;
        for (int i = 0; i < ROWS_AT_ONCE * WIDTH; ++i) {
            const uint8_t* colour = palette.dac() + 3 * from[i];
            for (int part = 0; part < 3; ++part)
                *to++ = static_cast<uint8_t>((colour[part] * 255 + 31) / 63);
        }
        good = machine::writeFile(file, buffer, ROWS_AT_ONCE * WIDTH * 3) == ROWS_AT_ONCE * WIDTH * 3;
    }
    good = good && machine::closeFile(file);
    if (!good)
        return complain();

    // The distances, 16.16.
    file = create(number, "Z");
    if (file < 0)
        return complain();
    for (int y = 0; good && y < HEIGHT; y += ROWS_AT_ONCE) {
        uint8_t* to = buffer;
        const uint16_t* from = view.zbuffer() + y * WIDTH;
        for (int i = 0; i < ROWS_AT_ONCE * WIDTH; ++i) {
            const uint32_t z = from[i] == Z_EMPTY ? 0x7fffffffu : static_cast<uint32_t>(from[i]) << 9;
            for (int part = 0; part < 32; part += 8)
                *to++ = static_cast<uint8_t>(z >> part);
        }
        good = machine::writeFile(file, buffer, ROWS_AT_ONCE * WIDTH * 4) == ROWS_AT_ONCE * WIDTH * 4;
    }
    good = good && machine::closeFile(file);
    if (!good)
        return complain();

    // The scene.
    file = create(number, "TXT");
    if (file < 0)
        return complain();
    const auto line = [&](const char* text) {
        good = good && machine::writeFile(file, text, static_cast<uint32_t>(strlen(text))) >= 0 &&
               machine::writeFile(file, "\n", 1) == 1;
    };
    char text[200], a[24], b[24], c[24];
    const auto three = [&](const char* name, Real x, Real y, Real z) {
        formatReal(a, sizeof a, x);
        formatReal(b, sizeof b, y);
        formatReal(c, sizeof c, z);
        snprintf(text, sizeof text, "%s %s %s %s", name, a, b, c);
        line(text);
    };
    const auto two = [&](const char* name, Real x, Real y) {
        formatReal(a, sizeof a, x);
        formatReal(b, sizeof b, y);
        snprintf(text, sizeof text, "%s %s %s", name, a, b);
        line(text);
    };
    // With /N a frame's time is number / rate exactly.
    if (rate > 0)
        formatQuotient(a, sizeof a, static_cast<uint64_t>(number), static_cast<uint32_t>(rate), 1000 % rate == 0 ? 3 : 6);
    else
        formatQuotient(a, sizeof a, time, 65536, 6);
    snprintf(text, sizeof text, "time %s", a);
    line(text);
    const Camera& camera = view.camera();
    three("eye", camera.eye.x, camera.eye.y, camera.eye.z);
    if (camera.axes.turned) {
        const ViewAxes& axes = camera.axes;
        three("right", axes.right.x, axes.right.y, axes.right.z);
        three("up", axes.up.x, axes.up.y, axes.up.z);
        three("ahead", axes.ahead.x, axes.ahead.y, axes.ahead.z);
    }
    two("focal", camera.focalX, camera.focalY);
    two("centre", camera.centreX, camera.centreY);
    three("light", model.light.x, model.light.y, model.light.z);
    formatReal(a, sizeof a, ISOVALUE);
    snprintf(text, sizeof text, "isovalue %s", a);
    line(text);
    for (int i = 0; i < model.count(); ++i) {
        model.actor(i).object->describe(text, sizeof text);
        line(text);
    }
    for (int i = 0; i < model.count(); ++i) {
        for (int which = 0; which < SoftObject::SHAPES; ++which) {
            model.actor(i).object->describeShape(which, text, sizeof text);
            if (text[0] != 0)
                line(text);
        }
    }
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject* object = model.actor(i).object;
        for (const List<Link>::Node* node = object->skel().first(); node != nullptr; node = node->next) {
            if (node->item.object->number() <= object->number())
                continue;
            if (node->item.weight == Real(1)) {
                snprintf(text, sizeof text, "blend %d %d", object->number(), node->item.object->number());
            } else {
                formatReal(a, sizeof a, node->item.weight);
                snprintf(text, sizeof text, "blend %d %d %s", object->number(), node->item.object->number(), a);
            }
            line(text);
        }
    }
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject* object = model.actor(i).object;
        if (object->strength() != Real(1)) {
            formatReal(a, sizeof a, object->strength());
            snprintf(text, sizeof text, "strength %d %s", object->number(), a);
            line(text);
        }
        for (const List<Link>::Node* node = object->dents().first(); node != nullptr; node = node->next) {
            formatReal(a, sizeof a, node->item.weight);
            snprintf(text, sizeof text, "dent %d %d %s", object->number(), node->item.object->number(), a);
            line(text);
        }
    }
    if (!grey) {
        formatQuotient(a, sizeof a, Palette::AMBIENT, 63, 6);
        snprintf(text, sizeof text, "ambient %s", a);
        line(text);
        formatQuotient(a, sizeof a, Palette::HIGHLIGHT, 63, 6);
        snprintf(text, sizeof text, "highlight %s", a);
        line(text);
        for (int i = 0; i < model.count(); ++i) {
            const Colour& colour = model.actor(i).colour;
            snprintf(text, sizeof text, "ramp %d %d %d %d", model.actor(i).object->number(), colour.red, colour.green,
                     colour.blue);
            line(text);
        }
    }
    bool mixed = false;
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject& object = *model.actor(i).object;
        const Paint* const paint = object.paint();
        if (paint == nullptr)
            continue;
        if (paint->mixes && !mixed)
            line("mixed");
        mixed = mixed || paint->mixes;
        if (paint->shines()) {
            snprintf(text, sizeof text, "%s %d", FINISH_WORDS[paint->finish], object.number());
            line(text);
        }
        if (paint->pattern == PATTERN_NONE)
            continue;
        // Where the pattern lies in the world: its size, its middle, and the axes x and y.
        const Colour& colour = model.actor(i).coat.colour;
        int length = snprintf(text, sizeof text, "%s %d", PATTERN_WORDS[paint->pattern], object.number());
        const auto add = [&](Real value) {
            formatReal(a, sizeof a, value);
            length += snprintf(text + length, sizeof text - static_cast<size_t>(length), " %s", a);
        };
        add(paint->grain * (object.size() / paint->made));
        length += snprintf(text + length, sizeof text - static_cast<size_t>(length), " %d %d %d", colour.red, colour.green,
                           colour.blue);
        add(object.centre().x);
        add(object.centre().y);
        add(object.centre().z);
        for (int axis = 0; axis < 2; ++axis)
            for (int part = 0; part < 3; ++part)
                add(object.turn().m[part][axis]);
        line(text);
    }
    good = good && machine::closeFile(file);
    return good ? nullptr : complain();
}
