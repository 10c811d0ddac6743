// The seeds of a patch that neighbours reach, where all are balls of weight 1: which neighbours matter to each, whether it is
// at rest, inside, or faces away, and, where one neighbour alone reaches it, its place from the profile of the pair. Most of
// what settling costs is this, so the routines stand twice: in C++ (src/surface/ride.cpp) and in assembly (asm/ride.S); both do the
// same, bit for bit, wherever the numbers of C++ do not overflow. What is seldom is left to the caller.
#ifndef FB_RIDE_H
#define FB_RIDE_H

#include "surface/lie.h"
#include "surface/profile.h"

// Squared distance / squared size from which a neighbour is left out: its field is 0.006 there, inside the tolerance.
constexpr Real TOUCHING(0.9);
constexpr Real DISPLACEMENT(0.010);  // of the field at the seed's last place: less is taken as not moved
// A seed is looked for to within 0.01 of the field. Newton's last step is taken without another look when it is short.
constexpr Real SHORT_STEP(0.05);     // of the position: what remains after it is below 2 SHORT_STEP^2 in the field
constexpr Real LONGEST_STEP(0.25);   // of the position
constexpr int LOOK_LIMIT = 8;        // then the surface is bracketed and bisected
constexpr Real FLAT(-0.2);           // slope above which Newton's method is not trusted
// No seed is looked for farther in: there its own field is more than the isovalue.
constexpr Real PLACED_LEAST(0.95);
// No valid seed lies farther out: there its own field is 0.013, and a neighbour that makes up the rest alone is stronger by
// more than the overshoot.
constexpr Real POSITION_MOST(1.85);
constexpr int32_t OVER_BACK = 128;   // 1/256 unit: how far a seed beyond the border is set back
// Travel is counted in steps; no seed waits longer than so many of them.
constexpr int WAIT_MOST = 0x3000;
// Steps of travel after which it is asked again whether all that reached a patch still do.
constexpr int RECHECK = 640;
// Of b: by how much the numbers of a run may be wrong together.
constexpr Real RUN_DOUBT(0.004);
// The most units of what is known of directions to the eye that are waited for.
constexpr int AWAY_MOST = 24;

// b of a path tells how near it leads a seed to a neighbour: the squared distance / squared size is
// a0 + position (b + position c0). It is path . twice; in 16.16 of shorter numbers, so that one has it scaled by 1/16.
#if FB_REAL == FB_FIXED
constexpr int B_SHIFT = 4;
#else
constexpr int B_SHIFT = 0;
#endif

// A neighbour in range, as the seeds of an object see it.
struct RideNear {
    Pull pull;
    Real a0, c0;
    Vector twice;  // b = path . twice; in 16.16: scaled by 2^12 and used with mulHigh
    // b below these: its field reaches the path somewhere up to where the last seeds lie; it reaches the seed at rest; that
    // whole stretch of the path lies inside the surface. For sums(), of b / 2^B_SHIFT, rounded up.
    Real meetingSum, touchingSum, buryingSum;
    // The same as meetingSum for a run and the oversampled seeds beside it; and how much b changes over half a unit, scaled as
    // `twice`.
    Real meetingRunSum, swing;
    Real touching, burying;
    Real sum;  // of the seed at hand, where its field does not reach it at rest; of the nearest place of the run at hand
    // Steps of travel that seeds wait: for a difference of 1 in squared distance / squared size on this side of where its
    // field ends, and of where it buries; for a facing of 1/32 unit (16 bits of fraction).
    Real waitApart, waitBuried;
    int32_t waitFacing;
    Real halfSquare, awayLimit, waitAway;  // see Settler::facesAway()
    Profile* profile;
    RideNear* next;  // of those that reach the patch
    RideNear* more;  // of those in range
    uint32_t bit;    // of RideFrame::reached
};

