// Tests the graph of objects: links made, weighted and broken at any time, and objects that are created and destroyed.
#include "prims.h"

#include <random>

#include "model/field.h"

namespace {

std::mt19937 chance(77);

int below(int n)
{
    return static_cast<int>(chance() % static_cast<uint32_t>(n));
}

double between(double a, double b)
{
    return std::uniform_real_distribution<double>(a, b)(chance);
}

Point point(double x, double y, double z)
{
    return {real(x), real(y), real(z)};
}

struct Scene {
    Counts counts{};
    Bodies bodies;
    uint8_t ramp[64 + 2 * SHADING_MOST] = {};

    // Draws all objects several times, so that even the seeds that face away (which are updated less often) have been updated.
    void update(const std::vector<SoftObject*>& objects)
    {
        frame(objects);
        for (int turn = 0; turn < 4; ++turn) {
            for (SoftObject* object : objects)
                object->setRecalc();
            frame(objects);
        }
    }

    void frame(const std::vector<SoftObject*>& objects)
    {
        static VoxelList list;
        check(bodies.find(objects.data(), static_cast<int>(objects.size())), "no memory for bodies");
        bodies.spreadRecalc();
        const FrameContext context{{Real(0), Real(0), Real(-120)}, {Real(0), Real(1), Real(0)}, &bodies, &counts};
        for (SoftObject* object : objects)
            object->update(context);
        for (SoftObject* object : objects) {
            object->setRamp(ramp + SHADING_MOST);
            int next = 0;
            do {
                object->draw(context, list, 256, &next);
            } while (next != 0);
        }
    }
};

double weightOf(const SoftObject& of, const SoftObject* seen)
{
    for (const List<Link>::Node* node = of.skel().first(); node != nullptr; node = node->next)
        if (node->item.object == seen)
            return number(node->item.weight);
    return 0;
}

// Returns the field of the body that an object belongs to (see model/body.h).
double bodyField(const Scene& scene, const SoftObject& object, const Point& p)
{
    SoftObject* const* members = scene.bodies.members(object);
    const int count = scene.bodies.memberCount(object);
    double above = 0, below = 0;
    for (int i = 0; i < count; ++i) {
        const double f = number(members[i]->fieldFunc(p));
        if (f <= 0)
            continue;
        double g = f;
        for (int j = 0; j < count; ++j)
            g += weightOf(*members[i], members[j]) * number(members[j]->fieldFunc(p));
        above += f * f * g;
        below += f * f;
    }
    return below > 0 ? above / below : 0;
}

// Counts of the awake seeds of an object: valid and at rest at position 1, moved outwards, and not valid.
struct Tally {
    int rest = 0, moved = 0, gone = 0;
};

Tally tally(const SoftObject& object)
{
    Tally t;
    for (int i = 0; i < object.seedSlots(); i += 2) {
        const Seed& s = object.seed(i);
        if (s.flags & SEED_ASLEEP)
            continue;
        if (!(s.flags & SEED_VALID))
            ++t.gone;
        else if (s.position == Real(1))
            ++t.rest;
        else
            ++t.moved;
    }
    return t;
}

double farthest(const SoftObject& object)
{
    double most = 0;
    for (int i = 0; i < object.seedSlots(); i += 2)
        if (object.seed(i).flags & SEED_VALID)
            most = std::fmax(most, number(object.seed(i).position));
    return most;
}

void testLinks(const Sample& sample)
{
    const char* name = sample.kind;
    Scene scene;
    Object a = sample.make(1);
    {
        Object b = FEW[0].make(2);
        a->resample(Real(2), makeEngine);
        b->resample(Real(2), makeEngine);
        b->moveTo(point(0, 0, -18));
        scene.update({a.get(), b.get()});
        // The objects overlap, but must not blend.
        check(tally(*a).rest == a->seeds() && tally(*b).rest == b->seeds(), "%s: blends with what it is not linked to", name);
        check(a->link(b.get(), Real(1)) && b->link(a.get(), Real(1)), "%s: no link", name);
        check(a->recalc() && b->recalc(), "%s: a link asks for no update", name);
        scene.update({a.get(), b.get()});
        const Tally one = tally(*a);
        const double out = farthest(*a);
        check(one.moved > 0 && tally(*b).moved > 0, "%s: does not blend with what it is linked to", name);
        check(!a->recalc() && !b->recalc(), "%s: not settled", name);

        // Linking again with another weight replaces the link, and scales the bulge.
        a->link(b.get(), Real(0.25));
        check(a->recalc(), "%s: a new weight asks for no update", name);
        scene.update({a.get(), b.get()});
        check(farthest(*a) < out, "%s: a quarter of the weight bulges as far: %g, %g", name, farthest(*a), out);
        a->link(b.get(), Real(1));
        scene.update({a.get(), b.get()});

        // An object needs an update when its neighbour moves, turns or is scaled.
        b->translate({Real(0.5), Real(0), Real(0)});
        check(a->recalc(), "%s: not told of a move", name);
        scene.update({a.get(), b.get()});
        b->scale(Real(1.1));
        check(a->recalc(), "%s: not told of a scaling", name);
        scene.update({a.get(), b.get()});
        a->rotate(a->centre(), {Real(1), Real(0), Real(0)}, 0x10000000u);
        check(std::string(name) == "sphere" || b->recalc(), "%s: does not tell of a turn", name);
        scene.update({a.get(), b.get()});

        a->unlink(b.get());
        b->unlink(a.get());
        scene.update({a.get(), b.get()});
        check(tally(*a).rest == a->seeds() && tally(*b).rest == b->seeds(), "%s: blends after the link is gone", name);
        a->unlink(b.get());

        a->link(b.get(), Real(1));
        b->link(a.get(), Real(1));
        scene.update({a.get(), b.get()});
        check(tally(*a).moved > 0, "%s: does not blend when linked again", name);
    }
    // The neighbour has been destroyed.
    check(a->skel().empty() && a->recalc(), "%s: still linked to what has ended", name);
    scene.update({a.get()});
    check(tally(*a).rest == a->seeds(), "%s: blends with what has ended", name);
}

// Objects of a heap are created, destroyed, moved, turned, scaled, linked and unlinked at random; after each update every
// valid seed must lie on the surface.
void testComingAndGoing()
{
    Scene scene;
    std::vector<Object> objects;
    long seeds = 0, off = 0, far = 0;
    for (int step = 0; step < 3000; ++step) {
        const int count = static_cast<int>(objects.size());
        const auto any = [&]() -> SoftObject& { return *objects[static_cast<size_t>(below(count))]; };
        switch (count < 2 ? 0 : below(count < 7 ? 8 : 9)) {
        case 0: {
            Object made = FEW[static_cast<size_t>(below(static_cast<int>(FEW.size())))].make(step + 1);
            made->moveTo(point(between(-30, 30), between(-30, 30), between(-30, 30)));
            if (!check(made->resample(Real(3), makeEngine), "no seeds"))
                return;
            objects.push_back(std::move(made));
            break;
        }
        case 1: any().translate({real(between(-9, 9)), real(between(-9, 9)), real(between(-9, 9))}); break;
        case 2: any().rotate(point(0, 0, 0), {Real(1), Real(2), real(between(-3, 3))}, static_cast<Angle>(chance())); break;
        case 3: any().scale(real(between(0.8, 1.25))); break;
        case 4:
        case 5:
        case 6: {
            SoftObject &a = any(), &b = any();
            const Real weight = real(below(3) ? 1 : between(0, 2));
            if (&a != &b) {
                a.link(&b, weight);
                b.link(&a, weight);
            }
            break;
        }
        case 7: {
            SoftObject &a = any(), &b = any();
            a.unlink(&b);
            b.unlink(&a);
            break;
        }
        default: objects.erase(objects.begin() + below(count)); break;
        }
        if (step % 3 != 0)
            continue;
        for (Object& object : objects) {
            if (size(vec(object->centre())) > 60)
                object->moveTo(point(0, 0, 0));
            if (object->size() > Real(45) || object->size() < Real(8))
                object->scale(Real(20) / object->size());
        }
        std::vector<SoftObject*> all;
        for (Object& object : objects)
            all.push_back(object.get());
        scene.frame(all);
        for (Object& object : objects)
            for (int i = 0; i < object->seedSlots(); ++i) {
                const Seed& s = object->seed(i);
                if (!(s.flags & SEED_VALID) || ((i & 1) != 0 && !(s.flags & SEED_ACTIVE)))
                    continue;
                // Seeds that face away are updated less often, so they are skipped.
                const Vector normal{realFromRaw(s.normal.x * 4), realFromRaw(s.normal.y * 4), realFromRaw(s.normal.z * 4)};
                const Vec n = vec(object->isBall() ? normal : object->turn() * normal);
                if (dot(n, Vec{0, 0, -120} - vec(object->seedPoint(s))) < 0)
                    continue;
                ++seeds;
                const double error = std::fabs(bodyField(scene, *object, object->seedPoint(s)) - 0.5);
                off += error > 0.02;
                far += error > 0.1;
            }
    }
    check(seeds > 100000, "only %ld seeds seen", seeds);
    check(static_cast<double>(off) < 0.005 * static_cast<double>(seeds), "%ld of %ld seeds lie off the surface", off, seeds);
    check(static_cast<double>(far) < 0.0005 * static_cast<double>(seeds), "%ld of %ld seeds lie far off the surface", far, seeds);
}

}  // namespace

void testGraph()
{
    for (const Sample& sample : FEW)
        testLinks(sample);
    testComingAndGoing();
}
