// Runs all unit tests, or those whose name contains the first argument.
#include "test.h"

#include <cstdarg>
#include <cstring>

#include "math/normal.h"
#include "model/field.h"

namespace {

fbtest::Test* first = nullptr;
const char* running = "";
int bad = 0;
long checks = 0;
constexpr int SHOWN = 5;

const char* tail(const char* path)
{
    const char* slash = std::strrchr(path, '/');
    return slash != nullptr ? slash + 1 : path;
}

}  // namespace

namespace fbtest {

Test::Test(const char* f, const char* n, void (*r)()) : file(f), name(n), run(r), next(nullptr)
{
    Test** at = &first;
    while (*at != nullptr)
        at = &(*at)->next;
    *at = this;
}

bool check(bool good, const char* file, int line, const char* what)
{
    ++checks;
    if (!good && ++bad <= SHOWN)
        std::printf("  %s:%d: %s\n", tail(file), line, what);
    return good;
}

void checkNear(double a, double b, double tolerance, const char* file, int line, const char* what)
{
    ++checks;
    if (!(a - b <= tolerance && b - a <= tolerance) && ++bad <= SHOWN)
        std::printf("  %s:%d: %s = %.9g, expected %.9g +- %.9g\n", tail(file), line, what, a, b, tolerance);
}

void checkSame(long long a, long long b, const char* file, int line, const char* what)
{
    ++checks;
    if (a != b && ++bad <= SHOWN)
        std::printf("  %s:%d: %s = %lld, expected %lld\n", tail(file), line, what, a, b);
}

void checkText(const std::string& a, const std::string& b, const char* file, int line, const char* what)
{
    ++checks;
    if (a != b && ++bad <= SHOWN)
        std::printf("  %s:%d: %s = \"%s\", expected \"%s\"\n", tail(file), line, what, a.c_str(), b.c_str());
}

}  // namespace fbtest

void note(const char* format, ...)
{
    std::printf("# %s: ", running);
    va_list args;
    va_start(args, format);
    std::vprintf(format, args);
    va_end(args);
    std::printf("\n");
}

int main(int count, char** arguments)
{
    makeFieldSteps();
    makeNormalTable();
    int passed = 0, failed = 0;
    for (fbtest::Test* test = first; test != nullptr; test = test->next) {
        const std::string name = std::string(tail(test->file)) + " " + test->name;
        if (count > 1 && name.find(arguments[1]) == std::string::npos)
            continue;
        bad = 0;
        running = test->name;
        test->run();
        if (bad == 0) {
            ++passed;
            std::printf("ok %s\n", name.c_str());
        } else {
            ++failed;
            std::printf("FAIL %s: %d checks\n", name.c_str(), bad);
        }
        std::fflush(stdout);
    }
    std::printf("%ld checks\n%d passed, %d failed\n", checks, passed, failed);
    return failed != 0;
}
