// Profiles of pairs of balls, held against the field of both in double precision.
#include "surface/profile.h"

#include <cmath>

#include "model/field.h"
#include "help.h"
#include "test.h"

namespace {

// As far as anyone goes out along a path; how near a place has to be, as a position or in the field.
constexpr double FARTHEST = 1.75, NEAR_ENOUGH = 0.02;

// Two balls: along a path of the first one whose angle with the line from the second one has this cosine.
struct Pair {
    double size, other, distance;

    double a0() const { return distance * distance / (other * other); }
    double c0() const { return size * size / (4 * other * other); }
    // b of the path that points straight away from the other ball.
    double most() const { return distance * size / (other * other); }

    double own(double position) const { return trueGeoff(position * position / 4); }
    double field(double b, double position) const
    {
        return own(position) + trueGeoff(a0() + position * (b + position * c0()));
    }
    // What the object that profiles are made for says is its border.
    double border() const
    {
        const double overshoot = std::fmin(3 / size, 0.7);
        double low = 1.15, high = 1.85;
        for (int i = 0; i < 40; ++i) {
            const double middle = (low + high) / 2;
            (own(middle) > (0.5 - overshoot) / 2 ? low : high) = middle;
        }
        return low;
    }
    void make(Profile& profile) const { profile.make(real(a0()), real(c0()), real(-most()), real(border())); }
};

// Pairs of all kinds that reach each other, and near ones, where one lies in the other.
class Pairs {
public:
    double between(double low, double high) { return random_.between(low, high); }
    Pair next()
    {
        for (;;) {
            Pair p{between(5, 60), between(5, 60), 0};
            p.distance = between(0.5, p.other + FARTHEST * p.size / 2);
            // Steeper ones are not looked up.
            if (p.size / p.other < 10 && 2 * p.distance / (p.other * p.other) < 7.9)
                return p;
        }
    }

private:
    Random random_;
};

// Looks along a path by small steps. `first` is where the field falls below the isovalue, or 0; `before` is the least field
// up to `position`, and `least` up to FARTHEST.
struct Walk {
    double first = 0, before = 9, least = 9;

    Walk(const Pair& pair, double b, double position)
    {
        for (int i = 0; i <= 400; ++i) {
            const double at = 1 + (FARTHEST - 1) * i / 400, field = pair.field(b, at);
            // At 1 the own field alone is the isovalue.
            if (first == 0 && field < 0.5 - 1e-9)
                first = at;
            if (at <= position)
                before = std::fmin(before, field);
            least = std::fmin(least, field);
        }
    }
};

// What was found of profiles, all in all.
struct Sums {
    int found = 0, pulled = 0, buried = 0, wrong = 0;
    double farthest = 0, lowest = 9;

    void look(const Pair& pair, const Profile& profile, double b)
    {
        Real place;
        const bool leaves = profile.place(real(b), place);
        const double position = leaves ? number(place) : 0;
        const Walk walk(pair, b, position);
        bool good;
        if (leaves) {
            ++found;
            pulled += position > 1.05;
            const double off = std::fabs(pair.field(b, position) - 0.5);
            good = walk.first != 0 && std::fabs(position - walk.first) < NEAR_ENOUGH;
            if (!good) {
                farthest = std::fmax(farthest, off);
                // Where it grazes the isovalue before, that is the same.
                good = off < NEAR_ENOUGH && walk.before > 0.5 - NEAR_ENOUGH;
            }
            CHECK(position >= 1 && position <= 1.95);
        } else {
            ++buried;
            lowest = std::fmin(lowest, walk.least);
            good = walk.least > 0.5 - NEAR_ENOUGH;
        }
        if (!good && wrong++ < 5)
            note("sizes %.2f and %.2f, %.2f apart, b %.4f: found at %.4f, field %.4f; leaves at %.4f, least field %.4f", pair.size,
                 pair.other, pair.distance, b, position, pair.field(b, position), walk.first, walk.least);
    }
    void report() const
    {
        note("%d found, %d of them pulled; off by %.4f of the field at most; %d not found, field there %.4f at least; %d wrong",
             found, pulled, farthest, buried, lowest, wrong);
    }
};

}  // namespace

TEST(profiles_are_where_the_field_of_both_ends)
{
    Pairs pairs;
    Sums sums;
    for (int i = 0; i < 1500; ++i) {
        const Pair pair = pairs.next();
        Profile profile;
        pair.make(profile);
        for (int k = 0; k < 60; ++k)
            sums.look(pair, profile, pair.most() * pairs.between(-1, 1));
    }
    sums.report();
    SAME(sums.wrong, 0);
    CHECK(sums.pulled > 5000 && sums.buried > 5000);
}

TEST(profiles_know_folds)
{
    // Paths that leave the surface, but would not if they were a little nearer to the other ball: then they go through it. So
    // the place jumps there.
    Pairs pairs;
    Sums sums;
    int folds = 0;
    for (int i = 0; i < 4000; ++i) {
        const Pair pair = pairs.next();
        double before = 0;
        for (int k = 0; k <= 100; ++k) {
            const double b = pair.most() * (1 - 0.02 * k);
            const double first = Walk(pair, b, 0).first;
            if (before != 0 && first > before + 0.1) {
                ++folds;
                Profile profile;
                pair.make(profile);
                for (int n = 0; n < 60; ++n)
                    sums.look(pair, profile, b + 0.02 * pair.most() * pairs.between(0, 1));
            }
            before = first;
        }
    }
    note("%d folds", folds);
    sums.report();
    SAME(sums.wrong, 0);
    CHECK(folds > 100);
}

TEST(a_profile_s_edge_is_no_nearer_than_the_border)
{
    // Seeds that are too far out wait until their b is that of the edge: until then none may be within the border. And few
    // beyond it should be looked for in vain: those of a step, or where the surface has a fold.
    Pairs pairs;
    int below = 0, above = 0, early = 0, beyond = 0, late = 0;
    double latest = 0;
    for (int i = 0; i < 3000; ++i) {
        const Pair pair = pairs.next();
        Profile profile;
        pair.make(profile);
        const double edge = number(profile.edge()), border = pair.border();
        for (int k = 0; k < 60; ++k) {
            const double b = pair.most() * pairs.between(-1, 1);
            Real place;
            if (!profile.place(real(b), place))
                continue;
            if (b < edge) {
                ++below;
                early += number(place) < border - 0.002;
            } else {
                ++above;
                beyond += number(place) > border;
                late += number(place) > border + 0.06;
                latest = std::fmax(latest, number(place) - border);
            }
        }
    }
    note("%d below the edge, %d of them within the border; %d above, %d of them beyond it, %d by more than 0.06, up to %.4f", below,
         early, above, beyond, late, latest);
    SAME(early, 0);
    CHECK(beyond < below / 4 && late < 150);
    CHECK(below > 5000 && above > 5000);
}
