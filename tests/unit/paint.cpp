// Tests of paint (finishes, patterns, mixed colours): the colours that are chosen, and the ramps that voxels get.
#include "model/paint.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "../../src/picture/tint.h"
#include "../../src/surface/paint.h"
#include "help.h"
#include "model/scene.h"
#include "picture/palette.h"
#include "test.h"

namespace {

// A scene made from its text, with a palette, settled at a given time.
struct Painted {
    Model model;
    Palette palette;
    Counts counts{};

    explicit Painted(const std::string& text, double seconds = 0, bool grey = false, bool plain = false, double spacing = 2)
    {
        SceneEnd end;
        const char* wrong = readSceneText("T.FB", text.data(), static_cast<uint32_t>(text.size()), model, &end);
        if (wrong != nullptr)
            note("%s", wrong);
        CHECK(wrong == nullptr);
        Anim::move(model, static_cast<Time>(seconds * 65536));
        CHECK(model.resample(real(spacing), makeEngine));
        palette.make(model, grey, plain);
        for (int i = 0; i < model.count(); ++i)
            object(i).update(frame());
    }
    SoftObject& object(int i) { return *model.actor(i).object; }
    FrameContext frame() { return {model.camera.eye, unit(model.light), model.prepareBodies(), &counts}; }
    // Calls `each` with each voxel of an object, its ramp and its position relative to the object's centre.
    template <class Each>
    void draw(int i, Each each, int room = 256)
    {
        auto list = std::make_unique<VoxelList>();
        int next = 0;
        do {
            object(i).draw(frame(), *list, room, &next);
            CHECK(list->count <= room);
            int at = 0;
            for (int run = 0; run < list->runs; ++run)
                for (CHECK(list->run[run].end > at); at < list->run[run].end; ++at)
                    each(list->voxels[at], list->run[run].ramp, Vec{list->voxels[at].x / 256.0, list->voxels[at].y / 256.0,
                                                                     list->voxels[at].z / 256.0});
            SAME(at, list->runs == 0 ? 0 : list->count);
        } while (next != 0);
    }
    // Red, green and blue of a palette entry, 0..255.
    Vec rgb(int entry) const
    {
        const uint8_t* c = palette.dac() + 3 * entry;
        return {c[0] * 255 / 63.0, c[1] * 255 / 63.0, c[2] * 255 / 63.0};
    }
};

double away(const Vec& a, const Vec& b)
{
    const Vec d = a - b;
    return std::sqrt(dot(d, d));
}

// The ramp entry of a colour at a step of brightness below the highlight.
Vec lit(const Vec& colour, int step)
{
    return colour * ((Palette::AMBIENT + step * (63 - Palette::AMBIENT) / 63.0) / 63);
}

const std::string BALLS = "sphere a size 40 at -10 0 0 colour red\nsphere b size 40 at 12 0 0 colour blue\nblend a b\n";

}  // namespace

TEST(paint_only_where_it_is_asked_for)
{
    Painted none(BALLS);
    CHECK(none.object(0).paint() == nullptr && none.object(1).paint() == nullptr);
    Painted one(BALLS + "finish a shiny\n");
    CHECK(one.object(0).paint() != nullptr && one.object(0).paint()->finish == FINISH_SHINY);
    // A plain palette has no paint; a grey one has finishes only.
    Painted plain(BALLS + "finish a shiny\ncolours mixed\n", 0, false, true);
    CHECK(plain.object(0).paint() == nullptr);
    CHECK(std::equal(plain.palette.dac(), plain.palette.dac() + 768, none.palette.dac()));
    Painted grey(BALLS + "finish a shiny\npattern a checks 5 red\npattern b checks 5 red\ncolours mixed\n", 0, true);
    CHECK(grey.object(0).paint()->finish == FINISH_SHINY && grey.object(0).paint()->pattern == PATTERN_NONE);
    CHECK(!grey.object(0).paint()->mixes && grey.object(1).paint() == nullptr);
    Painted bare(BALLS, 0, true);
    CHECK(std::equal(bare.palette.dac(), bare.palette.dac() + 768, grey.palette.dac()));
    // Paint that is taken away leaves nothing behind.
    one.model.actor(0).coat = Coat();
    one.palette.make(one.model, false);
    CHECK(one.object(0).paint() == nullptr);
    CHECK(std::equal(one.palette.dac(), one.palette.dac() + 768, none.palette.dac()));
}

