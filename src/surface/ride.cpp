// The seeds of a patch, in C++: what asm/ride.S does, said plainly.
#include "model/field.h"
#include "surface/ride.h"

RideFrame ride;

namespace {

// Nothing to see of this seed until things have moved on by `steps`, 0 or more.
void wait(Seed& s, uint8_t flags, int32_t steps)
{
    s.flags = flags;
    s.wakes = static_cast<int16_t>(ride.later + lesser(steps, WAIT_MOST));
}

const RideNear& touch(int n)
{
    return *reinterpret_cast<const RideNear*>(ride.shade.pulls[n]);
}

// No neighbour reaches it: how long for.
void lieAtRest(Seed& s)
{
    int32_t steps = WAIT_MOST;
    for (const RideNear* near = ride.first; near != nullptr; near = near->next)
        steps = lesser(steps, stepsOf(shiftUp(near->sum, B_SHIFT) - near->touching, near->waitApart));
    s.position = Real(1);
    // One that was at rest before lies as it did; the others are to be laid.
    const bool lies = (s.flags & (SEED_KEPT | SEED_PLACED)) == SEED_KEPT;
    wait(s, lies ? SEED_VALID | SEED_KEPT | (s.flags & SEED_FRONT) : SEED_VALID | SEED_FRONT, steps);
    s.voxel.brightness = s.restBrightness;
}

// See Settler::facesAway(): true, and it waits.
bool facesAway(Seed& s, int32_t along)
{
    const Real across = realFromRaw(along >> 14 << 11);
    const Real share = across * ride.awayShare;
    for (int n = ride.shade.count - 1; n >= 0; --n) {
        const RideNear& near = touch(n);
        Real term = share - ride.b[n] * near.halfSquare;
        if (term > Real(0))
            term += term;  // POSITION_MOST / PLACED_LEAST, rounded up
        const Real beyond = near.awayLimit - term;
        if (beyond <= Real(0))
            return false;
        ride.beyond[n] = beyond;
    }
    int32_t steps = stepsOf(ride.awayEdge - across, Real(AWAY_MOST), ride.waitAlong);
    for (int n = ride.shade.count - 1; n >= 0; --n)
        steps = lesser(steps, stepsOf(ride.beyond[n], Real(AWAY_MOST), touch(n).waitAway));
    // Half of it is sure whatever they do.
    const int32_t counted = 2 * ride.paceSteps;
    if (steps > counted)
        steps = steps < 2 * counted ? counted : steps >> 1;
    // Where it is held to be does not matter; should it come round again it is looked for from there.
    wait(s, s.flags & SEED_VALID ? SEED_VALID | SEED_PLACED : s.flags & SEED_PLACED, steps);
    return true;
}

// It has settled; `beyond`: where a neighbour is stronger than it.
void shade(Seed& s, Real position, bool beyond)
{
    const int32_t facing = shadeSeed(&ride.shade, &s, position, beyond ? OVER_BACK : 0);
    if (facing > 0) {
        ++ride.normals;
        s.flags = SEED_VALID | SEED_PLACED | SEED_KEPT | SEED_FRONT;
        ride.shaded = &s;
        ride.facing = facing;
        return;
    }
    int32_t waitFacing = INT32_MAX;
    for (int n = 0; n < ride.shade.count; ++n)
        waitFacing = lesser(waitFacing, touch(n).waitFacing);
    wait(s, SEED_VALID | SEED_PLACED, mulShift16(-facing, waitFacing));
}

// One neighbour alone reaches it.
void settleBetween(Seed& s)
{
    RideNear& near = const_cast<RideNear&>(touch(0));
    const Real b = ride.b[0];
    ++ride.placed;
    Real position;
    bool leaves = near.profile->place(b, position);
    if (!leaves && !near.profile->made()) {
        ride.profileFor(&near);
        leaves = near.profile->place(b, position);
    }
    // Farther out it may come near, but the path has left the surface before.
    if (near.profile->above(b) && near.a0 + near.c0 + b >= Real(1))
        position = Real(1);
    if (!leaves || position > ride.placedMost) {
        s.position = leaves ? position : Real(1);
        wait(s, leaves ? SEED_PLACED : 0, stepsOf(most(near.profile->edge() - b, Real(0)), near.waitApart));
        return;
    }
    s.wakes = static_cast<int16_t>(ride.later + 1);
    if ((s.flags & SEED_KEPT) && absolute(position - s.position) <= ride.kept)
        return;
    s.position = position;
    ride.shade.ownSlope = ownQuick(position).slope;
    ride.shade.slopes[0] = ownQuick(position).otherSlope;
    shade(s, position, position > ride.evenMost);
}

// From where it was, after a look there. False: the method does not apply here. Else `position` is the place, and the last
// look's terms are left for the normal.
bool newton(Real& position)
{
    for (int i = 1; i <= LOOK_LIMIT; ++i) {
        if (ride.slope > FLAT)
            return false;
        Real step = quotient(-ride.excess, ride.slope);
        step = clamp(step, -LONGEST_STEP, LONGEST_STEP);
        position += step;
        if (position < PLACED_LEAST || position > POSITION_MOST)
            return false;
        if (absolute(step) <= SHORT_STEP)
            return true;
        if (i < LOOK_LIMIT)
            rideLookC(position);
    }
    ++ride.unsettled;
    return false;
}

void settleAmong(Seed& s)
{
    ++ride.several;
    s.wakes = static_cast<int16_t>(ride.later + 1);
    Real position = s.position;
    if (!(s.flags & (SEED_VALID | SEED_PLACED))) {
        ride.lost(&s, position);
        return;
    }
    rideLookC(position);
    if ((s.flags & SEED_KEPT) && ride.strength <= Real(0) && absolute(ride.excess) <= DISPLACEMENT) {
        if (ride.keptWait)
            ride.stays(&s);
        return;
    }
    if (!newton(position)) {
        ride.lost(&s, Real(1));
        return;
    }
    s.position = position;
    if (ride.strength > Real(0))
        ride.held(&s);
    else
        shade(s, position, ride.strength + ride.overshoot > Real(0));
}

void settle(Seed& s)
{
    // Which neighbours are near enough to matter, or one so near that the seed lies inside anyway?
    int met = 0, apart = 0;
    for (RideNear* near = ride.first; near != nullptr; near = near->next) {
        const Real sum = alongSum(s.path, near->twice);
        if (sum >= near->touchingSum)
            near->sum = sum;
        if (sum >= near->meetingSum)
            continue;
        if (sum < near->buryingSum) {
            s.position = Real(1);
            wait(s, 0, stepsOf(near->burying - shiftUp(sum, B_SHIFT), near->waitBuried));
            return;
        }
        apart += sum >= near->touchingSum;
        ride.b[met] = shiftUp(sum, B_SHIFT);
        ride.shade.pulls[met++] = &near->pull;
    }
    if (met == apart) {
        lieAtRest(s);
        return;
    }
    ride.shade.count = met;
    const int32_t along = ride.shade.eye.along(s);
    if (along < ride.awayAlong) {
        if (facesAway(s, along))
            return;
        const int32_t away = ride.shade.eye.away(along);
        if (away > 0) {
            wait(s, 0, mulShift16(away, ride.waitAway));
            return;
        }
    }
    if (met == 1)
        settleBetween(s);
    else
        settleAmong(s);
}

}  // namespace

