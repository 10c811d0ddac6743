// The limb: where a surface bends out of sight. A scale next to it ends at the outline, which is a curve across the view.
#ifndef FB_LIMB_H
#define FB_LIMB_H

#include "patch.h"
#include "surface/voxel.h"

// Where rays of sight only touch a surface that bends by S over a step. The ray that meets it in a seed with the normal n leads w
// over a unit of depth, and c = -n w there. A step e across the view from that ray leads to one that meets the surface as long as
// c^2 / 2k - (n (1 + c / kz) + c s / k) e - e H e / 2 is not below 0, with s = S w, k = w s, H = S - s s / k, and z the depth.
struct Limb {
    int32_t radius;    // 1 / k, 1/256 unit
    int32_t nearness;  // 1 / kz, 1.0 = 2^14
    int32_t along[2];  // s / k across the view, 1.0 = 2^14
    int32_t curve[3];  // H across the view, along x, along both, along y: per unit, 1.0 = 2^13
    int32_t curveMost; // none of these is more, but for its sign
};

// The limb of a ball, `radius` in 1/256 unit, and of what bends as a patch does that has been measured; `step` is a step of places
// (voxels.h) in 1/256 unit of the world, 16 bits of fraction. The ray of sight leads (shearX, shearY) aside over a unit of depth,
// 10 bits of fraction, and the seeds are `depth` away, 1/256 unit. False: along the ray the surface hardly bends, or to the viewer.
bool findLimb(int32_t radius, int32_t shearX, int32_t shearY, int32_t depth, Limb* limb);
bool findLimb(const Bend& bend, const OwnFrame& own, int32_t step, int32_t shearX, int32_t shearY, int32_t depth, Limb* limb);

// Ends a voxel, uncut, at the limb. `cosine` is c, 1.0 = 2^14, and the voxel becomes larger by `more` to each side, 1/256 unit:
// there may be no other that covers what lies before the limb.
void endAtLimb(const Limb& limb, int32_t cosine, int32_t more, Voxel* voxel);

#endif
