// What a unit test is written with. A test is a function; it fails when one of its checks does, and says which.
//
//     TEST(lists_keep_order) { List<int> l; CHECK(l.append(3)); ... }
#ifndef FB_TEST_H
#define FB_TEST_H

#include <cstdint>
#include <cstdio>
#include <string>

namespace fbtest {

struct Test {
    Test(const char* file, const char* name, void (*run)());
    const char* file;
    const char* name;
    void (*run)();
    Test* next;
};

// Counts a check; says which one failed. The first few of a test are printed, the rest only counted.
bool check(bool good, const char* file, int line, const std::string& what);

// Text, or none.
inline std::string said(const std::string& text) { return text; }
inline std::string said(const char* text) { return text != nullptr ? text : "(null)"; }

inline std::string said(double a)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", a);
    return text;
}

}  // namespace fbtest

#define TEST(name)                                                    \
    static void test_##name();                                        \
    static fbtest::Test register_##name(__FILE__, #name, test_##name);  \
    static void test_##name()

#define CHECK(condition) fbtest::check((condition), __FILE__, __LINE__, #condition)

// Two numbers (anything that casts to double) no further apart than `tolerance`; both are shown when they are.
#define NEAR(a, b, tolerance)                                                                                       \
    do {                                                                                                            \
        const double a_ = (a), b_ = (b), t_ = (tolerance);                                                          \
        fbtest::check(a_ - b_ <= t_ && b_ - a_ <= t_, __FILE__, __LINE__,                                             \
                    std::string(#a " = ") + fbtest::said(a_) + ", expected " + fbtest::said(b_) + " +- " + fbtest::said(t_)); \
    } while (0)

// Two whole numbers that are equal.
#define SAME(a, b)                                                                                                \
    do {                                                                                                          \
        const long long a_ = static_cast<long long>(a), b_ = static_cast<long long>(b);                           \
        fbtest::check(a_ == b_, __FILE__, __LINE__,                                                                 \
                    std::string(#a " = ") + std::to_string(a_) + ", expected " + std::to_string(b_));             \
    } while (0)

#define TEXT(a, b)                                                                                                \
    do {                                                                                                          \
        const std::string a_ = fbtest::said(a), b_ = fbtest::said(b);                                             \
        fbtest::check(a_ == b_, __FILE__, __LINE__, std::string(#a " = \"") + a_ + "\", expected \"" + b_ + "\"");  \
    } while (0)

// A figure worth knowing, printed with the test's name.
void note(const char* format, ...) __attribute__((format(printf, 1, 2)));

// Random numbers, the same in every run.
struct Random {
    uint32_t state = 2463534242u;
    uint32_t bits()
    {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        return state;
    }
    // Evenly spread between the two.
    double between(double low, double high) { return low + (high - low) * (bits() / 4294967295.0); }
    int below(int n) { return static_cast<int>(bits() % static_cast<uint32_t>(n)); }
};

#endif