TEST(colours_of_paint_have_ramps)
{
    // All kinds of paint at once, and more colours than there may be.
    std::string text = "colours mixed\n";
    for (int i = 1; i <= 128; ++i) {
        char line[200];
        snprintf(line, sizeof line, "sphere s%d size 9 colour %d %d %d\npattern s%d %s 5 %d %d 9\nfinish s%d %s\n", i, i * 2 - 1,
                 255 - i, i % 7 * 40, i, PATTERN_WORDS[1 + i % 3], i, i * 2 - 2, i, FINISH_WORDS[i % 3]);
        text += line;
    }
    Painted many(text + "blend all\n", 0, false, false, 4);
    Painted few(BALLS + "colours mixed\npattern a marble 9 white\nfinish b mirror\n");
    for (Painted* p : {&many, &few}) {
        for (int i = 0; i < p->model.count(); ++i) {
            const Paint& paint = *p->object(i).paint();
            CHECK(p->object(i).ramp() == paint.ramp);
            std::set<int> numbers{paint.number, paint.other};
            for (double red = 0; red < 16; red += 2.5)
                for (double green = 0; green < 16; green += 2.5)
                    numbers.insert(
                        paint.paints->numberAt(vector(std::min(red, 15.0), std::min(green, 15.0), 15 - green / 2), paint.shines()));
            for (int number : numbers) {
                CHECK(number < paint.paints->count() && paint.paints->shines(number) == paint.shines());
                const uint8_t* ramp = paint.ramps + number * paint.rampRoom;
                for (int step = -SHADING_MOST; step < 64 + SHADING_MOST; ++step)
                    CHECK(ramp[step] != 0 && ramp[step] != Palette::INK);
            }
        }
    }
    // A shiny colour is white at full light.
    const Paint& mirror = *few.object(1).paint();
    CHECK(away(few.rgb(mirror.ramp[63]), {255, 255, 255}) < 20);
    CHECK(away(few.rgb(few.object(0).ramp()[63]), {255, 255, 255}) > 60);
}

TEST(colours_mix_by_the_fields)
{
    Painted p(BALLS + "colours mixed\n");
    const Vec red{255, 64, 48}, blue{72, 112, 255};
    const Paint& paint = *p.object(0).paint();
    const Truth truths[] = {{{{{-10, 0, 0}, 40, 1}}}, {{{{12, 0, 0}, 40, 1}}}};
    // The distance of the seeds' mixed colours from the average of the two colours.
    int mixed = 0;
    const auto worst = [&](const Vec& first) {
        double most = 0;
        mixed = 0;
        for (int k = 0; k < 2; ++k)
            for (int i = 0; i < p.object(k).seedSlots(); ++i) {
                const Seed& s = p.object(k).seed(i);
                if ((s.flags & (SEED_VALID | SEED_RESTING)) != SEED_VALID || (s.flags & SEED_ASLEEP) ||
                    ((i & 1) && !(s.flags & SEED_ACTIVE)))
                    continue;
                const Vec at = vec(p.object(k).seedPoint(s));
                const double a = truths[0].field(at), b = truths[1].field(at);
                if (b < 0.02 || a < 0.02)
                    continue;
                const Colour& c = paint.paints->colour(s.mix);
                most =
                    std::max(most, away((first * a + blue * b) * (1 / (a + b)), {double(c.red), double(c.green), double(c.blue)}));
                ++mixed;
            }
        return most;
    };
    const double off = worst(red);
    note("%d mixtures of %d colours, off by %.1f of 255 at most", mixed, paint.paints->count(), off);
    CHECK(mixed > 300);
    CHECK(off < 14);  // a mixture stands for a cell of 12 by 3 by 14 in colour space
    // When the colours change while nothing moves, the seeds get new numbers.
    p.model.actor(1).coat.pattern = PATTERN_STRIPES;
    p.model.actor(1).coat.grain = Real(5);
    for (int change = 0; change < 2; ++change) {
        p.model.actor(0).colour = change == 0 ? Colour{255, 200, 48} : Colour{255, 64, 48};
        p.palette.make(p.model, false);
        const FrameContext frame = p.frame();
        for (int k = 0; k < 2; ++k)
            p.object(k).update(frame);
        const double now = worst(change == 0 ? Vec{255, 200, 48} : red);
        note("after a change: off by %.1f", now);
        CHECK(mixed > 300 && now < 17);
    }
    p.model.actor(1).coat = Coat();
    p.palette.make(p.model, false);
    // Neighbouring mixtures differ no more than neighbouring scales of the report's picture: 8 of 63 steps of light on such a ball.
    Vec before = p.rgb(p.object(0).ramp()[45]);
    double step = 0;
    for (int i = 0; i <= 64; ++i) {
        const Vector place = paint.at + (p.object(1).paint()->at - paint.at) * Real(i / 64.0);
        const Vec now = p.rgb((paint.ramps + paint.paints->numberAt(place, false) * paint.rampRoom)[45]);
        step = std::max(step, away(now, before));
        before = now;
    }
    note("neighbouring mixtures differ by %.1f of 255 at most", step);
    CHECK(step < 8 * 255 / 63.0);
    // At each brightness the ramps have the colours of the mixtures.
    double sum = 0;
    int count = 0;
    for (int n = 0; n < paint.paints->count(); ++n)
        for (int light = 0; light <= Palette::HIGHLIGHT; light += 4, ++count) {
            const Colour& c = paint.paints->colour(n);
            sum += std::pow(away(p.rgb((paint.ramps + n * paint.rampRoom)[light]),
                                 lit({double(c.red), double(c.green), double(c.blue)}, light)),
                            2);
        }
    note("ramps are off by %.1f of 255 (root of the mean square)", std::sqrt(sum / count));
    CHECK(std::sqrt(sum / count) < 10);
}

