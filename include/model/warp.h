// Warp: what bends an object's space (Wyvill and others): taper, twist and bend, each about the object's own y axis. The field
// of a warped object at a point is what it is without at the point that the warp brings there.
//
//     taper A   across the axis all is 1 + A y / h as wide, with y the height, -h..h
//     twist A   turned about the axis by A degrees from -h to h
//     bend  A   the axis becomes part of a circle, A degrees from -h to h, and leaves it straight beyond; towards +x
//
// h is the height of the object's surface above its centre. No bend brings the middle of its circle nearer to the axis than a
// fifth more than the object is wide. A taper comes first, then a twist, then a bend.
#ifndef FB_WARP_H
#define FB_WARP_H

#include "math/vec.h"

enum WarpPart : uint8_t { WARP_TAPER, WARP_TWIST, WARP_BEND };
constexpr int WARP_PARTS = 3;

// The greatest amount of each, to either side.
constexpr Real WARP_MOST[WARP_PARTS] = {Real(0.75), Real(360), Real(180)};

// The amounts of all three.
struct WarpAmounts {
    Real part[WARP_PARTS];

    bool operator==(const WarpAmounts& b) const { return part[0] == b.part[0] && part[1] == b.part[1] && part[2] == b.part[2]; }
};
constexpr WarpAmounts NO_WARP{{Real(0), Real(0), Real(0)}};

class Warp {
public:
    // For an object whose surface, whose field and what of that is steep reach so far from the centre along each axis. All lengths
    // are in the same units, any that keep products in range. What would bend the surface beyond the middle of the circle is less.
    void set(const WarpAmounts& amounts, const Vector& surface, const Vector& field, const Vector& steep);

    // As asked for, and as they are.
    const WarpAmounts& asked() const { return asked_; }
    const WarpAmounts& amounts() const { return amounts_; }
    Real height() const { return height_; }

    // A place, before and after, and what is the same for all of a height.
    struct Way {
        Vector plain, twisted;    // before all, and before the bend
        Real y{-30000};           // height that the rest holds for, before the bend
        Real width;                // by the taper
        Real turnSine, turnCosine;  // of the twist
        Real sine, cosine;        // of the bend
        Real middle[2];           // where the bend brings the axis, x and y
        Real beyond;              // what of the height lies beyond the ends of the bend
        Real squeeze;             // by how much the bend shortens what lies along the axis there; 1 beyond its ends
    };

    // Where the warp brings a place. A way may be used again, quicker for places of one height.
    Vector out(const Vector& place, Way& way) const;
    // From where the warp brought a place: Way::plain.
    void back(const Vector& place, Way& way) const;

    // How far a place lies outside a box that holds the field, once warped; 0 and less: inside.
    Real outside(const Vector& place) const
    {
        const Real x = flipped_ ? -place.x : place.x;
        return ::max(::max(-x - field_.x, x - inward_), ::max(absolute(place.y) - field_.y, absolute(place.z) - field_.z));
    }

    // Of the way gone last: what becomes of a small step from Way::plain; and the gradient of a function, from what it is there.
    Vector stepOut(const Way& way, const Vector& step) const;
    Vector slopeOut(const Way& way, const Vector& slope) const;

    // No distance becomes smaller than this share of itself, and none from the centre larger than that.
    Real least() const { return least_; }
    Real most() const { return most_; }
    // The same as least() of distances where the field is steep.
    Real leastSteep() const { return leastSteep_; }

private:
    Real leastWithin(Real wide) const;
    void turnAt(Real y, Way& way) const;
    void unbend(Real& across, Real& up, Way& way) const;
    bool within(Real y) const { return y > -height_ && y < height_; }

    WarpAmounts asked_ = NO_WARP, amounts_ = NO_WARP;
    Real height_{1};
    Real slope_{0};    // of the taper
    Real twist_{0};    // radians in a unit of height
    Real bend_{0};     // curvature, one over a length; never below 0
    Real radius_{0};   // of the circle
    Real end_{0};      // half of the bend, radians
    Real endSine_{0}, endCosine_{1}, endAcross_{0}, endUp_{0};  // and where it brings the ends of the axis
    Vector field_{Real(0), Real(0), Real(0)};  // how far the field reaches, once warped
    Real inward_{0};                           // and along x, to where it is bent
    bool flipped_ = false;  // it bends towards -x
    Real least_{1}, leastSteep_{1}, most_{1};
};

#endif
