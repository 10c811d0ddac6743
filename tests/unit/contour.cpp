// Contours: held against surfaces that the test finds for itself along each pixel's ray, in double precision.
#include "picture/contour.h"

#include <array>
#include <cstring>

#include "help.h"
#include "picture/palette.h"
#include "test.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

constexpr int PIXELS = WIDTH * HEIGHT;
constexpr double NOWHERE = 1e9;
// Of the field: a ray that comes as near to touching a surface may be taken either way.
constexpr double TOUCH = 1e-3;

// The field of several balls along a ray from the eye, by depth.
class Ray {
public:
    Ray(const Truth& truth, const Vec& eye, const Vec& way)
    {
        for (const Ball& ball : truth.balls) {
            const Vec v = eye - ball.centre;
            const double square = ball.size * ball.size;
            const Part p{dot(way, way) / square, 2 * dot(v, way) / square, dot(v, v) / square, ball.weight};
            const double under = p.b * p.b - 4 * p.a * (p.c - 1);
            if (under <= 0)
                continue;
            const double from = (-p.b - std::sqrt(under)) / (2 * p.a), to = (-p.b + std::sqrt(under)) / (2 * p.a);
            if (to <= 1)
                continue;
            parts_.push_back(p);
            from_ = std::fmin(from_, from);
            to_ = std::fmax(to_, to);
            step_ = std::fmin(step_, ball.size / 30);
        }
        from_ = std::fmax(from_, 1);
    }

    double field(double t) const
    {
        double sum = 0;
        for (const Part& p : parts_)
            sum += p.weight * trueGeoff(p.c + t * (p.b + t * p.a));
        return sum;
    }

    // Depths where the field passes the isovalue, in their order; the first only, or all.
    std::vector<double> crossings(double isovalue, bool all) const
    {
        std::vector<double> found;
        if (parts_.empty())
            return found;
        const auto cross = [&](double a, double b) {
            const bool inside = field(a) >= isovalue;
            for (int i = 0; i < 40; ++i) {
                const double m = (a + b) / 2;
                ((field(m) >= isovalue) == inside ? a : b) = m;
            }
            found.push_back((a + b) / 2);
        };
        double before = from_ - step_, atBefore = 0, last = from_, atLast = field(last);
        for (double t = from_ + step_; t < to_ + 2 * step_ && (all || found.empty()); t += step_) {
            const double here = field(t);
            if ((here >= isovalue) != (atLast >= isovalue)) {
                cross(last, t);
            } else if (atLast < isovalue && atLast >= here && atLast >= atBefore && atLast > isovalue - 0.1) {
                // It may reach it in between.
                double a = before, b = t;
                for (int i = 0; i < 60; ++i) {
                    const double p = a + (b - a) / 3, q = b - (b - a) / 3;
                    (field(p) < field(q) ? a : b) = field(p) < field(q) ? p : q;
                }
                if (field(a) >= isovalue) {
                    cross(before, a);
                    cross(a, t);
                }
            }
            before = last;
            atBefore = atLast;
            last = t;
            atLast = here;
        }
        return found;
    }

    double meets(double isovalue) const
    {
        const std::vector<double> found = crossings(isovalue, false);
        return found.empty() ? NOWHERE : found[0];
    }

private:
    struct Part {
        double a, b, c, weight;
    };
    std::vector<Part> parts_;
    double from_ = NOWHERE, to_ = -NOWHERE, step_ = 10;
};

// A scene as it is drawn, before and after it is put right. Each object has a colour of its own, which is its number.
struct Picture {
    Scene scene;
    double spacing;
    View view;
    std::unique_ptr<Contours> contours{new Contours};
    std::vector<std::array<uint8_t, Palette::RAMP>> ramps;
    std::vector<uint8_t> frame, frameAfter;
    std::vector<uint16_t> depth, depthAfter;
    int pixels = 0;

    explicit Picture(double s = 2) : spacing(s)
    {
        CHECK(view.open());
        ramps.reserve(64);
    }

    void ball(double size, double x, double y, double depthOf)
    {
        SoftObject& object = scene.ball(size, x, y, depthOf + number(scene.eye.z), spacing);
        ramps.emplace_back();
        ramps.back().fill(static_cast<uint8_t>(ramps.size()));
        object.setRamp(ramps.back().data() + SHADING_MOST);
    }

