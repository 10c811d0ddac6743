// The surface of a body of any objects, in double precision, from what the objects say of themselves and from the formula of
// model/body.h: what the voxels of a scene are held against.
#ifndef FB_TEST_TRUTH_H
#define FB_TEST_TRUTH_H

#include <array>

#include "help.h"
#include "model/box.h"
#include "model/cone.h"
#include "model/cylinder.h"
#include "model/disc.h"
#include "model/kind.h"
#include "model/torus.h"

// Makes an object of a kind with the kind's usual measures.
inline SoftObject* makeOf(const Kind& kind, int number)
{
    Real measures[MEASURES_MOST];
    for (int i = 0; i < kind.measures; ++i)
        measures[i] = kind.measure[i].usual;
    return kind.make(number, measures);
}

// An object: t(p), the squared distance to its core over its squared size.
struct Core {
    Vec centre, axis;  // the core lies along or about the axis
    double size, half = 0, ring = 0, disc = -1, tip = -1;
    bool box = false;
    Vec side{0, 0, 0}, edges{0, 0, 0};  // a box: its x axis, and half its edges

    double param(const Vec& p) const
    {
        const Vec v = p - centre;
        if (half == 0 && ring == 0 && disc < 0 && tip < 0 && !box)
            return dot(v, v) / (size * size);
        const double y = dot(v, axis), away = ::size(v - axis * y);
        if (tip >= 0) {
            const double on = std::clamp(y, -half, half);
            const double local = half > 0 ? size + (tip - size) * (on + half) / (2 * half) : size;
            return (away * away + (y - on) * (y - on)) / (local * local);
        }
        double d2;
        if (box) {
            const Vec ahead{side.y * axis.z - side.z * axis.y, side.z * axis.x - side.x * axis.z,
                            side.x * axis.y - side.y * axis.x};
            const double x = dot(v, side), z = dot(v, ahead);
            const Vec over{x - std::clamp(x, -edges.x, edges.x), y - std::clamp(y, -edges.y, edges.y),
                           z - std::clamp(z, -edges.z, edges.z)};
            d2 = dot(over, over);
        } else if (ring > 0) {
            d2 = (away - ring) * (away - ring) + y * y;
        } else if (disc >= 0) {
            const double over = std::fmax(0, away - disc);
            d2 = over * over + y * y;
        } else {
            const double along = y - std::clamp(y, -half, half);
            d2 = away * away + along * along;
        }
        return d2 / (size * size);
    }
};

inline Core coreOf(const SoftObject& object, const Kind* kind)
{
    const Matrix& m = object.turn();
    Core core;
    core.centre = vec(object.centre());
    core.axis = vec(Vector{m.m[0][1], m.m[1][1], m.m[2][1]});
    core.size = number(object.size());
    const double reach = number(object.coreReach());
    if (kind == kindNamed("cylinder"))
        core.half = reach;
    else if (kind == kindNamed("torus"))
        core.ring = reach;
    else if (kind == kindNamed("disc"))
        core.disc = reach;
    else if (kind == kindNamed("cone")) {
        const Cone& cone = static_cast<const Cone&>(object);
        core.half = reach;
        core.size = number(cone.size1());
        core.tip = number(cone.size2());
    } else if (kind == kindNamed("box")) {
        core.box = true;
        core.side = vec(Vector{m.m[0][0], m.m[1][0], m.m[2][0]});
        core.edges = vec(static_cast<const Box&>(object).half());
    }
    return core;
}

// All objects of a scene; `kinds` says what they are, null: a sphere.
struct Body {
    std::vector<Core> cores;
    std::vector<std::vector<double>> weights;  // row: by whom it is seen

    explicit Body(const Scene& scene, const std::vector<const Kind*>& kinds = {})
    {
        const size_t count = scene.objects.size();
        weights.assign(count, std::vector<double>(count, 0));
        for (size_t i = 0; i < count; ++i) {
            const SoftObject& object = *scene.objects[i];
            cores.push_back(coreOf(object, i < kinds.size() ? kinds[i] : nullptr));
            for (const List<Link>::Node* node = object.skel().first(); node != nullptr; node = node->next)
                for (size_t j = 0; j < count; ++j)
                    if (scene.objects[j].get() == node->item.object)
                        weights[i][j] = number(node->item.weight);
        }
    }

    // Objects that links join with object i, directly or through others.
    std::vector<size_t> joined(size_t i) const
    {
        std::vector<size_t> list{i};
        for (size_t at = 0; at < list.size(); ++at)
            for (size_t j = 0; j < cores.size(); ++j)
                if ((weights[list[at]][j] != 0 || weights[j][list[at]] != 0) &&
                    std::find(list.begin(), list.end(), j) == list.end())
                    list.push_back(j);
        return list;
    }

    double part(size_t i, const Vec& p) const { return trueGeoff(cores[i].param(p)); }

    double field(const std::vector<size_t>& body, const Vec& p) const
    {
        // This is evaluated so often that a vector would cost more than all the rest.
        std::array<double, 128> f;
        for (size_t a = 0; a < body.size(); ++a)
            f.at(a) = part(body[a], p);
        double above = 0, below = 0;
        for (size_t a = 0; a < body.size(); ++a) {
            if (f[a] == 0)
                continue;
            double g = f[a];
            const std::vector<double>& row = weights[body[a]];
            for (size_t b = 0; b < body.size(); ++b)
                g += row[body[b]] * f[b];
            above += f[a] * f[a] * g;
            below += f[a] * f[a];
        }
        return below > 0 ? above / below : 0;
    }

    // Minus the gradient.
    Vec fall(const std::vector<size_t>& body, const Vec& p) const
    {
        const double d = 1e-4;
        const auto along = [&](const Vec& by) { return (field(body, p - by) - field(body, p + by)) / (2 * d); };
        return {along({d, 0, 0}), along({0, d, 0}), along({0, 0, d})};
    }

    // By how much the strongest of the other objects is stronger than object i.
    double dominance(size_t i, const std::vector<size_t>& body, const Vec& p) const
    {
        double strongest = 0;
        for (size_t j : body)
            if (j != i)
                strongest = std::fmax(strongest, part(j, p));
        return strongest - part(i, p);
    }

    // The first place from `from` outwards along a path where it leaves the surface; 2: nowhere before its own field ends.
    double leaves(const std::vector<size_t>& body, const Vec& root, const Vec& path, double from = 0.7) const
    {
        double inside = from;
        if (field(body, root + path * from) < 0.5)
            return 2;
        for (double at = from; at < 2; at += 0.004) {
            if (field(body, root + path * at) >= 0.5) {
                inside = at;
                continue;
            }
            double outside = at;
            for (int i = 0; i < 30; ++i) {
                const double middle = (inside + outside) / 2;
                (field(body, root + path * middle) > 0.5 ? inside : outside) = middle;
            }
            return inside;
        }
        return 2;
    }
};

#endif
