// The limb: where a surface bends out of sight. A scale next to it ends at the outline, which is a curve across the view.
#ifndef FB_LIMB_H
#define FB_LIMB_H

#include "patch.h"
#include "surface/voxel.h"

// Where rays of sight only touch a surface. Near a seed with the normal n the surface is where n x + x S x / 2 = 0, for S says how
// it bends. A ray of sight that passes by the seed, a step e across the view from it, is e + t w, with w its way over a unit of
// depth. Put into the first equation that is a quadratic one in t, and the ray meets the surface as long as it has a root. With
// c = -n w, s = S w, k = w s, H = S - s s / k and z the depth of the seed, its discriminant over 2k is
//
//     c^2 / 2k  -  (n (1 + c / kz) + c s / k) e  -  e H e / 2
//
// where the term with z is what w changes by from ray to ray, which is left out of H. The scale ends where this is 0.
struct Limb {
    int32_t radius;    // 1 / k, 1/256 unit
    int32_t nearness;  // 1 / kz, 1.0 = 2^14
    int32_t along[2];  // s / k across the view, 1.0 = 2^14
    int8_t curve[3];   // -H across the view, along x, along both, along y, as Voxel::curveXX, curveXY and curveYY
};

// The limb of a ball, whose radius is 1 / `bend`, per unit, 1.0 = 2^14, to 2.0; and of what bends as a patch does that has been
// measured, where `step` is a step of places (voxels.h) in 1/256 unit of the world, 16 bits of fraction. The ray of sight leads
// (shearX, shearY) aside over a unit of depth, 10 bits of fraction, and the seeds are `depth` away, 1/256 unit. False: along the
// ray the surface hardly bends, or to the viewer.
bool findLimb(int32_t bend, int32_t shearX, int32_t shearY, int32_t depth, Limb* limb);
bool findLimb(const Bend& bend, const OwnFrame& own, int32_t step, int32_t shearX, int32_t shearY, int32_t depth, Limb* limb);

// Ends a voxel, uncut, at the limb. `cosine` is c, 1.0 = 2^14. The voxel becomes larger by `more` to each side, 1/256 unit, for
// there may be no other that covers what lies before the limb.
void endAtLimb(const Limb& limb, int32_t cosine, int32_t more, Voxel* voxel);

#endif
