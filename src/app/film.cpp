// The chunks of an FLI file: the first picture is stored row by row, the others as changes. All numbers are little-endian.
#include "app/film.h"

#include "machine.h"
#include "math/alloc.h"
#include "math/text.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr uint32_t HEADER_BYTES = 128;
constexpr uint32_t FRAME_HEADER_BYTES = 16;
constexpr uint32_t CHUNK_HEADER_BYTES = 6;
constexpr int FILE_MARK = 0xaf11;
constexpr int FRAME_MARK = 0xf1fa;
constexpr int COLOURS = 11;  // kinds of chunks: the palette, changes of rows, a whole picture
constexpr int CHANGES = 12;
constexpr int WHOLE = 15;

// The most pixels in a packet, the most pixels that a packet can skip, and the shortest run of equal pixels that is worth a
// packet of its own. A run of unchanged pixels is skipped, too, when it is as long as RUN_LEAST.
constexpr int PACKET_MOST = 127;
constexpr int SKIP_MOST = 255;
constexpr int RUN_LEAST = 4;

// Upper bound of the size of a frame in bytes: one byte per pixel, a packet for each RUN_LEAST pixels, and the colours.
constexpr uint32_t ROOM = static_cast<uint32_t>(WIDTH * HEIGHT) * 2 + 2048;

// Upper bound of a file's length before a frame is added: DOS counts bytes with signed 32-bit numbers.
constexpr uint32_t FILE_MOST = 0x7fffffffu - ROOM;

// Returns the length of the run of equal pixels that begins at column `x`, at most up to `end` (exclusive).
int runLength(const uint8_t* row, int x, int end)
{
    int length = 1;
    while (x + length < end && length < PACKET_MOST && row[x + length] == row[x])
        ++length;
    return length;
}

// Returns how many pixels from column `x` on are best stored one by one: those before the next run worth a packet.
int plainLength(const uint8_t* row, int x, int end)
{
    int length = 0;
    while (x + length < end && length < PACKET_MOST && runLength(row, x + length, end) < RUN_LEAST)
        ++length;
    return length;
}

}  // namespace

Film::~Film()
{
    free(before_);
    free(first_);
    free(room_);
}

const char* Film::complain(const char* why)
{
    char plain[100];
    snprintf(problem_, sizeof problem_, "%s: %s", plainText(plain, sizeof plain, name_), why);
    return problem_;
}

void Film::put16(uint32_t value)
{
    put8(static_cast<int>(value & 0xff));
    put8(static_cast<int>(value >> 8 & 0xff));
}

void Film::put32(uint32_t value)
{
    put16(value & 0xffff);
    put16(value >> 16);
}

bool Film::write(const uint8_t* from, uint32_t bytes)
{
    failed_ = failed_ || machine::writeFile(file_, from, bytes) != static_cast<int32_t>(bytes);
    if (failed_)
        return false;
    bytes_ += bytes;
    return true;
}

// Whether there is a file of this name that is no film.
static bool isOther(const char* name)
{
    uint8_t start[6] = {};
    const int file = machine::openFile(name);
    if (file < 0)
        return false;
    const bool some = machine::fileBytes(file) > 0 && machine::readFile(file, start, sizeof start) >= 0;
    machine::closeFile(file);
    return some && (start[4] | start[5] << 8) != FILE_MARK;
}

const char* Film::open(const char* name, int rate, int* status)
{
    name_ = name;
    before_ = allocate<uint8_t>(WIDTH * HEIGHT);
    first_ = allocate<uint8_t>(WIDTH * HEIGHT);
    room_ = allocate<uint8_t>(ROOM);
    if (before_ == nullptr || first_ == nullptr || room_ == nullptr)
        return "not enough memory for the film";
    realTime_ = rate == 0;
    jiffies_ = realTime_ ? REAL_TIME_JIFFIES : (JIFFIES + rate / 2) / rate;
    if (jiffies_ == 0)
        jiffies_ = 1;
    if (isOther(name)) {
        *status = 2;
        return complain("this is no film; /A replaces only films");
    }
    file_ = machine::createFile(name);
    // close() writes the header again, with the final number of frames and bytes.
    return file_ >= 0 && writeHeader() ? nullptr : complain(machine::fileTrouble());
}

