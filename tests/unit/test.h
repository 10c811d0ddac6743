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

// These count a check and say which one failed. The first few of a test are printed, the rest only counted. They take no strings
// that have to be made first, because most checks do not fail.
bool check(bool good, const char* file, int line, const char* what);
void checkNear(double a, double b, double tolerance, const char* file, int line, const char* what);
void checkSame(long long a, long long b, const char* file, int line, const char* what);
void checkText(const std::string& a, const std::string& b, const char* file, int line, const char* what);

// Text, or none.
inline std::string said(const std::string& text) { return text; }
inline std::string said(const char* text) { return text != nullptr ? text : "(null)"; }

}  // namespace fbtest

#define TEST(name)                                                    \
    static void test_##name();                                        \
    static fbtest::Test register_##name(__FILE__, #name, test_##name);  \
    static void test_##name()

#define CHECK(condition) fbtest::check((condition), __FILE__, __LINE__, #condition)

// Two numbers (anything that casts to double) no further apart than `tolerance`; both are shown when they are.
#define NEAR(a, b, tolerance) fbtest::checkNear((a), (b), (tolerance), __FILE__, __LINE__, #a)

// Two whole numbers that are equal.
#define SAME(a, b) fbtest::checkSame(static_cast<long long>(a), static_cast<long long>(b), __FILE__, __LINE__, #a)

// Two texts that are equal.
#define TEXT(a, b) fbtest::checkText(fbtest::said(a), fbtest::said(b), __FILE__, __LINE__, #a)

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