// What is constant over the seeds of an object or of a patch, and what was found for the seed at hand.
struct RideFrame {
    RideNear* first;      // of those that reach the patch; not null
    int32_t travel;       // the object's, in the upper 16 bits
    int32_t later;        // that a seed is awake from the next update on: travel - 1
    Real awayEdge, awayShare, waitAlong;  // see Settler::facesAway()
    int32_t awayAlong;    // EyeSide::along() below this: units of it are less than awayEdge
    int32_t waitAway;     // steps of travel for 1/32 unit of EyeSide::away(), 16 bits of fraction
    int32_t paceSteps;    // steps of travel for which others are thought to move on as they do
    Real placedMost;      // where one neighbour alone makes up the isovalue farther out, it is too strong
    Real evenMost;        // up to where the own field is the stronger one of two
    Real kept, keptTwice;        // of the position: up to this is taken as not moved
    Real parting, partingTwice;  // more than this difference of positions activates the seed between
    Real overshoot;
    int32_t keptWait;     // not 0: those that stay where they are wait too
    int32_t placed;       // counts seeds that were placed by a profile
    int32_t several;      // counts those that more than one neighbour reaches
    int32_t looks;        // counts rideLook()s
    const Seed* shaded;   // the seed at hand, if it has been shaded and faces the viewer, else null
    int32_t facing;       // and EyeSide::facing() of that
    int32_t normals;      // counts seeds that were shaded and face the viewer
    int32_t unsettled;    // counts those that LOOK_LIMIT looks did not settle
    // Of the last look: the field less the isovalue, its slope along the path, by how much the strongest neighbour is stronger
    // than the overshoot allows.
    Real excess, slope, strength;
    RideNear* inRange;    // may be null
    // Of the last rideReach(): the bits of the neighbours that reach the run; steps of travel until others may do, or the state
    // changes.
    uint32_t reached;
    int32_t holds;
    void (*profileFor)(RideNear*);  // makes the profile; before that it has been Profile::clear()ed
    // Of a seed that several neighbours reach, and that may be seen. It is where it was; how long it stays. Its position is a
    // place where the path leaves the surface, but a neighbour is too strong. It is to be looked for from a position.
    void (*stays)(Seed*);
    void (*held)(Seed*);
    void (*lost)(Seed*, Real from);
    void (*rough)(Seed*);    // its brightness differs much from that of one beside it
    int32_t uneven, unevenTwice;  // that is, by more than so many steps: if both had one all over, the cells would show
    Real b[PULLS_MOST];      // of the neighbours that matter: shade.pulls, of which each is a RideNear's
    Real beyond[PULLS_MOST];
    ShadeFrame shade;
};

// What is at a fixed address needs no register to find it; one object is settled at a time.
extern "C" RideFrame ride;

// What becomes of a run: all of it rests where it would be alone, or is inside, or it depends.
enum RideReach : int32_t { REACHES_NONE = 1, REACHES_BURYING, REACHES_SOME };

extern "C" {

// Settles what is awake of the seeds of a run, one or more, and of the oversampled ones behind them (see SoftObject's seeds);
// sets `turned`, `extras` and `back` of the run. Where `extras` is false none of the oversampled ones takes part, and all their
// flags are 0. Returns 0 if none was awake, else 1.
int32_t rideC(SeedRun* run, Seed* seeds);

// What neighbours do to a run: RideReach.
int32_t rideReachC(const SeedRun* run);

// The field at a position (0.95..1.85) of the path for which ride.b, shade.pulls and shade.count (1 or more) are set: to
// ride.excess, slope and strength; and to ride.shade what the normal needs.
void rideLookC(Real position);

#if FB_ASM && FB_REAL == FB_FIXED
int32_t rideA(SeedRun* run, Seed* seeds);
int32_t rideReachA(const SeedRun* run);
void rideLookA(Real position);
#endif

}

#if FB_ASM && FB_REAL == FB_FIXED
#define rideSeeds rideA
#define rideReach rideReachA
#define rideLook rideLookA
#else
#define rideSeeds rideC
#define rideReach rideReachC
#define rideLook rideLookC
#endif

