// cost: prints the instructions per frame of each room (folder of src), source file and function of the program, and the clocks
// that a 486 takes for them according to published tables (clk486.h).
//
//   cost [-t FUNCTIONS] MAP CODE SHORT LONG FRAMES
//
// SHORT and LONG are callgrind's counts by address (--dump-instr=yes) of two runs of the same program, LONG with FRAMES
// frames more; subtracting them removes the start and the end of the program, which both have in common. MAP is the linker's map:
// it gives the object file of each address, so functions need not be known by name, and inlined code counts for the source that it
// is inlined into. A kernel asm/X.S belongs to the room that contains X.cpp. Instructions of the C library count for its callers,
// at their average number of clocks. CODE is the output of objdump -d -w for the program.
//
// Each line of the output is WHAT NAME INSTRUCTIONS CLOCKS:
//
//     all      all          the sum of the rooms
//     room     ROOM         a folder of src; asm: kernels without a twin; library: library code not called by the program
//     source   ROOM/NAME    a source file together with its kernel
//     function ROOM/NAME:F  the most expensive functions
//     unknown  all          instructions missing from the tables, counted as 2 clocks each
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "clk486.h"

namespace {

[[noreturn]] void fail(const std::string& what)
{
    std::cerr << "cost: " << what << "\n";
    exit(1);
}

std::ifstream open(const std::string& name)
{
    std::ifstream file(name);
    if (!file)
        fail(name + ": cannot be read");
    return file;
}

uint32_t address(const std::string& text)
{
    return static_cast<uint32_t>(strtoull(text.c_str(), nullptr, 16));
}

// --- Which source an address belongs to

struct Range {
    uint32_t from, to;
    std::string source;  // ROOM/NAME
};

class Map {
public:
    explicit Map(const std::string& name);

    // Returns the source at an address, or nullptr for the C library.
    const std::string* sourceAt(uint32_t address) const;

private:
    std::vector<Range> ranges_;
};

// Finds "src/ROOM/NAME.o" at the end of an object's path; returns an empty string for foreign objects.
std::string tailBehind(const std::string& path, const std::string& folder)
{
    const size_t at = path.rfind("/" + folder + "/");
    if (at == std::string::npos || path.size() < 2 || path.substr(path.size() - 2) != ".o")
        return "";
    const size_t begin = at + folder.size() + 2;
    return path.substr(begin, path.size() - 2 - begin);
}

Map::Map(const std::string& name)
{
    std::ifstream file = open(name);
    std::string line, section;
    std::map<std::string, std::string> twins;  // NAME: ROOM/NAME
    while (getline(file, line)) {
        std::istringstream words(line);
        std::string from, size, path;
        if (line.compare(0, 6, " .text") == 0) {
            words >> section;
        } else if (section.empty() || line.compare(0, 3, "   ") != 0) {
            section.clear();
            continue;
        }
        if (!(words >> from >> size >> path))
            continue;  // A long name of a section; the rest is on the next line.
        section.clear();
        Range range{address(from), address(from) + address(size), ""};
        if (range.from == 0 || range.from == range.to)
            continue;
        const std::string kernel = tailBehind(path, "asm");
        range.source = kernel.empty() ? tailBehind(path, "src") : "asm/" + kernel;
        if (range.source.empty())
            continue;
        if (kernel.empty())
            twins[range.source.substr(range.source.rfind('/') + 1)] = range.source;
        ranges_.push_back(range);
    }
    for (Range& range : ranges_) {
        const auto twin = twins.find(range.source.substr(range.source.rfind('/') + 1));
        if (range.source.compare(0, 4, "asm/") == 0 && twin != twins.end())
            range.source = twin->second;
    }
    std::sort(ranges_.begin(), ranges_.end(), [](const Range& a, const Range& b) { return a.from < b.from; });
    if (ranges_.empty())
        fail(name + ": no code of src in this map");
}

const std::string* Map::sourceAt(uint32_t address) const
{
    auto behind = std::upper_bound(ranges_.begin(), ranges_.end(), address,
                                   [](uint32_t a, const Range& range) { return a < range.from; });
    if (behind == ranges_.begin())
        return nullptr;
    --behind;
    return address < behind->to ? &behind->source : nullptr;
}

// --- Counts

struct Counts {
    std::map<uint32_t, double> executed;       // times that the instruction at an address was executed
    std::map<uint32_t, double> taken;          // times that the jump at an address was taken
    std::map<uint32_t, std::string> function;  // function that contains an address
    std::map<uint32_t, double> called;         // C library instructions executed by calls at an address
};

void add(Counts* counts, const std::string& name, const Map& map, double sign)
{
    std::ifstream file = open(name);
    std::string line, function;
    bool byAddress = false, call = false, jump = false;
    uint32_t callee = 0;
    double taken = 0;
    while (getline(file, line)) {
        if (line.compare(0, 10, "positions:") == 0)
            byAddress = line.find("instr") != std::string::npos;
        else if (line.compare(0, 3, "fn=") == 0)
            function = line.substr(3);
        else if (line.compare(0, 6, "calls=") == 0) {
            call = true;
            callee = address(line.substr(line.find(' ') + 1));
        } else if (line.compare(0, 5, "jcnd=") == 0 || line.compare(0, 5, "jump=") == 0) {
            jump = true;
            taken = line[1] == 'c' ? strtod(line.c_str() + 5, nullptr) : 0;
        } else if (line.compare(0, 2, "0x") == 0) {
            char* rest;
            const uint32_t at = static_cast<uint32_t>(strtoul(line.c_str(), &rest, 16));
            strtoul(rest, &rest, 10);
            const double cost = strtod(rest, nullptr);
            if (call) {
                if (map.sourceAt(callee) == nullptr && map.sourceAt(at) != nullptr)
                    counts->called[at] += sign * cost;
            } else if (jump) {
                counts->taken[at] += sign * taken;
            } else {
                counts->executed[at] += sign * cost;
                counts->function[at] = function;
            }
            call = jump = false;
        }
    }
    if (!byAddress)
        fail(name + ": no counts by address (valgrind --tool=callgrind --dump-instr=yes --compress-pos=no --compress-strings=no)");
}

// --- Clocks

using Code = std::map<uint32_t, Instruction>;

Code codeOf(const std::string& name)
{
    std::ifstream file = open(name);
    std::string line;
    Code code;
    Instruction instruction;
    while (getline(file, line)) {
        if (Clocks486::parse(line, &instruction))
            code[instruction.address] = instruction;
    }
    if (code.empty())
        fail(name + ": no instructions (objdump -d -w)");
    return code;
}

double clocksAt(const Code& code, const Counts& counts, uint32_t at, double times, double* unknown)
{
    const auto found = code.find(at);
    if (found == code.end())
        fail("the code does not go with the counts");
    const Instruction& i = found->second;
    const auto number = [](const std::map<uint32_t, double>& of, uint32_t address) {
        const auto there = of.find(address);
        return there == of.end() ? 0 : there->second;
    };
    Executed executed;
    executed.times = times;
    executed.taken = number(counts.taken, at);
    // Executions of the following instruction: how often execution went on after the repeated string instruction.
    executed.begun = std::min(times, number(counts.executed, at + static_cast<uint32_t>(i.length)));
    const Instruction* before = nullptr;
    if (found != code.begin()) {
        const Instruction& previous = std::prev(found)->second;
        if (previous.address + static_cast<uint32_t>(previous.length) == at)
            before = &previous;
    }
    bool known;
    const double clocks = Clocks486::of(i, before, executed, &known);
    *unknown += known ? 0 : times;
    return clocks;
}

// --- Sums

struct Cost {
    double instructions = 0, clocks = 0;

