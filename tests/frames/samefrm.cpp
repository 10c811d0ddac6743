// Compares the dumped frames of two directories file by file.
//
//   samefrm A B            both must have the same files with the same bytes
//   samefrm -near A B      both must have the same frames with nearly the same pictures: for builds with another kind of Real,
//                          whose seeds are rounded differently. Scenes are not compared.
//
// Prints one line about what was compared. The exit status is 0 if they agree, 1 if not, 2 if a directory cannot be read.
#include <dirent.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace {

std::set<std::string> names(const std::string& directory)
{
    std::set<std::string> found;
    DIR* d = opendir(directory.c_str());
    if (d == nullptr) {
        std::fprintf(stderr, "samefrm: cannot read %s\n", directory.c_str());
        std::exit(2);
    }
    while (const dirent* entry = readdir(d))
        if (entry->d_name[0] == 'F')
            found.insert(entry->d_name);
    closedir(d);
    return found;
}

std::string contents(const std::string& name)
{
    std::ifstream file(name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

bool ends(const std::string& name, const char* with)
{
    const size_t n = std::strlen(with);
    return name.size() >= n && name.compare(name.size() - n, n, with) == 0;
}

int exact(const std::string& a, const std::string& b)
{
    const std::set<std::string> inA = names(a), inB = names(b);
    long frames = 0, bytes = 0, differ = 0, missing = 0;
    std::string first;
    for (const std::string& name : inA) {
        if (inB.count(name) == 0) {
            ++missing;
            continue;
        }
        const std::string x = contents(a + "/" + name), y = contents(b + "/" + name);
        frames += ends(name, ".PPM");
        const size_t least = std::min(x.size(), y.size());
        long here = static_cast<long>(std::max(x.size(), y.size()) - least);
        for (size_t i = 0; i < least; ++i)
            here += x[i] != y[i];
        bytes += static_cast<long>(least);
        differ += here;
        if (here != 0 && first.empty())
            first = name;
    }
    for (const std::string& name : inB)
        missing += inA.count(name) == 0;
    std::printf("%ld frames, %ld bytes compared, %ld differ", frames, bytes, differ);
    if (missing != 0)
        std::printf(", %ld files on one side only", missing);
    if (!first.empty())
        std::printf(", the first in %s", first.c_str());
    std::printf("\n");
    return frames == 0 || differ != 0 || missing != 0;
}

// Limits for nearly the same pictures. A seed that is rounded differently moves the edges of its scale by a pixel, or is hidden by
// another seed: a pixel then shows a neighbour's brightness and depth, or the background.
constexpr int BRIGHTNESS = 24;          // of 255: about 6 of the ramp's 64 steps
constexpr double DEPTH = 1.0;           // units
constexpr double UNLIKE_MOST = 0.025;   // greatest share of drawn pixels that differ by more, on average over the frames
constexpr double OUTLINE_MOST = 0.005;  // greatest share of pixels drawn in only one of the pictures

int near(const std::string& a, const std::string& b)
{
    const std::set<std::string> inA = names(a), inB = names(b);
    long frames = 0;
    double worstUnlike = 0, worstOutline = 0, sumUnlike = 0, sumOutline = 0;
    for (const std::string& name : inA) {
        if (!ends(name, ".PPM"))
            continue;
        const std::string stem = name.substr(0, name.size() - 3);
        const std::string x = contents(a + "/" + name), y = contents(b + "/" + name);
        const std::string zx = contents(a + "/" + stem + "Z"), zy = contents(b + "/" + stem + "Z");
        if (x.size() != 192015 || y.size() != x.size() || zx.size() != 256000 || zy.size() != zx.size()) {
            std::printf("%s is not whole on both sides\n", name.c_str());
            return 1;
        }
        ++frames;
        long drawn = 0, unlike = 0, outline = 0;
        for (size_t i = 0; i < 64000; ++i) {
            int32_t p, q;
            std::memcpy(&p, zx.data() + 4 * i, 4);
            std::memcpy(&q, zy.data() + 4 * i, 4);
            const bool inP = p != INT32_MAX, inQ = q != INT32_MAX;
            if (!inP && !inQ)
                continue;
            ++drawn;
            if (inP != inQ) {
                ++outline;
                continue;
            }
            int most = 0;
            for (size_t part = 0; part < 3; ++part)
                most = std::max(most,
                                std::abs(static_cast<uint8_t>(x[15 + 3 * i + part]) - static_cast<uint8_t>(y[15 + 3 * i + part])));
            unlike += most > BRIGHTNESS || std::abs(p / 65536.0 - q / 65536.0) > DEPTH;
        }
        if (drawn == 0)
            continue;
        const double u = static_cast<double>(unlike) / static_cast<double>(drawn),
                     o = static_cast<double>(outline) / static_cast<double>(drawn);
        worstUnlike = std::max(worstUnlike, u);
        worstOutline = std::max(worstOutline, o);
        sumUnlike += u;
        sumOutline += o;
    }
    const double meanUnlike = frames > 0 ? sumUnlike / static_cast<double>(frames) : 1,
                 meanOutline = frames > 0 ? sumOutline / static_cast<double>(frames) : 1;
    std::printf("%ld frames: %.2f%% of the drawn pixels unlike (at most %.1f%%; worst frame %.2f%%), %.2f%% drawn in one only (at "
                "most %.1f%%; worst %.2f%%)\n",
                frames, meanUnlike * 100, UNLIKE_MOST * 100, worstUnlike * 100, meanOutline * 100, OUTLINE_MOST * 100,
                worstOutline * 100);
    return frames == 0 || inA.size() != inB.size() || meanUnlike > UNLIKE_MOST || meanOutline > OUTLINE_MOST;
}

}  // namespace

int main(int count, char** arguments)
{
    if (count == 3)
        return exact(arguments[1], arguments[2]);
    if (count == 4 && std::strcmp(arguments[1], "-near") == 0)
        return near(arguments[2], arguments[3]);
    std::fprintf(stderr, "usage: samefrm [-near] A B\n");
    return 2;
}
