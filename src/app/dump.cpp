// Writes frames to files: the picture as PPM, the depths as numbers of 32 bits, the scene as text.
#include "app/dump.h"

#include "rt.h"
#include "math/text.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr int ROWS_AT_ONCE = 10;

// The search for files of an older dump ends when this many frames in a row are missing.
constexpr int GAP_MOST = 32;
constexpr int NUMBER_MOST = 9999999;

uint8_t rows[ROWS_AT_ONCE * WIDTH * 4];

// Writes `size` bytes for each pixel of the screen, a few rows at a time; put(index, to) stores the bytes of one pixel.
template <class Put>
bool writeRows(int file, int size, Put put)
{
    const int32_t bytes = ROWS_AT_ONCE * WIDTH * size;
    for (int start = 0; start < WIDTH * HEIGHT; start += ROWS_AT_ONCE * WIDTH) {
        for (int i = 0; i < ROWS_AT_ONCE * WIDTH; ++i)
            put(start + i, rows + i * size);
        if (machine::writeFile(file, rows, static_cast<uint32_t>(bytes)) != bytes)
            return false;
    }
    return true;
}

// Writes the text of a scene line by line: words are collected until end() writes them as one line.
class Lines {
public:
    explicit Lines(int file) : file_(file) {}

    // Begins a line with its first word; the other functions append to the line.
    Lines& begin(const char* word)
    {
        length_ = snprintf(text_, sizeof text_, "%s", word);
        return *this;
    }
    Lines& whole(int value)
    {
        length_ += snprintf(text_ + length_, sizeof text_ - static_cast<size_t>(length_), " %d", value);
        return *this;
    }
    Lines& real(Real value)
    {
        char number[24];
        formatReal(number, sizeof number, value);
        return word(number);
    }
    Lines& quotient(uint64_t top, uint32_t bottom, int decimals)
    {
        char number[24];
        formatQuotient(number, sizeof number, top, bottom, decimals);
        return word(number);
    }
    Lines& vector(const Vector& v) { return real(v.x).real(v.y).real(v.z); }
    Lines& colour(const Colour& c) { return whole(c.red).whole(c.green).whole(c.blue); }
    void end() { line(text_); }

    // Writes a complete line.
    void line(const char* text)
    {
        good_ = good_ && machine::writeFile(file_, text, static_cast<uint32_t>(strlen(text))) >= 0 &&
                machine::writeFile(file_, "\n", 1) == 1;
    }
    bool good() const { return good_; }

private:
    Lines& word(const char* text)
    {
        length_ += snprintf(text_ + length_, sizeof text_ - static_cast<size_t>(length_), " %s", text);
        return *this;
    }

    int file_;
    bool good_ = true;
    int length_ = 0;
    char text_[200];
};

// Writes the eye, the view axes where they differ from those of the world, the projection, the light and the isovalue.
void viewLines(Lines& lines, const Camera& camera, const Vector& light)
{
    lines.begin("eye").vector(toVector(camera.eye)).end();
    if (camera.axes.turned) {
        lines.begin("right").vector(camera.axes.right).end();
        lines.begin("up").vector(camera.axes.up).end();
        lines.begin("ahead").vector(camera.axes.ahead).end();
    }
    lines.begin("focal").real(camera.focalX).real(camera.focalY).end();
    lines.begin("centre").real(camera.centreX).real(camera.centreY).end();
    lines.begin("light").vector(light).end();
    lines.begin("isovalue").real(ISOVALUE).end();
}

// Writes the objects, then their shapes.
void objectLines(Lines& lines, const Model& model)
{
    char text[200];
    for (int i = 0; i < model.count(); ++i) {
        model.actor(i).object->describe(text, sizeof text);
        lines.line(text);
    }
    for (int i = 0; i < model.count(); ++i) {
        for (int which = 0; which < SoftObject::SHAPES; ++which) {
            model.actor(i).object->describeShape(which, text, sizeof text);
            if (text[0] != 0)
                lines.line(text);
        }
    }
}

// Writes the links, each pair once, then strengths and dents.
void blendLines(Lines& lines, const Model& model)
{
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject* object = model.actor(i).object;
        for (const List<Link>::Node* node = object->skel().first(); node != nullptr; node = node->next) {
            if (node->item.object->number() <= object->number())
                continue;
            lines.begin("blend").whole(object->number()).whole(node->item.object->number());
            if (node->item.weight != Real(1))
                lines.real(node->item.weight);
            lines.end();
        }
    }
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject* object = model.actor(i).object;
        if (object->strength() != Real(1))
            lines.begin("strength").whole(object->number()).real(object->strength()).end();
        for (const List<Link>::Node* node = object->dents().first(); node != nullptr; node = node->next)
            lines.begin("dent").whole(object->number()).whole(node->item.object->number()).real(node->item.weight).end();
    }
}

