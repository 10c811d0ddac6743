// Tests of converting numbers to text and back.
#include "math/text.h"

#include <cstring>
#include <string>

#include "help.h"
#include "test.h"

namespace {

std::string text(Real value)
{
    char to[24];
    const int length = formatReal(to, sizeof to, value);
    SAME(length, std::strlen(to));
    return to;
}

bool reads(const char* from, double expected)
{
    Real value(77);
    return parseReal(from, &value) && std::fabs(number(value) - expected) <= 0.5 / 65536 + 1e-6;
}

bool refuses(const char* from)
{
    Real value(77);
    return !parseReal(from, &value) && value == Real(77);
}

std::string quotient(uint64_t top, uint32_t bottom, int decimals)
{
    char to[40];
    const int length = formatQuotient(to, sizeof to, top, bottom, decimals);
    SAME(length, std::strlen(to));
    return to;
}

}  // namespace

TEST(reals_as_text)
{
    TEXT(text(Real(0)), "0");
    TEXT(text(Real(-4)), "-4");
    TEXT(text(Real(3.25)), "3.25");
    TEXT(text(Real(-0.5)), "-0.5");
    TEXT(text(realFromRaw(1)), "0.00002");
    TEXT(text(realFromRaw(-1)), "-0.00002");
    TEXT(text(realFromRaw(65535)), "0.99998");
#if FB_REAL == FB_FIXED
    TEXT(text(realFromRaw(INT32_MAX)), "32767.99998");
    TEXT(text(realFromRaw(INT32_MIN)), "-32768");
#endif
    // A text that does not fit is cut off and never written past the end.
    char small[6];
    std::memset(small, 'x', sizeof small);
    formatReal(small, 4, Real(-123.5));
    TEXT(std::string(small, 4), std::string("-12\0", 4));
    SAME(small[4], 'x');
}

TEST(reals_read_back)
{
    // "It reads back as the same 16.16 value": tests every fraction, and other numbers.
    long wrong = 0;
    for (int32_t raw = 0; raw < 65536; ++raw) {
        Real value;
        wrong += !parseReal(text(realFromRaw(raw)).c_str(), &value) || rawFromReal(value) != raw;
    }
    SAME(wrong, 0);
    Random random;
    for (int i = 0; i < 20000; ++i) {
        // A float has 24 bits.
        const int32_t raw = FB_REAL == FB_FLOAT ? static_cast<int32_t>(random.bits()) >> 8 : static_cast<int32_t>(random.bits());
        if (raw == INT32_MIN)
            continue;
        Real value;
        CHECK(parseReal(text(realFromRaw(raw)).c_str(), &value));
        SAME(rawFromReal(value), raw);
    }
}

TEST(reals_read)
{
    CHECK(reads("3", 3));
    CHECK(reads("-1.5", -1.5));
    CHECK(reads("+1.5", 1.5));
    CHECK(reads(".25", 0.25));
    CHECK(reads("2.", 2));
    CHECK(reads("0007", 7));
    CHECK(reads("-0", 0));
    CHECK(reads("208.333333", 208.333333));
    CHECK(reads("1.1234567890123456789", 1.123456));  // digits beyond the sixth decimal are dropped
    CHECK(reads("32767.5", 32767.5));
    CHECK(reads("-32767.5", -32767.5));
}

TEST(bad_reals_refused)
{
    for (const char* bad : {"", "-", "+", ".", "-.", "a", "1a", "1 ", " 1", "1..2", "1.2.3", "--1", "1e3", "0x10", "1,5", "nan",
                            "32768", "-32768", "99999999999999999999", "40000.5"})
        if (!CHECK(refuses(bad)))
            note("accepted: \"%s\"", bad);
}

TEST(whole_numbers)
{
    int32_t value = 0;
    CHECK(parseWhole("0", &value) && value == 0);
    CHECK(parseWhole("600", &value) && value == 600);
    CHECK(parseWhole("0012", &value) && value == 12);
    CHECK(parseWhole("2147483647", &value) && value == 2147483647);
    value = 5;
    for (const char* bad : {"", "-1", "+1", "1.0", "1 ", " 1", "x", "1x", "2147483648", "4294967297", "99999999999999"})
        if (!CHECK(!parseWhole(bad, &value) && value == 5))
            note("accepted: \"%s\"", bad);
}

TEST(quotients)
{
    TEXT(quotient(785, 60, 3), "13.083");
    TEXT(quotient(1, 3, 0), "0");
    TEXT(quotient(2, 3, 0), "1");
    TEXT(quotient(2, 3, 6), "0.666667");
    TEXT(quotient(999999, 1000000, 3), "1.000");
    TEXT(quotient(5, 0, 3), "0.000");
    TEXT(quotient(0, 7, 1), "0.0");
    TEXT(quotient(1ull << 40, 1, 0), "1099511627776");
    TEXT(quotient(~0ull, 1, 2), "18446744073709551615.00");
    Random random;
    for (int i = 0; i < 5000; ++i) {
        const uint64_t top = random.bits();
        const uint32_t bottom = (random.bits() >> random.below(31)) | 1;
        const double truth = static_cast<double>(top) / bottom;
        NEAR(std::strtod(quotient(top, bottom, 3).c_str(), nullptr), truth, 0.00051 + truth * 1e-12);
    }
}

TEST(plain_text)
{
    char to[64];
    TEXT(plainText(to, sizeof to, "WALK.FB"), "WALK.FB");
    TEXT(plainText(to, sizeof to, ""), "");
    TEXT(plainText(to, sizeof to, "a\nb\x7f\x80 ~"), "a\\x0Ab\\x7F\\x80 ~");
    // A text may fill the room to its last byte. A text one byte longer is shortened to its first third, three points, and its end.
    char small[17];
    TEXT(plainText(small, sizeof small, "0123456789abcdef"), "0123456789abcdef");
    TEXT(plainText(small, sizeof small, "0123456789abcdefg"), "01234...9abcdefg");
    // An escape sequence is never cut in two.
    TEXT(plainText(small, sizeof small, "0123\x01" "56789abcde\x02"), "0123...bcde\\x02");
    for (int size = 16; size < 64; ++size) {
        std::string text;
        for (int i = 0; i < 100; ++i)
            text += static_cast<char>(1 + (i * 37 + size) % 255);
        plainText(to, size, text.c_str());
        CHECK(std::strlen(to) < static_cast<size_t>(size) && std::strlen(to) + 9 > static_cast<size_t>(size));
        for (const char* c = to; *c != 0; ++c)
            CHECK(*c >= ' ' && *c <= '~');
    }
}