TEST(finishes_by_the_normal)
{
    for (const char* finish : {"shiny", "mirror"}) {
        Painted p(std::string("sphere a size 50 at 5 3 0\ncylinder b size 20 length 30 at -30 0 0 turn 30 20 50\nfinish a ") +
                  finish + "\nfinish b " + finish);
        const Vec light = vec(unit(p.model.light)), ahead{0, 0, 1};
        Vec half = light - ahead;
        half = half * (1 / std::sqrt(dot(half, half)));
        for (int k = 0; k < 2; ++k) {
            p.draw(k, [](const Voxel&, const uint8_t*, const Vec&) {});
            double worst = 0;
            int seen = 0;
            OwnFrame own;
            findOwnFrame(p.object(k), p.frame(), own);
            int32_t up[3];
            store14(p.object(k).toOwnAxes(vector(0, 1, 0)), up);
            const Polish polish(own.light, own.ahead, up);
            for (int i = 0; i < p.object(k).seedSlots(); i += 2) {
                const Seed& s = p.object(k).seed(i);
                Vec n{s.normal.x / 16384.0, s.normal.y / 16384.0, s.normal.z / 16384.0};
                n = vec(p.object(k).isBall() ? vector(n.x, n.y, n.z) : p.object(k).turn() * vector(n.x, n.y, n.z));
                double shade = 0.75 * std::max(0.0, dot(n, light));
                if (p.object(k).paint()->finish == FINISH_MIRROR) {
                    const double height = -2 * dot(n, ahead) * n.y;
                    shade = height < -0.3 ? 0.5 + (height + 1) / 0.7 * (1 / 12.0 - 0.5)
                            : height < 0.3 ? 1 / 12.0 + (height + 0.3) / 0.6 * (11 / 12.0)
                                           : 1 - (height - 0.3) / 0.7 * 0.5;
                }
                shade += (1 - shade) * std::pow(std::max(0.0, dot(n, half)), 16);
                const int32_t ours = polish.brightness8(p.object(k).paint()->finish, {s.normal.x, s.normal.y, s.normal.z});
                worst = std::max(worst, std::fabs(ours / 256.0 - 63 * shade));
                ++seen;
            }
            note("%s: off by %.2f steps at most", finish, worst);
            CHECK(seen > 200 && worst < 1);
        }
    }
}