    // As Demo::frame() does.
    void draw()
    {
        scene.update();
        std::vector<size_t> order;
        for (size_t i = 0; i < scene.objects.size(); ++i) {
            size_t at = i;
            order.push_back(i);
            for (; at > 0 && scene.objects[order[at - 1]]->centre().z > scene.objects[i]->centre().z; --at)
                order[at] = order[at - 1];
            order[at] = i;
        }
        Camera camera;
        camera.eye = scene.eye;
        view.setCamera(camera);
        view.begin();
        contours->begin();
        for (const size_t i : order) {
            scene.show(i, {&view});
            contours->add(*scene.objects[i], view.takeShown());
        }
        pixels = view.closeGaps(real(spacing));
        frame.assign(view.frame(), view.frame() + PIXELS);
        depth.assign(view.zbuffer(), view.zbuffer() + PIXELS);
        contours->correct(view, scene.look(), real(spacing), pixels);
        frameAfter.assign(view.frame(), view.frame() + PIXELS);
        depthAfter.assign(view.zbuffer(), view.zbuffer() + PIXELS);
        view.end();
    }

    bool changed(int at) const { return frame[at] != frameAfter[at] || depth[at] != depthAfter[at]; }

    Vec way(int at) const
    {
        const Camera& c = view.camera();
        return {(at % WIDTH + 0.5 - number(c.centreX)) / number(c.focalX), (number(c.centreY) - at / WIDTH - 0.5) / number(c.focalY), 1};
    }
    Vec place(int at, double depthOf) const { return vec(scene.eye) + way(at) * depthOf; }
    Ray ray(size_t object, int at) const { return Ray(scene.truth(object), vec(scene.eye), way(at)); }
};

// All pixels within `reach` of one that differs from them, of those that `one` and `other` say.
template <typename Class>
std::vector<int> seam(const std::vector<Class>& classes, Class one, Class other, int reach)
{
    std::vector<int> band;
    for (int at = 0; at < PIXELS; ++at) {
        const int x = at % WIDTH, y = at / WIDTH;
        const Class here = classes[static_cast<size_t>(at)];
        // The screen's edge is left as it was drawn.
        if ((here != one && here != other) || x < 1 || x >= WIDTH - 1 || y < 1 || y >= HEIGHT - 1)
            continue;
        const Class sought = here == one ? other : one;
        bool found = false;
        for (int v = std::max(y - reach, 0); v <= std::min(y + reach, HEIGHT - 1) && !found; ++v)
            for (int u = std::max(x - reach, 0); u <= std::min(x + reach, WIDTH - 1) && !found; ++u)
                found = classes[static_cast<size_t>(v * WIDTH + u)] == sought;
        if (found)
            band.push_back(at);
    }
    return band;
}

// Pixels about a line between what is seen on one side of it and on the other: those that show the wrong side as they are drawn and
// in the end, those that were right before, and those that were changed; and how far their depths are from the truth then.
struct Tally {
    long pixels = 0, before = 0, after = 0, spoilt = 0, changed = 0, deep = 0;
    double worst = 0, worstBehind = 0;

    void add(bool was, bool is)
    {
        ++pixels;
        before += !was;
        after += !is;
        spoilt += was && !is;
    }
    void add(const Tally& t)
    {
        pixels += t.pixels, before += t.before, after += t.after, spoilt += t.spoilt, changed += t.changed, deep += t.deep;
        worst = std::fmax(worst, t.worst), worstBehind = std::fmax(worstBehind, t.worstBehind);
    }
    void say() const
    {
        note("%ld pixels: %ld wrong as drawn, %ld in the end; %ld changed, their depth within %.3f units before the line and %.3f behind it (%ld beyond 0.5)",
             pixels, before, after, changed, worst, worstBehind, deep);
    }
};

