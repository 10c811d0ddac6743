// Profile: how far two balls pull each other's seeds. The surface of two is a body of revolution: where a path leaves it
// depends only on the path's angle with the line between the centres. So it is worked out once for both, by steps of that
// angle, and a seed that no third one reaches is placed by looking it up. Takes the place of the report's update loop
// (Section III) for most seeds.
#ifndef FB_PROFILE_H
#define FB_PROFILE_H

#include "math/real.h"

// Fills the table that profiles are made from. Call once before any object is updated.
void makeProfileSteps();

class Profile {
public:
    // From here on until make() it has no places.
    void clear() { depth_ = NOT_MADE; }
    bool made() const { return depth_ != NOT_MADE; }

    // The neighbour's squared distance / squared size is a0 + position (b + position c0) along the paths, b tells them apart,
    // and none has less than `least`. `border`: the position from which on the neighbour is too strong (1..2).
    void make(Real a0, Real c0, Real least, Real border);

    // The place where a path with this b first leaves the surface (1..1.75), within about 0.01 of the field; 1 where the
    // neighbour does not reach it. False: it leaves nowhere, or where the neighbour has nearly all of the field.
    bool place(Real b, Real& position) const
    {
        const int32_t in = top_ - rawFromReal(b);
        if (in >= depth_)
            return false;
        const int32_t fine = in < 0 ? 0 : in >> fine_;
        const Cell& cell = cells_[fine >> 8];
        position = realFromRaw(cell.position + (cell.rise * (fine & 255) >> 8));
        return true;
    }

    // Whether the path is one of those that the neighbour's field only just reaches, or not where they leave the surface.
    bool above(Real b) const { return rawFromReal(b) > top_; }

    // A b at or below that of the border.
    Real edge() const { return edge_; }

private:
    friend struct RideLayout;
    static constexpr int CELLS = 64;
    static constexpr int32_t NOT_MADE = INT32_MIN;  // a depth
    struct Cell {
        int32_t position;  // raw; at its upper end
        int32_t rise;      // to its lower end
    };

    int32_t top_, depth_;  // raw
    int fine_;             // log2 of the 256th of how wide a cell is
    Real edge_;
    Cell cells_[CELLS + 1];
};

#endif
