// Clocks that an instruction takes on a 486, according to the tables of the i486 Processor Programmer's Reference Manual, for
// the estimate of tools/cost.cpp. It is an estimate: every access is assumed to hit the cache and to be aligned, the prefetch
// queue to be full, and no write to wait for the bus. Where the tables leave the number open, it is taken as follows:
//
//   multiplication (13 to 42 clocks)     10 and one for each significant bit of the multiplier, which is taken to have 16
//                                        bits: 26; with operands of 16 bits 18, of 8 bits 15
//   bsf, bsr                             as for a bit in the middle: 24 and 55
//   setcc                                3.5 (4 if set, 3 if not)
//   address with base and index          one clock more
//   displacement and immediate operand   one clock more
//   base register just written           one clock more if the instruction before it in memory writes the register
//   size, address and segment prefixes   one clock more for each
//   conditional jump                     3 if taken, 1 if not, by the counts of both
#ifndef CLK486_H
#define CLK486_H

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

struct Instruction {
    uint32_t address = 0;
    int length = 0;
    int slowPrefixes = 0;  // prefixes that cost a clock each
    bool wide16 = false;   // operands of 16 bits
    bool repeated = false;
    std::string word;
    std::vector<std::string> operands;  // in AT&T order, the destination last
};

// How often an instruction was executed (`times`), and how often its jump was taken. `begun` says how often a repeated string
// instruction was started; its `times` counts each repetition, and the end once more.
struct Executed {
    double times = 0, taken = 0, begun = 0;
};

class Clocks486 {
public:
    // Returns the clocks of all executions. An instruction missing from the tables (the C library's SSE) counts 2 clocks and
    // sets *known to false.
    static double of(const Instruction& i, const Instruction* before, const Executed& executed, bool* known);

    // Parses a line of objdump -d -w. Returns false if the line holds no instruction.
    static bool parse(const std::string& line, Instruction* i);

private:
    static bool isRegister(const std::string& o) { return o[0] == '%' && o.find(':') == std::string::npos; }
    static bool isImmediate(const std::string& o) { return o[0] == '$'; }
    static bool isMemory(const std::string& o) { return !isRegister(o) && !isImmediate(o); }
    static bool isJump(const std::string& word) { return word[0] == 'j' && word.compare(0, 3, "jmp") != 0; }
    static double once(const Instruction& i, const std::string& word, bool* known);
    static double addressing(const Instruction& i, const Instruction* before);
};

inline bool Clocks486::parse(const std::string& line, Instruction* i)
{
    const size_t first = line.find(":\t");
    if (first == std::string::npos)
        return false;
    const size_t second = line.find('\t', first + 2);
    if (second == std::string::npos)
        return false;
    *i = Instruction();
    i->address = static_cast<uint32_t>(strtoul(line.c_str(), nullptr, 16));
    std::istringstream bytes(line.substr(first + 2, second - first - 2));
    std::string byte;
    bool prefix = true;
    while (bytes >> byte) {
        ++i->length;
        if (prefix && (byte == "f2" || byte == "f3"))
            i->repeated = true;
        else if (prefix && (byte == "66" || byte == "67" || byte == "f0" || byte == "2e" || byte == "36" || byte == "3e" ||
                            byte == "26" || byte == "64" || byte == "65"))
            ++i->slowPrefixes;
        else
            prefix = false;
        i->wide16 = i->wide16 || (prefix && byte == "66");
    }
    std::string text = line.substr(second + 1);
    const size_t remark = text.find_first_of("<#");
    if (remark != std::string::npos)
        text.erase(remark);
    std::istringstream words(text);
    // Prefixes are written before the instruction.
    static const std::set<std::string> PREFIXES = {"rep", "repz", "repnz", "lock", "data16", "addr16", "notrack", "bnd",
                                                   "cs",  "ds",   "es",    "fs",   "gs",     "ss"};
    while (words >> i->word && PREFIXES.count(i->word) != 0)
        continue;
    std::string operands, operand;
    getline(words, operands);
    int depth = 0;
    for (const char c : operands + ",") {
        if (c == '(')
            ++depth;
        if (c == ')')
            --depth;
        if (c == ',' && depth == 0) {
            if (!operand.empty())
                i->operands.push_back(operand);
            operand.clear();
        } else if (!isspace(static_cast<unsigned char>(c))) {
            operand += c;
        }
    }
    return !i->word.empty();
}