// Of a picture whose objects are all linked, so that each of them sees the same field: the outline of what lies before `limit`
// against what lies behind it, or against the background.
Tally outline(const Picture& p, double limit, bool background)
{
    enum Class : uint8_t { NONE, BEFORE, BEHIND };
    const auto classOf = [&](double depth) { return depth >= NOWHERE ? NONE : depth < limit ? BEFORE : BEHIND; };
    std::vector<Class> truth(PIXELS);
    for (int at = 0; at < PIXELS; ++at)
        truth[static_cast<size_t>(at)] = classOf(p.ray(0, at).meets(0.5));
    Tally t;
    for (const int at : seam(truth, BEFORE, background ? NONE : BEHIND, 2)) {
        const Ray ray = p.ray(0, at);
        const double low = ray.meets(0.5 - TOUCH), high = ray.meets(0.5 + TOUCH);
        if (classOf(low) != classOf(high))
            continue;
        const size_t i = static_cast<size_t>(at);
        const auto right = [&](const std::vector<uint16_t>& z) { return (z[i] == Z_EMPTY ? NONE : classOf(z[i] / 128.0)) == truth[i]; };
        t.add(right(p.depth), right(p.depthAfter));
        if (!p.changed(at))
            continue;
        ++t.changed;
        if (!right(p.depthAfter) || truth[i] == NONE)
            continue;
        const double depth = p.depthAfter[i] / 128.0, off = std::fmax(0, std::fmax(low - depth, depth - high));
        double& worst = truth[i] == BEFORE ? t.worst : t.worstBehind;
        worst = std::fmax(worst, off);
        t.deep += off > 0.5;
    }
    return t;
}

// The same picture: pixels that are empty although their rays and those all round them meet something.
long holes(const Picture& p)
{
    std::vector<bool> hit(PIXELS);
    for (int at = 0; at < PIXELS; ++at)
        hit[static_cast<size_t>(at)] = p.ray(0, at).meets(0.5) < NOWHERE;
    long found = 0;
    for (int y = 1; y < HEIGHT - 1; ++y)
        for (int x = 1; x < WIDTH - 1; ++x) {
            if (p.frameAfter[static_cast<size_t>(y * WIDTH + x)] != 0)
                continue;
            bool inside = true;
            for (int v = -1; v <= 1; ++v)
                for (int u = -1; u <= 1; ++u)
                    inside = inside && hit[static_cast<size_t>((y + v) * WIDTH + x + u)];
            found += inside;
        }
    return found;
}

}  // namespace

TEST(a_ball_far_before_another)
{
    for (const double spacing : {1.0, 2.0, 3.0}) {
        Tally all;
        for (const double size : {12.0, 16.0, 30.0})
            for (const double aside : {0.0, 7.3, -9.1}) {
                Picture p(spacing);
                p.ball(size, aside / 2, aside / 3, 90);
                p.ball(100, 0, 0, 250);
                p.scene.linkAll();
                p.draw();
                all.add(outline(p, 150, false));
            }
        all.say();
        CHECK(all.pixels > 5000);
        CHECK(all.before > 50);
        SAME(all.after, 0);
        CHECK(all.worst < 0.5);
        CHECK(all.worstBehind < 8);
        CHECK(all.deep * 10 < all.changed);
    }
}

TEST(two_blended_far_before_another)
{
    // Joined by a neck; and parting, where there are only points left of it, drawn by scales that are larger.
    for (const bool parting : {false, true}) {
        Tally all;
        Random random;
        for (int k = 0; k < 20; ++k) {
            Picture p(random.between(1, 3));
            const double size = random.between(10, 24), other = random.between(10, 24);
            const double apart = (parting ? random.between(0.57, 0.65) : random.between(0.3, 0.57)) * (size + other);
            const double angle = random.between(0, 6.28), depth = random.between(80, 110), tilt = random.between(-0.5, 0.5);
            const double x = std::cos(angle) * apart / 2, y = std::sin(angle) * apart / 2;
            p.ball(size, x, y, depth + tilt * apart);
            p.ball(other, -x, -y, depth);
            p.ball(100, random.between(-10, 10), random.between(-10, 10), 260);
            p.scene.linkAll();
            p.draw();
            all.add(outline(p, 165, false));
        }
        all.say();
        CHECK(all.pixels > 10000);
        CHECK(all.before > 500);
        CHECK(all.after * 200 <= (parting ? all.before : 0));
        CHECK(all.spoilt * 400 <= (parting ? all.before : 0));
        CHECK(all.worst < 1);
        CHECK(all.worstBehind < 8);
        CHECK(all.deep * 10 < all.changed);
    }
}

