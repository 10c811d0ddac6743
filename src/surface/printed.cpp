// The report's own methods, as printed (Section III, Algorithms and Optimizations): linear interpolation with slope -1,
// the whole field sum for every guess, normals from three samples. Kept for comparison (/P); settle.cpp finds the same
// surface with less work.
#include "math/alloc.h"
#include "model/softobj.h"

using namespace printed;

// The neighbours close enough to matter, tested once at the start of an update cycle.
int SoftObject::findNear(Link* near) const
{
    int count = 0;
    for (const List<Link>::Node* node = skel_.first(); node != nullptr && count < NEAR_MOST; node = node->next) {
        if (inRange(*node->item.object))
            near[count++] = node->item;
    }
    return count;
}

void SoftObject::updatePrinted(const Look& look)
{
    if (kept_ == nullptr) {
        kept_ = allocate<Kept>(static_cast<uint32_t>(2 * regular_));
        if (kept_ == nullptr)
            return;
        memset(static_cast<void*>(kept_), 0, sizeof(Kept) * static_cast<size_t>(2 * regular_));
        for (int i = 0; i < 2 * regular_; ++i)
            seeds_[i].flags = SEED_VALID;
    }
    poseAll();
    Link near[NEAR_MOST];
    const int nearCount = findNear(near);
    const Vector toEye = unit(look.eye - centre_);
    displaced_ = false;
    // "The regular seeds at even positions in an array, and the corresponding extra samples at the following odd
    // position. The index in the update loop is incremented by one or two depending on the status of the extra seed."
    for (int i = 0; i < 2 * regular_; i += 2) {
        const Seed& s = seeds_[i];
        Seed& extra = seeds_[i + 1];
        settlePrinted(i, look, toEye, near, nearCount);
        if (s.neighbour >= 0 && absolute(s.position - seeds_[s.neighbour].position) > OVERSAMPLE) {
            extra.flags |= SEED_ACTIVE;
            settlePrinted(i + 1, look, toEye, near, nearCount);
        } else {
            extra.flags = SEED_VALID;
            extra.position = s.position;
        }
    }
}

void SoftObject::settlePrinted(int i, const Look& look, const Vector& toEye, const Link* near, int nearCount)
{
    Seed& s = seeds_[i];
    const Point root = roots_[s.root];

    // "Seeds whose paths point nearly away from the viewer [...] are assumed to be invisible."
    const bool front = dot(s.path, toEye) >= BACK_FACE * radius_;
    s.flags = static_cast<uint8_t>(front ? s.flags | SEED_FRONT : s.flags & ~SEED_FRONT);
    if (!front)
        return;

    // "If the seed was valid before, use its last position", else "a reliable starting position".
    Real position = s.flags & SEED_VALID ? s.position : Real(1);
    Point point = root + s.path * position;
    bool highest;
    Real difference;
    int iterations = 0;
    do {
        const Real own = fieldFunc(point);
        Real field = own;
        highest = true;
        for (int n = 0; n < nearCount; ++n) {
            const Real part = near[n].object->fieldFunc(point) * near[n].weight;
            field += part;
            if (part > own + OVERSHOOT)
                highest = false;
        }
        ++iterations;
        difference = absolute(field - ISOVALUE);
        if (difference > LOCATION_TOLERANCE) {
            position -= ISOVALUE - field;  // the slope is taken as -1
            point = root + s.path * position;
        }
    } while (highest && difference > LOCATION_TOLERANCE && iterations < ITERATION_LIMIT);

    ++look.counts->updated;
    look.counts->iterations += static_cast<uint32_t>(iterations);
    if (highest && difference > LOCATION_TOLERANCE)
        ++look.counts->unsettled;

    // "If they have not moved by a certain minimum amount between frames, they are assumed not to have moved."
    const bool wasValid = (s.flags & SEED_VALID) != 0;
    s.flags = static_cast<uint8_t>(highest ? s.flags | SEED_VALID : s.flags & ~SEED_VALID);
    if (!wasValid || absolute(position - s.position) >= DISPLACEMENT) {
        s.position = position;
        s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
    }
    kept_[i].point = root + s.path * s.position;
    if (!highest || absolute(s.position - Real(1)) >= DEFORMITY)
        displaced_ = true;
}

void SoftObject::drawPrinted(const Look& look, VoxelList& list, int room, int* next)
{
    list.count = 0;
    if (kept_ == nullptr) {
        *next = 0;
        return;
    }
    Link near[NEAR_MOST];
    const int nearCount = findNear(near);
    const auto sum = [&](const Point& p) {
        Real field = fieldFunc(p);
        for (int n = 0; n < nearCount; ++n)
            field += near[n].object->fieldFunc(p) * near[n].weight;
        return field;
    };
    int i = *next;
    for (; i < 2 * regular_ && list.count < room; ++i) {
        Seed& s = seeds_[i];
        if ((i & 1) != 0 && !(s.flags & SEED_ACTIVE))
            continue;
        if ((s.flags & (SEED_VALID | SEED_FRONT)) != (SEED_VALID | SEED_FRONT))
            continue;
        Kept& kept = kept_[i];
        const Real deformity = absolute(s.position - Real(1));
        if (deformity < DEFORMITY) {
            // "If the surface deformity is below a certain tolerance then the surface normal for a seed has the same
            // direction as that seed's path and need not be calculated."
            s.voxel.brightness = s.restBrightness;
            s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
        } else if (!(s.flags & SEED_KEPT)) {
            // "Three additional samples, each displaced from the seed by a fixed distance along the X, Y and Z axes."
            const Point& p = kept.point;
            const Real d = SAMPLE_DISTANCE;
            kept.normal = unit({ISOVALUE - sum({p.x + d, p.y, p.z}), ISOVALUE - sum({p.x, p.y + d, p.z}),
                                ISOVALUE - sum({p.x, p.y, p.z + d})});
            const int step = floorToInt(dot(kept.normal, look.light) * Real(63) + Real(0.5));
            s.voxel.brightness = static_cast<uint8_t>(step < 0 ? 0 : step > 63 ? 63 : step);
            s.flags |= SEED_KEPT;
            ++look.counts->normals;
            look.counts->samples += 3;
        }
        // Dynamic scale magnification: larger where the surface is deformed.
        const Real half = spacing_ * SCALE * (Real(1) + deformity * MAGNIFICATION);
        const int32_t extent = rawFromReal(half) >> 8;
        Voxel& v = s.voxel;
        const Vector place = kept.point - centre_;
        v.x = rawFromReal(place.x) >> 8;
        v.y = rawFromReal(place.y) >> 8;
        v.z = rawFromReal(place.z) >> 8;
        v.wide = static_cast<int16_t>(extent > INT16_MAX ? INT16_MAX : extent);
        v.high = v.wide;
        v.tiltX = v.tiltY = 0;  // the report's scales face the viewer, and each has one brightness
        v.reach = 0;
        v.slopeX = v.slopeY = 0;
        list.voxels[list.count++] = &v;
    }
    *next = i < 2 * regular_ ? i : 0;
}