int32_t rideReachC(const SeedRun* run)
{
    bool touched = false;
    ride.reached = 0;
    for (RideNear* near = ride.inRange; near != nullptr; near = near->more) {
        const Real sum = alongSum(run->middle, near->twice);
        const Real change = absolute(alongSum(run->half, near->twice)) + scaledProduct(run->wide, near->swing) +
                            shiftDown(RUN_DOUBT, B_SHIFT);
        if (sum + change < near->buryingSum) {
            ride.holds = stepsOf(shiftUp(near->buryingSum - (sum + change), B_SHIFT), near->waitBuried);
            return REACHES_BURYING;
        }
        near->sum = sum - change;
        touched = touched || near->sum < near->touchingSum;
        if (near->sum < near->meetingRunSum)
            ride.reached |= near->bit;
    }
    ride.holds = touched ? RECHECK : WAIT_MOST;
    for (const RideNear* near = ride.inRange; near != nullptr; near = near->more) {
        const Real beyond = near->sum - (touched ? near->meetingRunSum : near->touchingSum);
        if (beyond >= Real(0))
            ride.holds = lesser(ride.holds, stepsOf(shiftUp(beyond, B_SHIFT), near->waitApart));
    }
    return touched ? REACHES_SOME : REACHES_NONE;
}

void rideLookC(Real position)
{
    ++ride.looks;
    const OwnStep& own = ownQuick(position);
    Real field = own.value, steep = own.steep, strongest(0);
    ride.shade.ownSlope = own.slope;
    for (int n = 0; n < ride.shade.count; ++n) {
        const RideNear& near = touch(n);
        const Real c = position * near.c0;
        const Real sum = ride.b[n] + c;
        const Real t = near.a0 + position * sum;
        if (static_cast<uint32_t>(rawFromReal(t)) >= 65536) {
            ride.shade.slopes[n] = Real(0);
            continue;
        }
        const FieldStep& step = geoffQuick(t);
        ride.shade.slopes[n] = step.slope;
        field += step.value;
        steep += step.slope * (sum + c);
        strongest = most(strongest, step.value);
    }
    ride.excess = field - ISOVALUE;
    ride.slope = steep;
    ride.strength = strongest - own.value - ride.overshoot;
}

int32_t rideC(SeedRun* run, Seed* seeds)
{
    return throughSeeds(*run, seeds, settle);
}