TEST(crossing_objects_meet_in_a_line)
{
    Random random;
    Tally all;
    for (int k = 0; k < 24; ++k) {
        Picture p(random.between(1, 3));
        const double size = random.between(25, 50), other = random.between(25, 50), apart = random.between(0.25, 0.45) * (size + other);
        const Vec way{random.between(-1, 1), random.between(-1, 1), random.between(-0.6, 0.6)}, to = way * (apart / 2 / ::size(way));
        const double depth = random.between(90, 170);
        p.ball(size, to.x, to.y, depth + to.z);
        p.ball(other, -to.x, -to.y, depth - to.z);
        if (k % 3 == 1) {
            // One of them has something that it blends with.
            p.ball(20, to.x * 2, to.y * 2 + 5, depth + to.z);
            p.scene.link(0, 2);
        }
        p.draw();
        std::vector<uint8_t> first(PIXELS);
        for (int at = 0; at < PIXELS; ++at) {
            const double a = p.ray(0, at).meets(0.5), b = p.ray(1, at).meets(0.5);
            first[static_cast<size_t>(at)] = a >= NOWHERE && b >= NOWHERE ? 0 : a < b ? 1 : 2;
        }
        for (const int at : seam<uint8_t>(first, 1, 2, 2)) {
            const double a = p.ray(0, at).meets(0.5), b = p.ray(1, at).meets(0.5);
            // Where they cross, not where one stands out before the other; and either is right where they are the same.
            if (std::fabs(a - b) > 1 || std::fabs(a - b) < 0.05)
                continue;
            const size_t i = static_cast<size_t>(at);
            const auto right = [&](const std::vector<uint8_t>& f) { return f[i] == (first[i] == 1 && f[i] == 3 ? 3 : first[i]); };
            all.add(right(p.frame), right(p.frameAfter));
            if (p.changed(at)) {
                ++all.changed;
                all.worst = std::fmax(all.worst, std::fabs(p.depthAfter[i] / 128.0 - std::fmin(a, b)));
            }
        }
    }
    all.say();
    CHECK(all.pixels > 500);
    CHECK(all.before > 100);
    SAME(all.spoilt, 0);
    // Left are those where a scale lies so far before both that it may be a third one's.
    CHECK(all.after * 4 < all.before);
    CHECK(all.worst < 0.1);
}

TEST(what_is_right_stays)
{
    // Alone; beside each other, linked or not; and one that is before another by so little that it is no jump.
    for (int kind = 0; kind < 4; ++kind) {
        Picture p(2);
        if (kind < 3) {
            p.ball(40, kind == 0 ? 0 : -40, 0, 200);
            if (kind > 0)
                p.ball(40, 40, 5, 200);
        } else {
            p.ball(40, -12, 0, 195);
            p.ball(40, 12, 5, 200);
        }
        if (kind > 1)
            p.scene.linkAll();
        p.draw();
        CHECK(p.frame == p.frameAfter);
        CHECK(p.depth == p.depthAfter);
        CHECK(std::count_if(p.frame.begin(), p.frame.end(), [](uint8_t c) { return c != 0; }) > 1500);
    }
}

TEST(balls_near_the_viewer)
{
    // Spacing, size, depth; seeds lie 12 to 38 pixels apart.
    static const double cases[][3] = {{1, 20, 24}, {1, 20, 30}, {1, 30, 30}, {2, 20, 24}, {2, 20, 30}, {2, 20, 45}, {2, 30, 45}, {3, 20, 30}, {3, 20, 45}, {3, 30, 45}};
    for (const bool alone : {false, true}) {
        Tally all;
        for (const auto& c : cases) {
            Picture p(c[0]);
            p.ball(c[1], 1, 2, c[2]);
            if (!alone)
                p.ball(30, 40, 2, 200);
            p.scene.linkAll();
            p.draw();
            all.add(outline(p, 100, true));
            SAME(holes(p), 0);
        }
        all.say();
        CHECK(all.pixels > 15000);
        CHECK(all.before > 3000);
        SAME(all.after, 0);
        CHECK(all.worst < 0.5);
    }
    // Coarser: there is more to look at than there is time for. No worse than it was, and better by most of it.
    static const double coarse[][3] = {{2, 30, 30}, {3, 20, 24}, {3, 30, 30}};
    Tally all;
    for (const auto& c : coarse) {
        Picture p(c[0]);
        p.ball(c[1], 1, 2, c[2]);
        p.ball(30, 40, 2, 200);
        p.scene.linkAll();
        p.draw();
        all.add(outline(p, 100, true));
        SAME(holes(p), 0);
    }
    all.say();
    SAME(all.spoilt, 0);
    CHECK(all.after * 4 < all.before);
}

