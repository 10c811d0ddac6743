// Numbers as text and text as numbers (text.h).
#include "math/text.h"

#include "rt.h"

namespace {

const uint32_t POWERS[] = {1, 10, 100, 1000, 10000, 100000, 1000000};

// Writes the digits of `whole`, then `decimals` digits of `part`, to `to`; digits that do not fit are cut off.
int putDigits(char* to, int size, bool minus, uint64_t whole, uint32_t part, int decimals)
{
    char digits[32];
    int count = 0;
    for (int i = 0; i < decimals; ++i) {
        digits[count++] = static_cast<char>('0' + part % 10);
        part /= 10;
    }
    if (decimals > 0)
        digits[count++] = '.';
    do {
        uint32_t digit;
        whole = divide64(whole, 10, &digit);
        digits[count++] = static_cast<char>('0' + digit);
    } while (whole != 0);
    if (minus)
        digits[count++] = '-';
    int length = 0;
    while (count > 0 && length + 1 < size)
        to[length++] = digits[--count];
    to[length] = 0;
    return length;
}

}  // namespace

int formatReal(char* to, int size, Real value)
{
    const int32_t raw = rawFromReal(value);
    const uint32_t bits = raw < 0 ? 0u - static_cast<uint32_t>(raw) : static_cast<uint32_t>(raw);
    // Find the fewest decimals that parseReal() reads back as the same value; six are enough for every value.
    int decimals = 0;
    uint32_t whole = 0, part = 0;
    for (; decimals <= 6; ++decimals) {
        const uint32_t power = POWERS[decimals];
        const uint64_t scaled = (static_cast<uint64_t>(bits) * power + 0x8000) >> 16;
        whole = static_cast<uint32_t>(divide64(scaled, power, &part));
        const uint32_t fraction = static_cast<uint32_t>(divide64((static_cast<uint64_t>(part) << 16) + power / 2, power));
        if ((whole << 16) + fraction == bits)
            break;
    }
    return putDigits(to, size, raw < 0, whole, part, decimals);
}

int formatQuotient(char* to, int size, uint64_t top, uint32_t bottom, int decimals)
{
    if (bottom == 0) {
        top = 0;
        bottom = 1;
    }
    uint32_t rest;
    uint64_t whole = divide64(top, bottom, &rest);
    uint32_t part = static_cast<uint32_t>(divide64(static_cast<uint64_t>(rest) * POWERS[decimals] + bottom / 2, bottom));
    if (part == POWERS[decimals]) {
        part = 0;
        ++whole;
    }
    return putDigits(to, size, false, whole, part, decimals);
}

bool parseReal(const char* text, Real* value)
{
    const bool minus = *text == '-';
    if (*text == '-' || *text == '+')
        ++text;
    uint32_t whole = 0, part = 0;
    int digits = 0, decimals = 0;
    for (; *text >= '0' && *text <= '9'; ++text, ++digits) {
        whole = whole * 10 + static_cast<uint32_t>(*text - '0');
        if (whole > 32767)
            return false;
    }
    if (*text == '.') {
        for (++text; *text >= '0' && *text <= '9'; ++text, ++digits) {
            if (decimals < 6) {
                part = part * 10 + static_cast<uint32_t>(*text - '0');
                ++decimals;
            }
        }
    }
    if (digits == 0 || *text != 0)
        return false;
    const uint32_t fraction =
        static_cast<uint32_t>(divide64((static_cast<uint64_t>(part) << 16) + POWERS[decimals] / 2, POWERS[decimals]));
    const uint32_t bits = (whole << 16) + fraction;
    if (bits > INT32_MAX)
        return false;
    *value = realFromRaw(minus ? -static_cast<int32_t>(bits) : static_cast<int32_t>(bits));
    return true;
}

bool parseWhole(const char* text, int32_t* value)
{
    if (*text == 0)
        return false;
    uint32_t whole = 0;
    for (; *text >= '0' && *text <= '9'; ++text) {
        if (whole > INT32_MAX / 10)
            return false;
        whole = whole * 10 + static_cast<uint32_t>(*text - '0');
        if (whole > INT32_MAX)
            return false;
    }
    if (*text != 0)
        return false;
    *value = static_cast<int32_t>(whole);
    return true;
}

namespace {

// Writes one byte of a text as any screen can show it, without a final 0. Returns the length, 1 or 4.
int plainByte(char* to, char c)
{
    static const char DIGITS[] = "0123456789ABCDEF";
    if (c >= ' ' && c <= '~') {
        to[0] = c;
        return 1;
    }
    const unsigned byte = static_cast<unsigned char>(c);
    to[0] = '\\';
    to[1] = 'x';
    to[2] = DIGITS[byte >> 4];
    to[3] = DIGITS[byte & 15];
    return 4;
}

}  // namespace

char* plainText(char* to, int size, const char* text)
{
    char byte[4];
    int whole = 0, count = 0;
    for (; text[count] != 0; ++count)
        whole += plainByte(byte, text[count]);
    // If there is no room for the whole text: a third of the room is for its beginning, the rest for its end, where a file's
    // own name is.
    const bool cut = whole >= size;
    const int front = cut ? size / 3 : whole, back = cut ? size - 1 - 3 - front : 0;
    int length = 0, at = 0;
    for (; at < count; ++at) {
        const int more = plainByte(byte, text[at]);
        if (length + more > front)
            break;
        memcpy(to + length, byte, static_cast<size_t>(more));
        length += more;
    }
    if (cut) {
        memcpy(to + length, "...", 3);
        length += 3;
        int from = count, room = back;
        while (from > at && (room -= plainByte(byte, text[from - 1])) >= 0)
            --from;
        for (; from < count; ++from)
            length += plainByte(to + length, text[from]);
    }
    to[length] = 0;
    return to;
}