bool Film::writeHeader()
{
    memset(room_, 0, HEADER_BYTES);
    at_ = room_;
    put32(bytes_);
    put16(FILE_MARK);
    put16(static_cast<uint32_t>(frames_));
    put16(WIDTH);
    put16(HEIGHT);
    put16(8);  // bits per pixel
    put16(0);
    put16(static_cast<uint32_t>(jiffies_));
    return write(room_, HEADER_BYTES);
}

// Stores a row of the first picture. A packet with a count above 0 repeats one pixel; a count below 0 is followed by that
// many single pixels.
void Film::putRow(const uint8_t* row)
{
    uint8_t* const packets = at_;
    put8(0);
    for (int x = 0; x < WIDTH;) {
        const int plain = plainLength(row, x, WIDTH);
        const int length = plain > 0 ? plain : runLength(row, x, WIDTH);
        put8(plain > 0 ? -plain : length);
        memcpy(at_, row + x, static_cast<size_t>(plain > 0 ? plain : 1));
        at_ += plain > 0 ? plain : 1;
        x += length;
        ++*packets;
    }
}

// Stores the changes of a row against the same row `before` of the last picture. The signs of the counts are the opposite
// of those in putRow(). Returns the number of packets.
int Film::putChanges(const uint8_t* row, const uint8_t* before)
{
    uint8_t* const packets = at_;
    put8(0);
    int done = 0;  // columns that the packets so far have passed
    for (int x = 0; x < WIDTH;) {
        if (row[x] == before[x]) {
            ++x;
            continue;
        }
        // The changed stretch ends (exclusive) before RUN_LEAST unchanged pixels, which are worth skipping.
        int end = x + 1;
        for (int i = end; i < WIDTH && i - end < RUN_LEAST; ++i)
            if (row[i] != before[i])
                end = i + 1;
        int skip = x - done;
        if (skip > SKIP_MOST) {
            // A packet must not be empty: it stores one unchanged pixel.
            put8(SKIP_MOST);
            put8(1);
            put8(row[done + SKIP_MOST]);
            skip -= SKIP_MOST + 1;
            ++*packets;
        }
        while (x < end) {
            const int plain = plainLength(row, x, end);
            const int length = plain > 0 ? plain : runLength(row, x, end);
            put8(skip);
            put8(plain > 0 ? plain : -length);
            memcpy(at_, row + x, static_cast<size_t>(plain > 0 ? plain : 1));
            at_ += plain > 0 ? plain : 1;
            x += length;
            skip = 0;
            ++*packets;
        }
        done = x;
    }
    return *packets;
}

// Begins a chunk, with room for its size and kind, and returns its start.
uint8_t* Film::beginChunk()
{
    uint8_t* const start = at_;
    at_ += CHUNK_HEADER_BYTES;
    return start;
}

// Ends a chunk that begins at `start`: pads it to an even length, and fills in its size and kind.
void Film::endChunk(uint8_t* start, int kind)
{
    if ((at_ - start) % 2 != 0)
        put8(0);
    uint8_t* const end = at_;
    at_ = start;
    put32(static_cast<uint32_t>(end - start));
    put16(static_cast<uint32_t>(kind));
    at_ = end;
}

// Stores all 256 colours, unless they are those stored last. Returns the number of chunks.
int Film::putColours(const uint8_t* dac)
{
    if (frames_ > 0 && memcmp(dac, dac_, sizeof dac_) == 0)
        return 0;
    uint8_t* const start = beginChunk();
    put16(1);  // one packet,
    put8(0);   // from the first colour on,
    put8(0);   // of all 256
    memcpy(at_, dac, sizeof dac_);
    at_ += sizeof dac_;
    memcpy(dac_, dac, sizeof dac_);
    endChunk(start, COLOURS);
    return 1;
}

