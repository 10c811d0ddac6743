// Warp: deforms an object's space (Wyvill and others) by taper, twist and bend, each about the object's own y axis. The field
// of a warped object at a point P is the unwarped object's field at the point that the warp moves to P.
//
//     taper A   widths across the axis are multiplied by 1 + A y / h, with y the height, -h..h
//     twist A   the space is turned about the axis, by A degrees from -h to h
//     bend  A   the axis becomes an arc of A degrees from -h to h, curved towards +x, and runs straight on beyond its ends
//
// h is the height of the object's surface above its centre. A bend is limited so that the middle of its circle keeps a distance
// from the axis of at least 1.2 times the greatest half width of the tapered object. The taper is applied first, then the
// twist, then the bend.
#ifndef FB_WARP_H
#define FB_WARP_H

#include "math/vec.h"

enum WarpPart : uint8_t { WARP_TAPER, WARP_TWIST, WARP_BEND };
constexpr int WARP_PARTS = 3;

// The greatest amount of each part, in either direction.
constexpr Real WARP_MOST[WARP_PARTS] = {Real(0.75), Real(360), Real(180)};

// The amounts of all three.
struct WarpAmounts {
    Real part[WARP_PARTS];

    bool operator==(const WarpAmounts& b) const { return part[0] == b.part[0] && part[1] == b.part[1] && part[2] == b.part[2]; }
};
constexpr WarpAmounts NO_WARP{{Real(0), Real(0), Real(0)}};

class Warp {
public:
    // Sets the warp for an object whose surface, field and steep part of the field reach the given distances from the centre
    // along each axis. All lengths are in the same unit; products of them must fit a Real. A bend that would carry the surface
    // beyond the middle of the circle is reduced.
    void set(const WarpAmounts& amounts, const Vector& surface, const Vector& field, const Vector& steep);

    // The amounts as asked for, and as limited.
    const WarpAmounts& asked() const { return asked_; }
    const WarpAmounts& amounts() const { return amounts_; }
    Real height() const { return height_; }

    // One point before and after the warp, with the values that depend on its height only.
    struct Way {
        Vector plain, twisted;    // the point before the warp, and before the bend
        Real y{-30000};           // the height before the bend for which the following values hold
        Real width;                // factor of the taper
        Real turnSine, turnCosine;  // of the angle of the twist
        Real sine, cosine;        // of the angle of the bend
        Real middle[2];           // x and y of the point of the axis, after the bend
        Real beyond;              // the part of the height that lies beyond the ends of the bend
        Real squeeze;             // factor by which the bend shortens lengths along the axis here; 1 beyond its ends
    };

    // The warp: returns the place to which it moves a point. Reusing `way` is quicker for points of the same height.
    Vector out(const Vector& place, Way& way) const;
    // The inverse warp: sets way.plain to the point that the warp moves to `place`.
    void back(const Vector& place, Way& way) const;

    // The distance of a place from a box that contains the warped field; 0 or less inside the box.
    Real outside(const Vector& place) const
    {
        const Real x = flipped_ ? -place.x : place.x;
        return ::max(::max(-x - field_.x, x - inward_), ::max(absolute(place.y) - field_.y, absolute(place.z) - field_.z));
    }

    // With `way` from the latest out() or back(): the image of a small step from way.plain, and the gradient of a function
    // after the warp, from its gradient at way.plain.
    Vector stepOut(const Way& way, const Vector& step) const;
    Vector slopeOut(const Way& way, const Vector& slope) const;

    // The warp multiplies every distance by least() or more, and distances from the centre by most() or less.
    Real least() const { return least_; }
    Real most() const { return most_; }
    // Like least(), for distances within the steep part of the field.
    Real leastSteep() const { return leastSteep_; }

private:
    Real leastWithin(Real wide) const;
    void turnAt(Real y, Way& way) const;
    void unbend(Real& across, Real& up, Way& way) const;
    bool within(Real y) const { return y > -height_ && y < height_; }

    WarpAmounts asked_ = NO_WARP, amounts_ = NO_WARP;
    Real height_{1};
    Real slope_{0};    // taper per unit of height
    Real twist_{0};    // twist, radians per unit of height
    Real bend_{0};     // curvature of the bend, 1 / radius_; never below 0
    Real radius_{0};   // of the bend's circle
    Real end_{0};      // half the angle of the bend, radians
    Real endSine_{0}, endCosine_{1}, endAcross_{0}, endUp_{0};  // sine and cosine of end_; x and y of the upper end of the axis
    Vector field_{Real(0), Real(0), Real(0)};  // half extents of the warped field
    Real inward_{0};                           // extent of the warped field towards the middle of the bend's circle
    bool flipped_ = false;  // the bend is towards -x
    Real least_{1}, leastSteep_{1}, most_{1};
};

#endif