TEST(patterns_turn_with_the_object)
{
    for (const char* kind : {"sphere a size 50", "cylinder a size 30 length 30", "sphere a size 25 in g"})
        for (double seconds : {0.0, 1.0, 2.3}) {
            Painted p("group g scale 2\n" + std::string(kind) + " turn 20 0 0 colour white\nspin a axis 0.2 1 0.1 period 8\n" +
                          "pattern a checks 10 red\n", seconds);
            const SoftObject& object = p.object(0);
            const Paint& paint = *object.paint();
            const double size = number(paint.grain) * number(object.size()) / number(p.model.actor(0).made);
            int right = 0, wrong = 0, edges = 0, both[2] = {0, 0};
            p.draw(0, [&](const Voxel& v, const uint8_t* ramp, const Vec& place) {
                const bool red = ramp != paint.ramp;
                CHECK(!red || ramp == paint.ramps + paint.other * paint.rampRoom);
                ++both[red];
                edges += (v.cutX | v.cutY) != 0;
                bool near = false;
                int sum = 0;
                for (int i = 0; i < 3; ++i) {
                    const Vec axis{number(object.turn().m[0][i]), number(object.turn().m[1][i]), number(object.turn().m[2][i])};
                    const double at = dot(place, axis) / size;
                    near = near || std::fabs(at - std::round(at)) < 0.01;
                    sum += static_cast<int>(std::floor(at));
                }
                if ((v.cutX | v.cutY) != 0 || near)
                    return;
                ++((sum & 1) == red ? right : wrong);
            });
            note("%s at %.1f: %d voxels, %d more at edges, %d of the wrong colour", kind, seconds, right, edges, wrong);
            CHECK(right > 150 && wrong * 100 <= right && edges > 100 && both[0] > 80 && both[1] > 80);
        }
    // The pattern of a ball turns with the ball.
    std::string shown[2];
    for (int t = 0; t < 2; ++t) {
        Painted p("sphere a size 50 colour white\nspin a axis 0 1 0 period 8\npattern a stripes 10 red\n", t);
        p.draw(0,
               [&](const Voxel&, const uint8_t* ramp, const Vec&) { shown[t] += ramp == p.object(0).paint()->ramp ? 'w' : 'r'; });
    }
    CHECK(shown[0] != shown[1]);
}

TEST(painted_lists_in_any_room)
{
    // The voxels are the same whatever the room of the list. While the object is marked as selected they have one ramp.
    Painted p("sphere a size 50 colour white\npattern a marble 12 blue\n");
    std::multiset<std::pair<const uint8_t*, std::string>> all[2];
    for (int k = 0; k < 2; ++k)
        p.draw(0, [&](const Voxel& v, const uint8_t* ramp, const Vec&) {
            all[k].insert({ramp, std::string(reinterpret_cast<const char*>(&v), sizeof v)});
        }, k == 0 ? DRAW_ROOM : VOXELS_AT_ONCE);
    CHECK(all[0].size() > 300 && all[0] == all[1]);
    std::set<const uint8_t*> ramps;
    for (const auto& one : all[0])
        ramps.insert(one.first);
    CHECK(ramps.size() > 8);
    p.object(0).setRamp(p.palette.raised(p.object(0).ramp(), 10));
    auto list = std::make_unique<VoxelList>();
    int next = 0;
    p.object(0).draw(p.frame(), *list, VOXELS_AT_ONCE, &next);
    CHECK(list->runs == 0 && list->count > 300 && list->ramp == p.object(0).ramp());
}

// A single point of a painted surface is shown as a scale in its place: with every finish and pattern, and where colours mix. So it
// is in grey, and when an object is selected.
TEST(points_look_like_scales)
{
    const char* const paints[] = {"finish a shiny\npattern a checks 9 white\npattern b stripes 7 yellow\n",
                                  "finish b mirror\npattern a marble 11 yellow\n", "colours mixed\nfinish a mirror\n",
                                  "colours mixed\npattern a checks 8 white\npattern b marble 9 green\n"};
    int kind = 0;
    for (const char* paint : paints) {
        Painted p(BALLS + paint, 0, kind++ == 1);
        if (kind == 3)
            p.object(1).setRamp(p.palette.raised(p.object(1).ramp(), 9));
        FieldProbe probe(&p.model);
        const Tint tint(probe, p.frame().axes);
        int seen = 0, alike = 0;
        for (int k = 0; k < 2; ++k) {
            const SoftObject& object = p.object(k);
            auto list = std::make_unique<VoxelList>();
            int next = 0;
            do {
                p.object(k).draw(p.frame(), *list, VOXELS_AT_ONCE, &next);
                for (int at = 0, run = 0; at < list->count; ++at) {
                    const Voxel& v = list->voxels[at];
                    run += list->runs > 0 && at == list->run[run].end;
                    const uint8_t* const ramp = list->runs == 0 ? list->ramp : list->run[run].ramp;
                    const Point there = object.centre() + vector(v.x / 256.0, v.y / 256.0, v.z / 256.0);
                    const int strongest = probe.strongestAt(there);
                    if (isCut(v) || v.brightness < 0 || strongest != k)
                        continue;
                    alike += away(p.rgb(tint.entry(there, strongest)), p.rgb(ramp[v.brightness])) < 20;
                    ++seen;
                }
            } while (next != 0);
        }
        note("%d of %d points look like their scales", alike, seen);
        CHECK(seen > 200 && alike >= seen * 0.97);
    }
}
