// Reads the files that the program writes for other programs, films and screenshots, and compares them with dumped pictures.
// It shares no code with the program.
//
//   filmtst frames FILE.FLI              prints the number of frames, 1/70 s per frame, and bytes
//   filmtst same FILE.FLI FROM DIR       the frames must equal DIR/F%07d.PPM, numbered from FROM
//   filmtst frame FILE.FLI N OUT.PPM     writes one frame as a picture
//   filmtst pcx FILE.PCX OUT.PPM         writes a screenshot as a picture
//   filmtst ink FILE.PPM X Y WIDE HIGH   prints how many pixels of a rectangle have the colour of text
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

constexpr int WIDTH = 320;
constexpr int HEIGHT = 200;

[[noreturn]] void die(const std::string& what)
{
    std::printf("filmtst: %s\n", what.c_str());
    std::exit(1);
}

std::string contents(const std::string& name)
{
    std::ifstream file(name, std::ios::binary);
    if (!file)
        die(name + " cannot be read");
    return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

// Reads bytes in order; an attempt to read past the end is reported as an error of the file.
class Bytes {
public:
    Bytes(const std::string& text, size_t from, size_t to) : text_(text), at_(from), end_(to)
    {
        if (to > text.size() || from > to)
            die("a chunk ends behind the file");
    }
    int u8()
    {
        if (at_ >= end_)
            die("a chunk is too short");
        return static_cast<unsigned char>(text_[at_++]);
    }
    int s8() { return static_cast<signed char>(u8()); }
    uint32_t u16()
    {
        const uint32_t low = static_cast<uint32_t>(u8());
        return low | static_cast<uint32_t>(u8()) << 8;
    }
    uint32_t u32()
    {
        const uint32_t low = u16();
        return low | u16() << 16;
    }
    size_t at() const { return at_; }
    size_t left() const { return end_ - at_; }

private:
    const std::string& text_;
    size_t at_, end_;
};

struct Picture {
    std::vector<uint8_t> pixels = std::vector<uint8_t>(WIDTH * HEIGHT);
    uint8_t colours[256][3] = {};

    void set(size_t at, int colour)
    {
        if (at >= pixels.size())
            die("a pixel outside the picture");
        pixels[at] = static_cast<uint8_t>(colour);
    }
    std::string ppm() const
    {
        std::string text = "P6\n320 200\n255\n";
        for (const uint8_t pixel : pixels)
            text.append(reinterpret_cast<const char*>(colours[pixel]), 3);
        return text;
    }
};

class Film {
public:
    explicit Film(const std::string& name) : text_(contents(name))
    {
        Bytes header(text_, 0, 128);
        if (header.u32() != text_.size())
            die("the header tells another size than the file has");
        if (header.u16() != 0xaf11)
            die("no FLI file");
        frames = static_cast<int>(header.u16());
        if (header.u16() != WIDTH || header.u16() != HEIGHT || header.u16() != 8)
            die("not 320x200 pixels of 8 bits");
        header.u16();
        jiffies = static_cast<int>(header.u16());
        at_ = 128;
    }

    // Applies the next frame to the picture.
    void next(Picture& picture)
    {
        Bytes header(text_, at_, at_ + 16);
        const size_t size = header.u32();
        if (header.u16() != 0xf1fa)
            die("no frame where one should be");
        int chunks = static_cast<int>(header.u16());
        size_t at = at_ + 16;
        for (; chunks > 0; --chunks) {
            Bytes head(text_, at, at + 6);
            const size_t length = head.u32();
            const uint32_t kind = head.u16();
            Bytes chunk(text_, at + 6, at + length);
            if (at + length > at_ + size)
                die("a chunk ends behind its frame");
            if (kind == 11)
                colours(chunk, picture);
            else if (kind == 15)
                whole(chunk, picture);
            else if (kind == 12)
                changes(chunk, picture);
            else
                die("an unknown chunk");
            if (chunk.left() > 1)
                die("a chunk that is longer than what is in it");
            at += length;
        }
        if (at != at_ + size)
            die("a frame that is longer than its chunks");
        at_ = at;
    }
    bool over() const { return at_ == text_.size(); }
    size_t bytes() const { return text_.size(); }

    int frames, jiffies;

private:
    static void colours(Bytes& chunk, Picture& picture)
    {
        int at = 0;
        for (uint32_t packets = chunk.u16(); packets > 0; --packets) {
            at += chunk.u8();
            int count = chunk.u8();
            count = count == 0 ? 256 : count;
            for (; count > 0; --count, ++at)
                for (int part = 0; part < 3; ++part)
                    picture.colours[at][part] = static_cast<uint8_t>((chunk.u8() * 255 + 31) / 63);
        }
    }
    static void whole(Bytes& chunk, Picture& picture)
    {
        for (size_t y = 0; y < HEIGHT; ++y) {
            chunk.u8();
            size_t x = 0;
            while (x < WIDTH) {
                int count = chunk.s8();
                if (count < 0)
                    for (; count < 0; ++count)
                        picture.set(y * WIDTH + x++, chunk.u8());
                else if (const int colour = chunk.u8(); count > 0)
                    for (; count > 0; --count)
                        picture.set(y * WIDTH + x++, colour);
            }
            if (x != WIDTH)
                die("a row that does not end at the edge");
        }
    }
    static void changes(Bytes& chunk, Picture& picture)
    {
        size_t y = chunk.u16();
        for (uint32_t rows = chunk.u16(); rows > 0; --rows, ++y) {
            size_t x = 0;
            for (int packets = chunk.u8(); packets > 0; --packets) {
                x += static_cast<size_t>(chunk.u8());
                int count = chunk.s8();
                if (count >= 0)
                    for (; count > 0; --count)
                        picture.set(y * WIDTH + x++, chunk.u8());
                else
                    for (const int colour = chunk.u8(); count < 0; ++count)
                        picture.set(y * WIDTH + x++, colour);
                if (x > WIDTH)
                    die("a row that goes beyond the edge");
            }
        }
    }

    const std::string text_;
    size_t at_;
};

void readPcx(const std::string& name, Picture& picture)
{
    const std::string text = contents(name);
    Bytes header(text, 0, 128);
    const int mark = header.u8(), version = header.u8(), packed = header.u8(), bits = header.u8();
    const uint32_t left = header.u16(), top = header.u16(), right = header.u16(), bottom = header.u16();
    if (mark != 10 || version != 5 || packed != 1 || bits != 8 || left != 0 || top != 0 || right != WIDTH - 1 ||
        bottom != HEIGHT - 1 || text[65] != 1)
        die("the header of another kind of picture");
    if (text.size() < 128 + 769 || text[text.size() - 769] != 12)
        die("no palette");
    Bytes runs(text, 128, text.size() - 769);
    for (size_t at = 0; at < picture.pixels.size();) {
        int count = 1, colour = runs.u8();
        if (colour >= 0xc0) {
            count = colour & 0x3f;
            colour = runs.u8();
        }
        for (; count > 0; --count)
            picture.set(at++, colour);
    }
    if (runs.left() != 0)
        die("more pixels than the picture has");
    memcpy(picture.colours, text.data() + text.size() - 768, 768);
}

void write(const std::string& name, const std::string& text)
{
    std::ofstream file(name, std::ios::binary);
    file << text;
    if (!file.flush())
        die(name + " cannot be written");
}

}  // namespace

