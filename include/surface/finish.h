// Finish and pattern: what a place of a painted surface (model/paint.h) shows. Both are told in axes of the caller's choice.
#ifndef FB_FINISH_H
#define FB_FINISH_H

#include "math/normal.h"
#include "math/whole.h"
#include "model/paint.h"
#include "model/softobj.h"
#include "surface/voxel.h"

// The brightness of finishes.
class Polish {
public:
    // The directions of the light, of sight and upwards in the world. All are unit vectors, 1.0 = 2^14.
    Polish(const int32_t light[3], const int32_t ahead[3], const int32_t up[3]);

    // Brightness of a surface with this finish where it has this normal, 0..63.
    int brightness(Finish finish, const Normal& normal) const
    {
        if (finish == FINISH_MATT)
            return max32(lambert(componentAlong(normal, light_)), 0);
        return (brightness8(finish, normal) + 128) >> 8;
    }
    // The same with 8 fraction bits, for a finish that shines.
    int32_t brightness8(Finish finish, const Normal& normal) const;

private:
    int32_t light_[3], ahead_[3], up_[3];
    int32_t half_[3];   // half way between light and viewer
    int32_t upAhead_;   // how far upwards the viewer looks: cosine, 1.0 = 2^14
};

// Where the pattern of a painted object lies. Places are measured in grains, along the axes of the object, from its centre. Without
// a pattern all places have the object's own colour.
class PatternMap {
public:
    // For places in the axes of the world.
    explicit PatternMap(const SoftObject& object);
    // For places in the own space of another object, or of the same.
    PatternMap(const SoftObject& object, const SoftObject& seenBy);

    // The place in grains of one given from the object's centre, in units.
    void toGrains(const Vector& place, Real grains[3]) const;
    // The number of the colour at a place, if `mix` is that of the object's colour there without a pattern.
    uint8_t numberAt(const Real grains[3], uint8_t mix) const;

    // Along how many axes there are edges between the two colours: at each whole grain. Marble has none.
    int edgedAxes() const;
    const Vector& axis(int i) const { return axis_[i]; }
    // The length of a grain, units of the world.
    Real grain() const { return grain_; }

private:
    const Paint& paint_;
    Vector axis_[3];       // unit vectors
    Real grain_, inverse_; // the latter in the unit of the places
};

#endif