// Stores the first picture. Returns the number of chunks.
int Film::putWhole(const uint8_t* picture)
{
    uint8_t* const start = beginChunk();
    for (int y = 0; y < HEIGHT; ++y)
        putRow(picture + y * WIDTH);
    endChunk(start, WHOLE);
    return 1;
}

// Stores the changes of a picture against the last one, if there are any. Returns the number of chunks.
int Film::putDifference(const uint8_t* picture)
{
    int top = 0, bottom = HEIGHT;
    while (top < HEIGHT && memcmp(picture + top * WIDTH, before_ + top * WIDTH, WIDTH) == 0)
        ++top;
    while (bottom > top && memcmp(picture + (bottom - 1) * WIDTH, before_ + (bottom - 1) * WIDTH, WIDTH) == 0)
        --bottom;
    if (top == bottom)
        return 0;
    uint8_t* const start = beginChunk();
    put16(static_cast<uint32_t>(top));
    put16(static_cast<uint32_t>(bottom - top));
    for (int y = top; y < bottom; ++y)
        putChanges(picture + y * WIDTH, before_ + y * WIDTH);
    endChunk(start, CHANGES);
    return 1;
}

bool Film::writeFrame(const uint8_t* picture, const uint8_t* dac)
{
    const bool first = frames_ == 0;
    at_ = room_ + FRAME_HEADER_BYTES;
    int chunks = putColours(dac);
    chunks += first ? putWhole(picture) : putDifference(picture);
    if (first) {
        memcpy(first_, picture, WIDTH * HEIGHT);
        memcpy(firstDac_, dac, sizeof firstDac_);
    }
    if (picture != before_)
        memcpy(before_, picture, WIDTH * HEIGHT);

    uint8_t* const end = at_;
    memset(room_, 0, FRAME_HEADER_BYTES);
    at_ = room_;
    put32(static_cast<uint32_t>(end - room_));
    put16(FRAME_MARK);
    put16(static_cast<uint32_t>(chunks));
    if (!write(room_, static_cast<uint32_t>(end - room_)))
        return false;
    ++frames_;
    return true;
}

// Writes a frame that shows the same picture as the frame before.
bool Film::writeSame()
{
    return writeFrame(before_, dac_);
}

const char* Film::add(const uint8_t* picture, const uint8_t* dac, Time now)
{
    // The number of film frames that begin up to `now`.
    uint32_t due = static_cast<uint32_t>(frames_) + 1;
    if (realTime_) {
        due = static_cast<uint32_t>(divide64(now * JIFFIES, static_cast<uint32_t>(jiffies_) << 16)) + 1;
    }
    if (due > static_cast<uint32_t>(FRAMES_MOST) || bytes_ > FILE_MOST)
        return complain("the film is full");
    bool good = true;
    while (good && frames_ > 0 && static_cast<uint32_t>(frames_) + 1 < due)
        good = writeSame();
    if (good && static_cast<uint32_t>(frames_) < due)
        good = writeFrame(picture, dac);
    return good ? nullptr : complain(machine::fileTrouble());
}

const char* Film::close()
{
    if (file_ < 0)
        return nullptr;
    // The last frame is followed by the changes back to the first one, for players that loop. This frame is not counted.
    const int frames = frames_;
    bool good = frames == 0 || writeFrame(first_, firstDac_);
    frames_ = frames;
    const uint32_t bytes = bytes_;
    // A film whose last frame did not fit is still a film of the others.
    failed_ = false;
    good = (good || machine::cutFile(file_, bytes)) && machine::rewindFile(file_) && writeHeader() && good;
    bytes_ = bytes;
    good = machine::closeFile(file_) && good;
    file_ = -1;
    return good ? nullptr : complain(machine::fileTrouble());
}