// The product of a length and a number that is scaled as RideNear::twice, / 2^B_SHIFT.
inline Real scaledProduct(Real a, Real scaled)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulHigh(a.raw, scaled.raw));
#else
    return a * scaled;
#endif
}

// b / 2^B_SHIFT of a path.
inline Real alongSum(const Vector& path, const Vector& twice)
{
    return scaledProduct(path.x, twice.x) + scaledProduct(path.y, twice.y) + scaledProduct(path.z, twice.z);
}

// What such a sum is compared with, for b below a limit.
inline Real sumBelow(Real limit)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw((limit.raw + (1 << B_SHIFT) - 1) >> B_SHIFT);
#else
    return limit;
#endif
}

// Steps of travel to wait for a difference when there are `wait` for 1; for those larger than `most` no more.
inline int32_t stepsOf(Real difference, Real most, Real wait)
{
    return floorToInt(least(difference, most) * wait);
}
inline int32_t stepsOf(Real difference, Real wait)
{
    return stepsOf(difference, Real(1), wait);
}

inline int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

// The neighbour N of a seed.
inline Seed& pairedWith(Seed* s, const Seed& extra)
{
    return *reinterpret_cast<Seed*>(reinterpret_cast<char*>(s) + extra.neighbour);
}

// Whether the cells of two seeds side by side show.
inline bool differ(const Seed& s, const Seed& t)
{
    return static_cast<unsigned>(t.voxel.brightness - s.voxel.brightness + ride.uneven) > static_cast<unsigned>(ride.unevenTwice);
}

// What rideC() does, by a settle(Seed&) for those that are awake.
template <class Settle>
inline int32_t throughSeeds(SeedRun& run, Seed* s, Settle settle)
{
    const bool turned = run.turned;
    run.turned = run.extras = false;
    run.back = true;
    bool busy = false;
    const auto passed = [](const Seed& seed) { return static_cast<int16_t>(seed.wakes - (ride.travel >> 16)) < 0; };
    const auto turn = [](Seed& seed) {
        if ((seed.flags & (SEED_PLACED | SEED_FRONT)) == (SEED_PLACED | SEED_FRONT)) {
            seed.flags = static_cast<uint8_t>(seed.flags & ~SEED_KEPT);
            seed.wakes = static_cast<int16_t>(ride.later);
        }
    };
    for (int i = run.count; i > 0; --i, s += 2) {
        if (turned)
            turn(*s);
        if (passed(*s)) {
            settle(*s);
            busy = true;
            if (ride.shaded == s) {
                ride.shaded = nullptr;
                if (differ(*s, pairedWith(s, s[1])) || (i < run.count && differ(*s, s[-2])))
                    ride.rough(s);
            }
        }
        if (s->flags & SEED_FRONT)
            run.back = false;
        // In the first ring a seed is paired with itself, to no effect.
        Seed& extra = s[1];
        const Seed& other = pairedWith(s, extra);
        const uint8_t either = s->flags | other.flags;
        if ((either & (SEED_PLACED | SEED_FRONT)) != (SEED_PLACED | SEED_FRONT)) {
            extra.flags = 0;
            continue;
        }
        // Beside one that is inside there is nothing else; one that is only beyond a border has the neighbour's own.
        const bool belt = ((s->flags ^ other.flags) & SEED_VALID) != 0;
        if (belt ? (s->flags & other.flags & SEED_PLACED) != 0 : absolute(s->position - other.position) <= ride.parting) {
            extra.flags = 0;
            continue;
        }
        if (turned)
            turn(extra);
        if (!(extra.flags & SEED_ACTIVE) || passed(extra)) {
            settle(extra);
            busy = true;
            if (ride.shaded == &extra) {
                ride.shaded = nullptr;
                if (differ(extra, *s) || differ(extra, other))
                    ride.rough(&extra);
            }
        }
        extra.flags |= SEED_ACTIVE;
        if (extra.flags & SEED_FRONT)
            run.back = false;
        run.extras = true;
    }
    return busy;
}

#endif
