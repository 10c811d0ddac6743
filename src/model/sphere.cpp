// Seeds on a sphere: a stack of rings, each ring a row of seeds (report, Appendix C, Figure 8).
#include "model/sphere.h"

#include "model/stop.h"
#include "model/round.h"

namespace {
constexpr int64_t PI_16 = 205887;       // pi, 16 fraction bits
constexpr int64_t TWO_PI_16 = 411775;
constexpr int FEWEST_IN_RING = 4;
}

int ringCount(Real radius, Real spacing)
{
    const uint64_t half = static_cast<uint64_t>((rawFromReal(radius) * PI_16) >> 16);
    const uint32_t gap = static_cast<uint32_t>(rawFromReal(spacing));
    return static_cast<int>(divide64(half + gap - 1, gap));
}

int seedsInRing(Real radius, Real spacing, int32_t cosine30)
{
    const int64_t ring = (static_cast<int64_t>(rawFromReal(radius)) * cosine30) >> 30;
    const uint64_t around = static_cast<uint64_t>((ring * TWO_PI_16) >> 16);
    const int count = static_cast<int>(divide64(around, static_cast<uint32_t>(rawFromReal(spacing))));
    return count < FEWEST_IN_RING ? FEWEST_IN_RING : count;
}

namespace {

// Passes seeds on with their axes permuted, so that the y axis of the rings becomes another axis of the object.
class Tilted : public SeedMaker {
public:
    Tilted(SeedMaker& maker, int turns) : maker_(maker), turns_(turns) {}

    static Vector tilt(const Vector& v, int turns)
    {
        return turns == 0 ? v : turns == 1 ? Vector{v.z, v.x, v.y} : Vector{v.y, v.z, v.x};
    }
    int addRoot(const Vector& fromCentre) override { return maker_.addRoot(tilt(fromCentre, turns_)); }
    void beginRing() override { maker_.beginRing(); }
    void addSeed(int root, const Vector& direction, const Vector& along, const Vector& across) override
    {
        maker_.addSeed(root, tilt(direction, turns_), tilt(along, turns_), tilt(across, turns_));
    }

private:
    SeedMaker& maker_;
    int turns_;
};

}  // namespace

// Lays out an ellipsoid: its rings go about that axis about which the stretch is most nearly round.
static void layOutEllipsoid(SeedMaker& maker, const Vector& stretch, Real radius, Real spacing)
{
    int best = 0;
    Real least(1000);
    for (int turns = 0; turns < 3; ++turns) {
        // The stretch in the axes of the rings: permuted back.
        const Vector v = Tilted::tilt(stretch, (3 - turns) % 3);
        const Real uneven = max(v.x, v.z) / ::min(v.x, v.z);
        if (uneven < least) {
            least = uneven;
            best = turns;
        }
    }
    Tilted tilted(maker, best);
    layOutCapsule(tilted, Tilted::tilt(stretch, (3 - best) % 3), radius, Real(0), spacing);
}

void Sphere::layOutSeeds(SeedMaker& maker, Real spacing) const
{
    if (stretched()) {
        layOutEllipsoid(maker, stretch(), radius(), spacing);
        return;
    }
    const int root = maker.addRoot({Real(0), Real(0), Real(0)});
    const int rings = ringCount(radius(), spacing);
    // Half the distance between two rings: pi radius / rings / 2.
    const Real across = radius() * realFromRaw(static_cast<int32_t>(PI_16)) / Real(2 * rings);
    const uint32_t latitudeStep = QUARTER / static_cast<uint32_t>(rings);
    for (int k = 0; k < rings && !stopAsked(); ++k) {
        // -pi/2 + pi (k + 1/2) / rings
        const Angle latitude = static_cast<uint32_t>(2 * k + 1) * latitudeStep - QUARTER;
        const int count = seedsInRing(radius(), spacing, cosine30(latitude));
        maker.beginRing();
        if (maker.countRing(count, false))
            continue;
        const Real sinLatitude = sine(latitude), cosLatitude = cosine(latitude);
        const Real along = radius() * cosLatitude * realFromRaw(static_cast<int32_t>(PI_16)) / Real(count);
        const uint32_t step = 0xffffffffu / static_cast<uint32_t>(count);
        for (int i = 0; i < count; ++i) {
            const Angle longitude = static_cast<uint32_t>(i) * step;
            const Real s = sine(longitude), c = cosine(longitude);
            maker.addSeed(root, {cosLatitude * s, sinLatitude, cosLatitude * c}, {along * c, Real(0), -(along * s)},
                          {-(across * sinLatitude * s), across * cosLatitude, -(across * sinLatitude * c)});
        }
    }
}

void Sphere::describe(char* to, int size) const
{
    const Real numbers[] = {centre().x, centre().y, centre().z, this->size()};
    describeAs("sphere", numbers, 4, to, size);
}
