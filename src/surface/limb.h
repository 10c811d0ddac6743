// Limb: the silhouette of a surface, where it bends out of sight. A scale next to the limb ends there, at a curve across the view.
#ifndef FB_LIMB_H
#define FB_LIMB_H

#include "patch.h"
#include "surface/voxel.h"

// At the limb, rays of sight only touch the surface. Near a seed with the normal n the surface is where n x + x S x / 2 = 0; the
// matrix S says how it bends. A ray of sight at a step e across the view from the seed is x = e + t w, where w is the ray's vector
// over a unit of depth. Inserted into the first equation, this gives a quadratic equation for t, and the ray meets the surface if
// that has a root. With c = -n w, s = S w, k = w s, H = S - s s / k and z the depth of the seed, the discriminant over 2k is
//
//     c^2 / 2k  -  (n (1 + c / kz) + c s / k) e  -  e H e / 2
//
// The term with z stands for the change of w from ray to ray, which H leaves out. The scale ends where the discriminant is 0.
struct Limb {
    int32_t radius;    // 1 / k, 1/256 unit
    int32_t nearness;  // 1 / kz, 1.0 = 2^14
    int32_t along[2];  // s / k across the view, 1.0 = 2^14
    int8_t curve[3];   // -H across the view, along x, along both, along y, as Voxel::curveXX, curveXY and curveYY
};

// The products of any two axes of the view, 15 fraction bits, by which a bend is measured along them (turnOf()): x is to the right,
// y up, z ahead. They are the same for all patches of an object.
struct ViewProducts {
    int32_t xx[6], xy[6], yy[6], xz[6], yz[6], zz[6];
};
void findViewProducts(const OwnFrame& own, ViewProducts* axes);

// Find the limb of a ball with the curvature `bend` (1 / radius, per unit, 1.0 = 2^14, at most 2.0), and of a patch whose bend has
// been measured, where `step` is the length of a step of places (voxels.h), 1/256 unit of the world with 16 fraction bits. The ray
// of sight leads (shearX, shearY) aside over a unit of depth, 10 fraction bits, and the seeds are `depth` away, 1/256 unit. Return
// false when along the ray the surface hardly bends, or bends towards the viewer.
bool findLimb(int32_t bend, int32_t shearX, int32_t shearY, int32_t depth, Limb* limb);
bool findLimb(const Bend& bend, const ViewProducts& axes, int32_t step, int32_t shearX, int32_t shearY, int32_t depth,
              Limb* limb);

// Cuts a voxel that ends (Voxel::back), and is not cut yet, at the limb, and sets `back` anew. `cosine` is c, 1.0 = 2^14.
void endAtLimb(const Limb& limb, int32_t cosine, Voxel* voxel);

#endif