// Returns the clocks that prefixes and address cost in addition to the instruction itself.
inline double Clocks486::addressing(const Instruction& i, const Instruction* before)
{
    double more = i.slowPrefixes;
    bool immediate = false, displacement = false;
    for (const std::string& o : i.operands) {
        immediate = immediate || isImmediate(o);
        if (!isMemory(o) || i.word.compare(0, 4, "call") == 0 || i.word[0] == 'j')
            continue;
        const size_t open = o.find('('), comma = o.find(',');
        const size_t colon = o.find(':');
        displacement = displacement || open != (colon == std::string::npos ? 0 : colon + 1);
        if (open == std::string::npos)
            continue;
        const std::string base = o.substr(open + 1, o.find_first_of(",)", open) - open - 1);
        if (!base.empty() && comma != std::string::npos && o[comma + 1] == '%')
            more += 1;
        if (before == nullptr || before->operands.empty() || base.empty() || before->operands.back() != base)
            continue;
        const std::string& word = before->word;
        if (word.compare(0, 3, "cmp") != 0 && word.compare(0, 4, "test") != 0 && word.compare(0, 4, "push") != 0 &&
            word.compare(0, 2, "bt") != 0 && word[0] != 'j' && word.compare(0, 4, "call") != 0)
            more += 1;
    }
    return more + (immediate && displacement ? 1 : 0);
}

