// The report's own methods, as printed (Section III, Algorithms and Optimizations): linear interpolation with slope -1,
// the sum of all fields for every guess, normals from three samples. They are kept for comparison (/P); the engine finds the same
// surface with less work.
#include "math/alloc.h"
#include "model/softobj.h"
#include "model/stop.h"
#include "surface/engine.h"
#include "surface/voxel.h"

namespace {

// The report's tolerances. It names them without figures; these figures are ours. Fields and positions have no unit.
constexpr Real LOCATION_TOLERANCE(0.00004);  // field: "desired accuracy"
constexpr int ITERATION_LIMIT = 32;
constexpr Real FARTHEST(32);                 // position: at the limit none farther away is kept, or it would leave 16.16 one day;
constexpr Real OUTERMOST(5000);              // units: nor one on a long path that leads farther than this
constexpr Real NOWHERE(0.05);                // field: a path that ends farther from the isovalue may have no surface
constexpr Real BACK_FACE(-0.43);             // cosine of path and direction to the viewer, below which a seed is skipped
constexpr Real DISPLACEMENT(0.001);          // position: a seed that moves by less is taken as not moved
constexpr Real DEFORMITY(0.01);              // position: nearer to 1 than this, the path is taken as the normal
constexpr Real OVERSHOOT(0.05);              // field: by how much a neighbour may be stronger than the own object
constexpr Real OVERSAMPLE(0.05);             // difference of two seeds' positions that activates the seed between them
constexpr Real SAMPLE_DISTANCE(0.5);         // units: distance of the three samples for a normal from the seed
constexpr Real SCALE(0.75);                  // half extent of a scale, in spacings
constexpr Real MAGNIFICATION(2.0);           // growth of a scale with |position - 1|

// The most neighbours that one object can blend with at a time; further ones are left out.
constexpr int NEAR_MAX = 63;

class Report98 : public Surface {
public:
    explicit Report98(SoftObject& object) : object_(object) {}
    ~Report98() override { free(kept_); }
    bool open();

    bool update(const FrameContext& frame) override;
    void draw(const FrameContext& frame, VoxelList& list, int room, int* next) override;

private:
    // The data kept of a seed from frame to frame: "all seed position values, spatial locations and surface normals".
    struct Kept {
        Vector path;  // the seed's path, turned as the object is
        Vector out;   // normal of the unblended surface there, as long as the radius: the path itself, unless the object is shaped
        Point point;
        Vector normal;
        uint8_t brightness;
    };

    int findNear(Link* near) const;
    void pose();
    void settle(int i, const FrameContext& frame, const Vector& toEye, const Link* near, int nearCount);
    bool faces(Seed& s, const Vector& out, const Vector& toEye) const;
    bool search(const Seed& s, const Point& root, const Vector& path, const FrameContext& frame, const Link* near, int nearCount,
                Real* position) const;
    void store(Seed& s, const Point& root, bool found, Real position, Kept& kept);
    Point rootPoint(const Seed& s) const { return object_.toWorld(object_.root(s.root)); }

