// Random scenes: composed statement by statement as the description of the format allows, and texts changed at random.
#ifndef FB_FUZZ_SCENES_H
#define FB_FUZZ_SCENES_H

#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

// Pseudo-random numbers; one seed always gives the same sequence.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}
    uint64_t next();
    // Returns a number from 0 to n - 1; 0 for n = 0.
    size_t below(size_t n) { return n == 0 ? 0 : static_cast<size_t>(next() % n); }
    // Returns true once in n times on average.
    bool once(size_t n) { return below(n) == 0; }
    // Returns one of all; there must be one.
    template <class All>
    auto& pick(All& all) { return all[below(std::size(all))]; }

private:
    uint64_t state_;
};

// Makes a scene of any number of statements. One in `slips` values is out of its range or not a value at all. With 0 slips
// the scene should be accepted, unless it exceeds a limit of the whole (numbers of objects, keys, or motions of one name).
std::string makeScene(Random& random, size_t slips);

// Changes a text at a few places: words, lines, single bytes. Inserted pieces may come from `other`.
void change(Random& random, std::string& text, const std::string& other);

#endif
