// Reader: reads the statements of a scene file, one on each line. reader.cpp has their table; each subject has a file of its
// own.
#ifndef FB_READER_H
#define FB_READER_H

#include "words.h"

// The items made by one line: `count` items of the model from index `first` on. A line that makes several items gives the row a
// name of its own; find() treats a single item as a row of one.
struct Row {
    static constexpr int LEAST = 2;
    static constexpr int ROWS_MOST = (Model::OBJECTS_MOST + Model::GROUPS_MOST) / LEAST;  // a row has LEAST items

    char name[NAME_ROOM];
    int first = 0;
    int count = 0;
};

// The timing of a periodic motion as a line gives it; each item of a row is `lag` turns behind the previous item.
struct Timing {
    Real period{0}, phase{0}, lag{0};
    bool given = false;  // the line gives a period

    Wave waveOf(int i) const { return makeWave(period, phase - lag * Real(i)); }
};

// The contents of a line that makes an object, a group or a row of them.
struct ItemLine {
    Actor actor;
    int given = 0;  // bit i: measure i was given
    Real count{1};
    Vector step{Real(0), Real(0), Real(0)};
    bool stepped = false, coloured = false;
};

class Reader : public Words {
public:
    Reader(const char* name, Source& source, Model& model) : Words(name, source), model_(model) {}

    bool read();

private:
    struct Statement {
        const char* word;
        bool (Reader::*read)();
    };
    static const Statement STATEMENTS[];

    // A clause that may follow the name of an item, and where it is allowed.
    struct Clause {
        const char* word;
        bool ofObjects, ofGroups;
        bool (Reader::*read)(ItemLine& line);
    };
    static const Clause CLAUSES[];

    // Functions for statements, by the file they are in. reader.cpp:
    bool statement();
    bool expectedStatement();
    // rditems.cpp
    bool object(const Kind* kind);
    bool group() { return object(nullptr); }
    bool itemName(ItemLine& line);
    bool itemClause(ItemLine& line);
    bool itemPlace(ItemLine& line);
    bool itemTurn(ItemLine& line);
    bool itemParent(ItemLine& line);
    bool itemRepeat(ItemLine& line);
    bool itemStep(ItemLine& line);
    bool itemColour(ItemLine& line);
    bool itemStretch(ItemLine& line);
    bool itemScale(ItemLine& line);
    bool addRow(ItemLine& line);
    bool roomFor(bool groups, int count);
    bool strength();
    bool blend();
    bool dent();
    bool readPair(const char* what, Row* a, Row* b);
    bool readWeight(Real* weight);
    // rdmoves.cpp
    bool circle();
    bool readPlane(int* first, int* second);
    bool path();
    bool pathClauses(const Row& row, Real* lag, bool move);
    bool moveAlong(const Row& row, int axis, Real amplitude, const Timing& timing);
    bool spin() { return turning(MOTION_SPIN); }
    bool swing() { return turning(MOTION_SWING); }
    bool turning(MotionPart part);
    bool pulse();
    bool taper() { return warp(WARP_TAPER); }
    bool twist() { return warp(WARP_TWIST); }
    bool bend() { return warp(WARP_BEND); }
    bool warp(WarpPart part);
    bool keys();
    bool keysClauses(Motion& motion);
    bool key();
    bool fitsKeys(const Row& row, int32_t time);
    bool keyValues(Key* key);
    // rdlooks.cpp
    bool title();
    bool colours();
    bool finish();
    bool pattern();
    bool eye();
    bool eyeParent(const Actor** parent);
    bool look();
    bool roll();
    bool focal();
    bool light();

    // Functions that find the items a name stands for.
    bool readKnown(const char* what, Actor** item);
    bool readMoving(Row* row);
    bool readObjects(Row* row);
    bool isObjects(Row* row) const;
    Actor* eyeCarrier();
    Actor& in(const Row& row, int i) { return model_.item(row.first + i); }
    const Actor& in(const Row& row, int i) const { return model_.item(row.first + i); }
    const Row* rowNamed(const char* name) const;
    bool find(const char* name, Row* row) const;
    bool isTaken(const char* name) const { return model_.itemNamed(name) != nullptr || rowNamed(name) != nullptr; }

    // The clauses `period`, `phase` and `lag` of a motion.
    bool isTiming() const { return is("period") || is("phase") || is("lag"); }
    bool readTiming(const Row& row, Timing* timing);
    bool readPeriod(Real* seconds);
    bool readPhase(Real* phase);
    bool readLag(const Row& row, Real* lag);
    bool addMoves(const Row& row, Move move, const Timing& timing);
    Move* further(Actor& item, MotionPart part);

    Model& model_;
    int allBlended_ = 0;
    int rowPairs_ = 0;
    Row row_[Row::ROWS_MOST];
    int rows_ = 0;
};

#endif