int main(int count, char** arguments)
{
    const std::string what = count > 1 ? arguments[1] : "";
    Picture picture;
    if (what == "pcx" && count == 4) {
        readPcx(arguments[2], picture);
        write(arguments[3], picture.ppm());
        return 0;
    }
    if (what == "ink" && count == 7) {
        const std::string text = contents(arguments[2]);
        const size_t start = text.size() - WIDTH * HEIGHT * 3;
        const int x = std::atoi(arguments[3]), y = std::atoi(arguments[4]);
        const int wide = std::atoi(arguments[5]), high = std::atoi(arguments[6]);
        int ink = 0;
        for (int row = y; row < y + high; ++row)
            for (int column = x; column < x + wide; ++column)
                ink += text.compare(start + static_cast<size_t>(row * WIDTH + column) * 3, 3, "\xff\xff\xe3") == 0;
        std::printf("%d\n", ink);
        return 0;
    }
    if (count < 3)
        die("what is to be done?");
    Film film(arguments[2]);
    if (what == "frame" && count == 5) {
        for (int i = 0; i <= std::atoi(arguments[3]); ++i)
            film.next(picture);
        write(arguments[4], picture.ppm());
        return 0;
    }
    for (int i = 0; i < film.frames; ++i) {
        film.next(picture);
        if (what != "same" || count != 5)
            continue;
        char name[20];
        std::snprintf(name, sizeof name, "/F%07d.PPM", std::atoi(arguments[3]) + i);
        if (contents(arguments[4] + std::string(name)) != picture.ppm())
            die("another picture than " + std::string(name));
    }
    // The film has one more frame, which leads back to the first.
    if (film.frames > 0) {
        Film again(arguments[2]);
        Picture first;
        again.next(first);
        film.next(picture);
        if (first.ppm() != picture.ppm())
            die("the frame behind the last is not the first");
    }
    if (!film.over())
        die("more in the file than its frames");
    std::printf("%d frames of %d/70 s, %zu bytes\n", film.frames, film.jiffies, film.bytes());
    return 0;
}
