// Scenes at random: written statement by statement as the format's page has them, and changed word by word.
#ifndef FB_FUZZ_SCENES_H
#define FB_FUZZ_SCENES_H

#include <cstdint>
#include <string>
#include <vector>

// Numbers that look random and are the same for the same seed.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}
    uint64_t next();
    // 0 .. n - 1; 0 for n = 0.
    size_t below(size_t n) { return n == 0 ? 0 : static_cast<size_t>(next() % n); }
    // True once in n times on average.
    bool once(size_t n) { return below(n) == 0; }

private:
    uint64_t state_;
};

// A scene of any number of statements. One in `slips` values is out of its range, or no value at all; 0: none is, and the
// scene should be accepted, but for limits of the whole (numbers of objects, keys, motions of one name).
std::string makeScene(Random& random, size_t slips);

// Changes a text at a few places: words, lines, single bytes. `other` is where pieces may come from.
void change(Random& random, std::string& text, const std::string& other);

#endif