    SoftObject& object_;
    Kept* kept_ = nullptr;
    bool displaced_ = false;
    Real step_{1};
};

// "Brightness proportional to the angle" of normal and light, 0..63, from the cosine of that angle.
uint8_t brightness(Real cosine)
{
    const int step = floorToInt(cosine * Real(BRIGHTEST) + Real(0.5));
    return static_cast<uint8_t>(step < 0 ? 0 : step > BRIGHTEST ? BRIGHTEST : step);
}

bool Report98::open()
{
    const int slots = object_.seedSlots();
    kept_ = allocate<Kept>(static_cast<uint32_t>(slots));
    if (kept_ == nullptr || !object_.layOutExtras())
        return false;
    memset(static_cast<void*>(kept_), 0, sizeof(Kept) * static_cast<size_t>(slots));
    for (int i = 0; i < slots; ++i)
        object_.seed(i).flags = SEED_VALID;
    return true;
}

// "Rotate all seed roots about the center of rotation, apply the same rotation to all path vectors."
void Report98::pose()
{
    for (int i = 0; i < object_.seedSlots(); ++i) {
        Seed& s = object_.seed(i);
        const Vector path = object_.toWorld(s.path) - object_.centre();
        // A seed that turns with its object has moved, although its position on the path is the same.
        if (!(path == kept_[i].path))
            s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
        kept_[i].path = kept_[i].out = path;
        if (object_.shaped())
            kept_[i].out = withLength(object_.toWorld(object_.slopeAt(object_.root(s.root) + s.path)) - object_.centre(),
                                      object_.radius());
    }
}

// Finds the neighbours close enough to matter, once at the start of an update cycle. Objects that dig into this one get a weight
// below 0; the report has no such weights.
int Report98::findNear(Link* near) const
{
    int count = 0;
    for (const List<Link>::Node* node = object_.skel().first(); node != nullptr && count < NEAR_MAX; node = node->next) {
        if (object_.inRange(*node->item.object))
            near[count++] = node->item;
    }
    for (const List<Link>::Node* node = object_.dents().first(); node != nullptr && count < NEAR_MAX; node = node->next) {
        if (object_.inRange(*node->item.object))
            near[count++] = {node->item.object, -node->item.weight};
    }
    return count;
}

bool Report98::update(const FrameContext& frame)
{
    if (!object_.hasSurface())
        return false;
    pose();
    Link near[NEAR_MAX];
    const int nearCount = findNear(near);
    const Vector toEye = unit(frame.eye - object_.centre());
    displaced_ = false;
    // The report's slope is that of its own fields. Fields of greater strength are steeper, and digging ones make the sum steeper.
    Real steep = object_.strength();
    for (int n = 0; n < nearCount; ++n)
        steep += max(Real(0), -near[n].weight) * near[n].object->strength();
    step_ = steep > Real(1) ? Real(1) / steep : Real(1);
    // "The regular seeds at even positions in an array, and the corresponding extra samples at the following odd
    // position. The index in the update loop is incremented by one or two depending on the status of the extra seed."
    for (int i = 0; i < object_.seedSlots(); i += 2) {
        const Seed& s = object_.seed(i);
        Seed& extra = object_.seed(i + 1);
        if (i % 64 == 62 && stopAsked())
            return true;
        settle(i, frame, toEye, near, nearCount);
        if (s.neighbour >= 0 && absolute(s.position - object_.seed(s.neighbour).position) > OVERSAMPLE) {
            extra.flags |= SEED_ACTIVE;
            settle(i + 1, frame, toEye, near, nearCount);
        } else {
            extra.flags = SEED_VALID;
            extra.position = s.position;
        }
    }
    object_.setDisplaced(displaced_);
    return false;
}

void Report98::settle(int i, const FrameContext& frame, const Vector& toEye, const Link* near, int nearCount)
{
    Seed& s = object_.seed(i);
    if (!faces(s, kept_[i].out, toEye))
        return;
    const Point root = rootPoint(s);
    Real position;
    const bool found = search(s, root, kept_[i].path, frame, near, nearCount, &position);
    store(s, root, found, position, kept_[i]);
}

// "Seeds whose paths point nearly away from the viewer [...] are assumed to be invisible."
inline bool Report98::faces(Seed& s, const Vector& out, const Vector& toEye) const
{
    const bool front = dot(out, toEye) >= BACK_FACE * object_.radius();
    s.flags = static_cast<uint8_t>(front ? s.flags | SEED_FRONT : s.flags & ~SEED_FRONT);
    return front;
}

// Searches the surface along the path of a seed. Returns false if a neighbour is stronger there, or the path has no surface.
inline bool Report98::search(const Seed& s, const Point& root, const Vector& path, const FrameContext& frame, const Link* near,
                             int nearCount, Real* position) const
{
    // "If the seed was valid before, use its last position", else "a reliable starting position".
    *position = s.flags & SEED_VALID ? s.position : Real(1);
    bool highest;
    Real difference;
    int iterations = 0;
    do {
        const Point point = root + path * *position;
        const Real own = object_.fieldFunc(point);
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
        // The slope is taken as -1, or as -1 / step_ where fields are steeper than the report's.
        if (difference > LOCATION_TOLERANCE)
            *position -= (ISOVALUE - field) * step_;
    } while (highest && difference > LOCATION_TOLERANCE && iterations < ITERATION_LIMIT);

    ++frame.counts->updated;
    frame.counts->iterations += static_cast<uint32_t>(iterations);
    if (highest && difference > LOCATION_TOLERANCE) {
        ++frame.counts->unsettled;
        // The path of a weak object, or of one that something digs into, may have no surface.
        highest = difference < NOWHERE || (object_.rests() && object_.dents().empty());
        // Beyond the core there is no field, and each step leads farther on.
        const Real farthest = min(FARTHEST, quotient(OUTERMOST, object_.longestPath()));
        *position = clamp(*position, -farthest, farthest);
    }
    return highest;
}

// Stores the result of a search. "If they have not moved by a certain minimum amount between frames, they are assumed not to have
// moved."
inline void Report98::store(Seed& s, const Point& root, bool found, Real position, Kept& kept)
{
    const bool wasValid = (s.flags & SEED_VALID) != 0;
    s.flags = static_cast<uint8_t>(found ? s.flags | SEED_VALID : s.flags & ~SEED_VALID);
    if (!wasValid || absolute(position - s.position) >= DISPLACEMENT) {
        s.position = position;
        s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
    }
    kept.point = root + kept.path * s.position;
    if (!found || absolute(s.position - Real(1)) >= DEFORMITY)
        displaced_ = true;
}

void Report98::draw(const FrameContext& frame, VoxelList& list, int room, int* next)
{
    list.begin(frame.inView(object_.centre()), object_.reach(), object_.ramp());
    const Real inverseRadius = Real(1) / object_.radius();
    Link near[NEAR_MAX];
    const int nearCount = findNear(near);
    const auto sum = [&](const Point& p) {
        Real field = object_.fieldFunc(p);
        for (int n = 0; n < nearCount; ++n)
            field += near[n].object->fieldFunc(p) * near[n].weight;
        return field;
    };
    int i = object_.hasSurface() ? *next : object_.seedSlots();
    for (; i < object_.seedSlots() && list.count < room; ++i) {
        Seed& s = object_.seed(i);
        if ((i & 1) != 0 && !(s.flags & SEED_ACTIVE))
            continue;
        if ((s.flags & (SEED_VALID | SEED_FRONT)) != (SEED_VALID | SEED_FRONT))
            continue;
        Kept& kept = kept_[i];
        const Real deformity = absolute(s.position - Real(1));
        if (deformity < DEFORMITY) {
            // "If the surface deformity is below a certain tolerance then the surface normal for a seed has the same
            // direction as that seed's path and need not be calculated."
            kept.brightness = brightness(dot(kept.out, frame.light) * inverseRadius);
            s.flags = static_cast<uint8_t>(s.flags & ~SEED_KEPT);
        } else if (!(s.flags & SEED_KEPT)) {
            // "Three additional samples, each displaced from the seed by a fixed distance along the X, Y and Z axes."
            const Point& p = kept.point;
            const Real d = SAMPLE_DISTANCE;
            kept.normal = unit({ISOVALUE - sum({p.x + d, p.y, p.z}), ISOVALUE - sum({p.x, p.y + d, p.z}),
                                ISOVALUE - sum({p.x, p.y, p.z + d})});
            kept.brightness = brightness(dot(kept.normal, frame.light));
            s.flags |= SEED_KEPT;
            ++frame.counts->normals;
            frame.counts->samples += 3;
        }
        // Dynamic scale magnification: larger where the surface is deformed.
        const Real half = object_.spacing() * SCALE * (Real(1) + deformity * MAGNIFICATION);
        const int32_t extent = rawFromReal(half) >> 8;
        Voxel& v = *list.room();
        v = {};  // the report's scales face the viewer, and each has one brightness
        v.brightness = kept.brightness;
        const Vector place = frame.axes.fromWorld(kept.point - object_.centre());
        v.x = rawFromReal(place.x) >> 8;
        v.y = rawFromReal(place.y) >> 8;
        v.z = rawFromReal(place.z) >> 8;
        v.halfWidth = v.halfHeight = static_cast<int16_t>(extent > INT16_MAX ? INT16_MAX : extent);
        list.take();
    }
    *next = i < object_.seedSlots() ? i : 0;
}

}  // namespace

Surface* makeReport98(SoftObject& object)
{
    Report98* const report = make<Report98>(object);
    if (report != nullptr && !report->open()) {
        destroy(report);
        return nullptr;
    }
    return report;
}