TEST(contours_of_any_scene)
{
    Random random;
    long changed = 0, unshown = 0, left = 0, halves = 0, strange = 0, off = 0, nowhere = 0, emptied = 0, half = 0;
    double worst = 0;
    for (int k = 0; k < 60; ++k) {
        const int count = 2 + random.below(7), links = k % 3;
        std::vector<std::array<double, 4>> balls;
        for (int i = 0; i < count; ++i) {
            const double size = random.between(5, 60), depth = random.below(3) ? random.between(60, 250) : random.between(size / 2 + 3, 80);
            balls.push_back({size, random.between(-0.4, 0.4) * depth, random.between(-0.3, 0.3) * depth, depth});
        }
        // None, some or all.
        std::vector<std::pair<size_t, size_t>> linked;
        for (size_t i = 0; i < balls.size(); ++i)
            for (size_t j = 0; j < i; ++j)
                if (links == 2 || (links == 1 && random.below(2)))
                    linked.emplace_back(i, j);
        const double spacing = random.between(1.3, 3);
        Picture p(spacing), again(spacing);
        for (Picture* picture : {&p, &again}) {
            for (const auto& b : balls)
                picture->ball(b[0], b[1], b[2], b[3]);
            for (const auto& l : linked)
                picture->scene.link(l.first, l.second);
            picture->draw();
        }
        CHECK(p.frameAfter == again.frameAfter);
        CHECK(p.depthAfter == again.depthAfter);
        for (int at = 0; at < PIXELS; ++at) {
            const size_t i = static_cast<size_t>(at);
            halves += (p.frameAfter[i] == 0) != (p.depthAfter[i] == Z_EMPTY);
            strange += p.frameAfter[i] > count;
            if (!p.changed(at))
                continue;
            ++changed;
            const Span& touched = p.view.touched(at / WIDTH);
            unshown += at % WIDTH < touched.from || at % WIDTH >= touched.to;
            // An object's surface is where its field and what its neighbours add have the isovalue, and none of them is stronger.
            double nearest = NOWHERE;
            bool met = false;
            const double depth = p.depthAfter[i] / 128.0;
            for (size_t o = 0; o < p.scene.objects.size(); ++o) {
                const Ray ray = p.ray(o, at);
                const Truth truth = p.scene.truth(o);
                for (const double isovalue : {0.5, 0.5 - TOUCH, 0.5 + TOUCH}) {
                    if (p.frameAfter[i] != 0 && nearest <= 1)
                        break;
                    for (const double c : ray.crossings(isovalue, true)) {
                        double lead = 1;
                        for (size_t n = 1; n < truth.balls.size(); ++n)
                            lead = std::fmin(lead, truth.part(0, p.place(at, c)) - truth.part(n, p.place(at, c)));
                        if (lead > -0.05)
                            nearest = std::fmin(nearest, std::fabs(c - depth));
                        met = met || (isovalue > 0.5 && lead > 0.05);
                    }
                }
            }
            if (p.frameAfter[i] == 0) {
                (links == 1 ? half : emptied) += met;
            } else if (nearest >= NOWHERE) {
                ++nowhere;
            } else {
                off += nearest > 1;
                worst = std::fmax(worst, nearest);
            }
        }
        // What the next frame finds is clear.
        p.view.begin();
        for (int at = 0; at < PIXELS; ++at)
            left += p.view.frame()[at] != 0 || p.view.zbuffer()[at] != Z_EMPTY;
    }
    note("%ld pixels changed: %ld of another depth by more than a unit, at worst by %.2f; %ld where nothing is; empty where something is: %ld, and %ld with some links only",
         changed, off, worst, nowhere, emptied, half);
    CHECK(changed > 20000);
    SAME(unshown, 0);
    SAME(left, 0);
    SAME(halves, 0);
    SAME(strange, 0);
    SAME(emptied, 0);
    CHECK(half * 2000 < changed);
    CHECK(off * 200 < changed);
    CHECK(nowhere * 200 < changed);
}