    void add(double instructionsMore, double clocksMore)
    {
        instructions += instructionsMore;
        clocks += clocksMore;
    }
};

using Sums = std::map<std::string, Cost>;

void print(const char* what, const Sums& sums, double frames, size_t most)
{
    std::vector<std::pair<double, std::string>> sorted;
    for (const auto& sum : sums)
        sorted.push_back({-sum.second.instructions, sum.first});
    std::sort(sorted.begin(), sorted.end());
    for (size_t i = 0; i < sorted.size() && i < most; ++i) {
        const Cost& cost = sums.at(sorted[i].second);
        printf("%s %s %.0f %.0f\n", what, sorted[i].second.c_str(), cost.instructions / frames, cost.clocks / frames);
    }
}

}  // namespace

int main(int count, char** arguments)
{
    size_t functions = 0;
    if (count > 2 && strcmp(arguments[1], "-t") == 0) {
        functions = strtoul(arguments[2], nullptr, 10);
        arguments += 2;
        count -= 2;
    }
    const double frames = count == 6 ? atof(arguments[5]) : 0;
    if (frames <= 0) {
        fputs("usage: cost [-t FUNCTIONS] MAP CODE SHORT LONG FRAMES\n", stderr);
        return 2;
    }
    const Map map(arguments[1]);
    const Code code = codeOf(arguments[2]);
    Counts counts;
    add(&counts, arguments[3], map, -1);
    add(&counts, arguments[4], map, 1);

    Sums all, rooms, sources, dearest, unknown;
    unknown["all"];
    const auto book = [&](uint32_t at, double instructions, double clocks) {
        const std::string* source = map.sourceAt(at);
        all["all"].add(instructions, clocks);
        rooms[source == nullptr ? "library" : source->substr(0, source->find('/'))].add(instructions, clocks);
        if (source == nullptr)
            return;
        sources[*source].add(instructions, clocks);
        std::string function = counts.function[at];
        function.erase(std::remove(function.begin(), function.end(), ' '), function.end());
        dearest[*source + ":" + function].add(instructions, clocks);
    };
    for (const auto& at : counts.executed)
        book(at.first, at.second, clocksAt(code, counts, at.first, at.second, &unknown["all"].instructions));
    // The C library's own count now contains what has been added to its callers.
    const Cost library = rooms["library"];
    const double clocksEach = library.instructions > 0 ? library.clocks / library.instructions : 1;
    for (const auto& at : counts.called) {
        const double clocks = at.second * clocksEach;
        book(at.first, at.second, clocks);
        all["all"].add(-at.second, -clocks);
        rooms["library"].add(-at.second, -clocks);
    }
    unknown["all"].clocks = 2 * unknown["all"].instructions;
    print("all", all, frames, 1);
    print("room", rooms, frames, rooms.size());
    print("source", sources, frames, sources.size());
    print("function", dearest, frames, functions);
    print("unknown", unknown, frames, 1);
    return 0;
}