// Returns the clocks of one execution without its address; returns 0 and sets *known to false if the tables lack it.
inline double Clocks486::once(const Instruction& i, const std::string& word, bool* known)
{
    const auto begins = [&word](const char* with) { return word.compare(0, std::string(with).size(), with) == 0; };
    const std::string to = i.operands.empty() ? "" : i.operands.back(), from = i.operands.empty() ? "" : i.operands.front();
    const bool memoryTo = !to.empty() && isMemory(to), memoryFrom = !from.empty() && isMemory(from);
    const bool memory = memoryTo || memoryFrom;
    const bool byte = (!to.empty() && isRegister(to) && to.size() == 3 && (to[2] == 'l' || to[2] == 'h')) || word.back() == 'b';
    const bool byCount = i.operands.size() > 1 && from == "%cl";
    const bool indirect = !to.empty() && to[0] == '*';

    static const std::map<std::string, double> PLAIN = {
        {"cltd", 3}, {"cwtl", 3}, {"cbtw", 3}, {"cwtd", 3}, {"nop", 1},  {"leave", 5}, {"cld", 2},   {"std", 2},
        {"clc", 2},  {"stc", 2},  {"cmc", 2},  {"lahf", 3}, {"sahf", 2}, {"pusha", 11}, {"popa", 9}, {"pushf", 4},
        {"popf", 9}, {"xlat", 4}, {"bswap", 1}, {"lea", 1}, {"ret", 5}, {"int", 30}, {"hlt", 4}, {"ud2", 1}};
    const auto plain = PLAIN.find(word);
    if (plain != PLAIN.end())
        return plain->second;

    if (begins("movz") || begins("movsb") || begins("movsw") || begins("movsl")) {
        if (i.operands.size() == 2 && memoryTo && memoryFrom)
            return 7;  // The string instruction; operands as objdump writes them.
        return 3;
    }
    if (begins("stos"))
        return 5;
    if (begins("lods"))
        return 5;
    if (begins("scas"))
        return 6;
    if (begins("cmps"))
        return 8;
    static const char SEGMENTS[] = "%ds%es%fs%gs%ss%cs";
    const bool segment = to.size() == 3 && std::string(SEGMENTS).find(to) != std::string::npos;
    const bool ofSegment = from.size() == 3 && std::string(SEGMENTS).find(from) != std::string::npos;
    if (word == "mov" || word == "movb" || word == "movw" || word == "movl" || word == "movabs")
        return segment ? 9 : ofSegment ? 3 : 1;
    if (begins("cmp") && !begins("cmpx"))
        return memory ? 2 : 1;
    if (begins("test"))
        return memory ? 2 : 1;
    if (begins("add") || begins("adc") || begins("sub") || begins("sbb") || begins("and") || word == "or" ||
        word == "orb" || word == "orw" || word == "orl" || begins("xor"))
        return memoryTo ? 3 : memoryFrom ? 2 : 1;
    if (begins("inc") || begins("dec") || begins("neg") || begins("not"))
        return memory ? 3 : 1;
    if (begins("shld") || begins("shrd"))
        return (byCount ? 3 : 2) + (memory ? 1 : 0);
    if (begins("shl") || begins("shr") || begins("sar") || begins("sal") || begins("rol") || begins("ror")) {
        // Without a count written it is by one.
        const bool one = i.operands.size() == 1 || from == "$1" || from == "$0x1";
        return memory ? 4 : byCount || one ? 3 : 2;
    }
    if (begins("rcl") || begins("rcr"))
        return i.operands.size() == 1 || from == "$1" ? (memory ? 4 : 3) : (memory ? 10 : 9);
    if (begins("imul") || begins("mul"))
        return byte ? 15 : i.wide16 ? 18 : 26;
    if (begins("idiv"))
        return (byte ? 19 : i.wide16 ? 27 : 43) + (memory ? 1 : 0);
    if (begins("div"))
        return byte ? 16 : i.wide16 ? 24 : 40;
    if (begins("push"))
        return segment ? 3 : memory ? 4 : 1;
    if (begins("pop") && !begins("popc"))
        return segment ? 9 : memory ? 5 : 1;
    if (begins("call"))
        return indirect ? 5 : 3;
    if (begins("jmp"))
        return indirect ? 5 : 3;
    if (begins("ret"))
        return 5;
    if (begins("set"))
        return 3.5;
    if (begins("xchg"))
        return memory ? 5 : 3;
    if (begins("bts") || begins("btr") || begins("btc"))
        return memory ? (isImmediate(from) ? 8 : 13) : 6;
    if (word == "bt" || word == "btl" || word == "btw")
        return memory && !isImmediate(from) ? 8 : 3;
    if (begins("bsf"))
        return 24;
    if (begins("bsr"))
        return 55;
    *known = false;
    return 0;
}

inline double Clocks486::of(const Instruction& i, const Instruction* before, const Executed& executed, bool* known)
{
    *known = true;
    if (i.word == "jecxz" || i.word == "jcxz")
        return 5 * executed.times + 3 * executed.taken;
    if (i.word.compare(0, 4, "loop") == 0)
        return 6 * executed.times + executed.taken;
    if (isJump(i.word))
        return executed.times + 2 * executed.taken;
    if (i.repeated) {
        const double moved = executed.times - executed.begun;
        const std::string kind = i.word.substr(0, 4);
        if (kind == "movs")
            return 12 * executed.begun + 3 * moved;
        if (kind == "stos")
            return 7 * executed.begun + 4 * moved;
        if (kind == "scas")
            return 7 * executed.begun + 5 * moved;
        if (kind == "cmps")
            return 7 * executed.begun + 7 * moved;
        if (kind == "lods")
            return 7 * executed.begun + 4 * moved;
    }
    // SSE and x87 bear names of other instructions in part, but other registers.
    for (const std::string& o : i.operands)
        *known = *known && o.compare(0, 4, "%xmm") != 0 && o.compare(0, 4, "%ymm") != 0 && o.compare(0, 3, "%st") != 0;
    const double one = *known && i.word[0] != 'f' ? once(i, i.word, known) : (*known = false, 0);
    return executed.times * (*known ? one + addressing(i, before) : 2);
}

#endif