// Writes the lowest brightness of a ramp, the brightness at which white begins to mix in, and the colours of the objects.
void rampLines(Lines& lines, const Model& model)
{
    lines.begin("ambient").quotient(Palette::AMBIENT, 63, 6).end();
    lines.begin("highlight").quotient(Palette::HIGHLIGHT, 63, 6).end();
    for (int i = 0; i < model.count(); ++i)
        lines.begin("ramp").whole(model.actor(i).object->number()).colour(model.actor(i).colour).end();
}

// Writes how a pattern lies in the world: its grain, its second colour, the object's centre, and the object's x and y axes.
void patternLine(Lines& lines, const SoftObject& object, const Paint& paint, const Colour& other)
{
    lines.begin(PATTERN_WORDS[paint.pattern]).whole(object.number()).real(paint.grain * (object.size() / paint.made));
    lines.colour(other).vector(toVector(object.centre()));
    for (int axis = 0; axis < 2; ++axis)
        for (int part = 0; part < 3; ++part)
            lines.real(object.turn().m[part][axis]);
    lines.end();
}

void paintLines(Lines& lines, const Model& model)
{
    bool mixed = false;
    for (int i = 0; i < model.count(); ++i) {
        const SoftObject& object = *model.actor(i).object;
        const Paint* const paint = object.paint();
        if (paint == nullptr)
            continue;
        if (paint->mixes && !mixed)
            lines.line("mixed");
        mixed = mixed || paint->mixes;
        if (paint->shines())
            lines.begin(FINISH_WORDS[paint->finish]).whole(object.number()).end();
        if (paint->pattern != PATTERN_NONE)
            patternLine(lines, object, *paint, model.actor(i).coat.colour);
    }
}

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
    // Frames of an older dump would be mixed with the new ones. This removes the empty test file, too.
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
    const bool good = picture(number, view, palette) && distances(number, view) &&
                      scene(number, time, rate, model, view.camera(), grey);
    return good ? nullptr : complain();
}

// Writes the picture with the colours of the palette, scaled from 0..63 to 0..255.
bool Dump::picture(int number, const View& view, const Palette& palette)
{
    const int file = create(number, "PPM");
    if (file < 0)
        return false;
    char header[24];
    const int length = snprintf(header, sizeof header, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    return machine::writeFile(file, header, static_cast<uint32_t>(length)) == length &&
           writeRows(file, 3, [&](int pixel, uint8_t* to) {
               const uint8_t* colour = palette.dac() + 3 * view.frame()[pixel];
               for (int part = 0; part < 3; ++part)
                   to[part] = static_cast<uint8_t>((colour[part] * 255 + 31) / 63);
           }) &&
           machine::closeFile(file);
}

// Writes the depths as 16.16, little-endian; 0x7fffffff where nothing was drawn.
bool Dump::distances(int number, const View& view)
{
    const int file = create(number, "Z");
    return file >= 0 && writeRows(file, 4, [&](int pixel, uint8_t* to) {
               const uint16_t depth = view.zbuffer()[pixel];
               const uint32_t z = depth == Z_EMPTY ? 0x7fffffffu : static_cast<uint32_t>(depth) << 9;
               for (int part = 0; part < 32; part += 8)
                   *to++ = static_cast<uint8_t>(z >> part);
           }) &&
           machine::closeFile(file);
}

bool Dump::scene(int number, Time time, int rate, const Model& model, const Camera& camera, bool grey)
{
    const int file = create(number, "TXT");
    if (file < 0)
        return false;
    Lines lines(file);
    // With /N the time of a frame is exactly number / rate.
    if (rate > 0)
        lines.begin("time").quotient(static_cast<uint64_t>(number), static_cast<uint32_t>(rate), 1000 % rate == 0 ? 3 : 6).end();
    else
        lines.begin("time").quotient(time, 65536, 6).end();
    viewLines(lines, camera, model.light);
    objectLines(lines, model);
    blendLines(lines, model);
    if (!grey)
        rampLines(lines, model);
    paintLines(lines, model);
    return lines.good() && machine::closeFile(file);
}
