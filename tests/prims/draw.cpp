// Draws small scenes with every primitive, alone, turned, and blending, as frames for the yardstick.
#include "prims.h"

#include <cstdio>
#include <cstring>
#include <sys/stat.h>

#include "app/dump.h"
#include "machine.h"
#include "picture/palette.h"
#include "picture/view.h"

namespace {

constexpr int FRAMES = 12;

// A scene: its objects, their relations, and a function that moves the objects before each frame.
struct Play {
    std::string name;
    double spacing;
    std::vector<Object> objects;
    std::vector<std::pair<int, int>> links;
    std::function<void(std::vector<SoftObject*>&, int frame)> move;
    std::vector<std::pair<int, int>> dents = {};  // the second object of a pair digs into the first
    double dentWeight = 1;
    std::vector<double> strengths = {};
};

bool run(Play& play, const std::string& directory, bool printed)
{
    static VoxelList list;
    Model model;
    std::vector<SoftObject*> objects;
    for (Object& object : play.objects) {
        objects.push_back(object.get());
        if (!model.add(object.release(), {255, 255, 255}, Motion{}))
            return false;
    }
    for (const auto& link : play.links)
        if (!model.link(objects[static_cast<size_t>(link.first)], objects[static_cast<size_t>(link.second)], Real(1)))
            return false;
    for (const auto& dent : play.dents)
        if (!model.dent(objects[static_cast<size_t>(dent.first)], objects[static_cast<size_t>(dent.second)], real(play.dentWeight)))
            return false;
    for (size_t i = 0; i < play.strengths.size(); ++i)
        objects[i]->setStrength(real(play.strengths[i]));
    if (!model.resample(real(play.spacing), printed ? makeReport98 : makeEngine))
        return false;
    View view;
    Palette palette;
    Dump dump;
    if (!view.open())
        return false;
    view.setCamera(model.camera);
    palette.make(model, true);
    const std::string to = directory + "/" + play.name;
    if (dump.open(to.c_str()) != nullptr)
        return false;
    for (int frame = 0; frame < FRAMES; ++frame) {
        play.move(objects, frame);
        Counts counts{};
        const FrameContext context{model.camera.eye, unit(model.light), model.bodies(), &counts};
        for (SoftObject* object : objects)
            object->update(context);
        view.begin();
        for (SoftObject* object : objects) {
            int next = 0;
            do {
                object->draw(context, list, 256, &next);
                view.show(list);
            } while (next != 0);
        }
        view.closeGaps(real(play.spacing));
        view.end();
        const char* problem = dump.frame(frame, 0, 10, model, view, palette, true);
        if (problem != nullptr) {
            std::fprintf(stderr, "%s\n", problem);
            return false;
        }
    }
    return true;
}

Point point(double x, double y, double z)
{
    return {real(x), real(y), real(z)};
}

// Turns an object a little, so that the frames of a scene show it from all sides.
void tumble(SoftObject* object, int frame)
{
    if (frame > 0)
        object->rotate(object->centre(), {Real(3), Real(1), Real(2)}, 0xffffffffu / 11);
}

}  // namespace

int drawScenes(const char* directory)
{
    const bool printed = getenv("FB_PRINTED") != nullptr;
    mkdir(directory, 0777);
    std::vector<Play> plays;
    for (const double spacing : {2.0, 1.0})
        for (const Sample& sample : FEW) {
            const std::string end = spacing == 2 ? "" : "_1";
            // The object turns on the spot, away from the middle of the picture.
            Play alone{sample.kind + ("_turned" + end), spacing, {}, {}, nullptr};
            alone.objects.push_back(sample.make(1));
            alone.objects[0]->moveTo(point(-8, 5, 10));
            alone.move = [](std::vector<SoftObject*>& o, int frame) { tumble(o[0], frame); };
            plays.push_back(std::move(alone));

            // A ball passes by the object.
            Play ball{sample.kind + ("_ball" + end), spacing, {}, {{0, 1}}, nullptr};
            ball.objects.push_back(sample.make(1));
            ball.objects.push_back(FEW[0].make(2));
            ball.move = [](std::vector<SoftObject*>& o, int frame) {
                tumble(o[0], frame);
                o[1]->moveTo(point(-33 + 6 * frame, 12 - frame, -4 + frame));
            };
            plays.push_back(std::move(ball));

            // Two crossed objects of one kind draw apart.
            Play pair{sample.kind + ("_pair" + end), spacing, {}, {{0, 1}}, nullptr};
            pair.objects.push_back(sample.make(1));
            pair.objects.push_back(sample.make(2));
            pair.objects[1]->rotate(point(0, 0, 0), {Real(1), Real(0), Real(0)}, 0x40000000u);
            pair.move = [](std::vector<SoftObject*>& o, int frame) {
                o[0]->moveTo(point(-3 * frame, 2, 0));
                o[1]->moveTo(point(3 * frame, 0, 0));
                tumble(o[0], frame);
            };
            plays.push_back(std::move(pair));
        }

    // Stretched and warped objects: each alone, and all in one heap with a ball.
    const std::vector<Sample> shapes = {
        {"sphere", 30, 0, 0, 0, 0, {1.8, 1, 0.6}}, {"cylinder", 14, 0, 36}, {"box", 12, 0, 16, 36, 8}};
    const auto sway = [](std::vector<SoftObject*>& o, int frame) {
        const double swing = std::sin(frame * 0.15);
        o[1]->setWarp({{real(0.4 * swing), Real(0), real(100 * swing)}});
        o[2]->setWarp({{Real(0), real(150 * swing), Real(0)}});
        for (int i = 0; i < 3 && frame > 0; ++i)
            o[static_cast<size_t>(i)]->rotate(o[static_cast<size_t>(i)]->centre(), {Real(3), Real(1), Real(2)}, 0xffffffffu / 60);
    };
    for (const double spacing : {2.0, 1.0}) {
        const std::string end = spacing == 2 ? "" : "_1";
        Play alone{"shapes_turned" + end, spacing, {}, {}, nullptr};
        Play heap{"shapes" + end, spacing, {}, {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {2, 3}}, nullptr};
        for (size_t i = 0; i < shapes.size(); ++i) {
            alone.objects.push_back(shapes[i].make(static_cast<int>(i + 1)));
            alone.objects.back()->moveTo(point(-36 + 36 * static_cast<double>(i), 3, 4));
            heap.objects.push_back(shapes[i].make(static_cast<int>(i + 1)));
            heap.objects.back()->moveTo(point(-20 + 18 * static_cast<double>(i), 6 - 5 * static_cast<double>(i), 4));
        }
        heap.objects.push_back(FEW[0].make(4));
        alone.move = sway;
        heap.move = [sway](std::vector<SoftObject*>& o, int frame) {
            sway(o, frame);
            o[3]->moveTo(point(-40 + 7 * frame, -10 + frame, -4 + frame));
        };
        plays.push_back(std::move(alone));
        plays.push_back(std::move(heap));
    }

    // A long object close to the viewer, who sees its ends from quite different sides, and a ball that moves along the object.
    for (const double spacing : {2.0, 1.0}) {
        Play near{spacing == 2 ? "near" : "near_1", spacing, {}, {{0, 1}}, nullptr};
        near.objects.push_back(Sample{"cylinder", 14, 0, 90}.make(1));
        near.objects.push_back(FEW[0].make(2));
        near.objects[0]->rotate(point(0, 0, 0), {Real(0), Real(0), Real(1)}, 0x40000000u);
        near.move = [](std::vector<SoftObject*>& o, int frame) {
            o[0]->moveTo(point(0, 4, -60));
            if (frame > 0)
                o[0]->rotate(o[0]->centre(), {Real(0), Real(1), real(0.2)}, 0x0a000000u);
            o[1]->moveTo(point(-44 + 8 * frame, 12, -55));
        };
        plays.push_back(std::move(near));
    }

    // Each kind with a ball that digs into it and passes by, and a large ball into which each kind digs.
    for (const double spacing : {2.0, 1.0})
        for (const Sample& sample : FEW) {
            const std::string end = spacing == 2 ? "" : "_1";
            Play dented{sample.kind + ("_dented" + end), spacing, {}, {}, nullptr, {{0, 1}}};
            dented.objects.push_back(sample.make(1));
            dented.objects.push_back(Sample{"sphere", 20, 0, 0}.make(2));
            dented.move = [](std::vector<SoftObject*>& o, int frame) {
                tumble(o[0], frame);
                o[1]->moveTo(point(-15 + 3 * frame, 9 - frame, -12));
            };
            plays.push_back(std::move(dented));

            Play digs{sample.kind + ("_digs" + end), spacing, {}, {}, nullptr, {{0, 1}}};
            digs.objects.push_back(Sample{"sphere", 60, 0, 0}.make(1));
            digs.objects.push_back(sample.make(2));
            digs.move = [](std::vector<SoftObject*>& o, int frame) {
                tumble(o[1], frame);
                o[1]->moveTo(point(4, -3, -46 + 2 * frame));
            };
            plays.push_back(std::move(digs));
        }

    // An object digs a hollow across two blending balls, one of them strong. In the other scene a weak ball, a strong one and one
    // too weak to have a surface alone stand in a row.
    for (const double spacing : {2.0, 1.0}) {
        const std::string end = spacing == 2 ? "" : "_1";
        Play across{"across" + end, spacing, {}, {{0, 1}}, nullptr, {{0, 2}, {1, 2}}, 0.8, {1, 1.5, 1}};
        for (int i = 0; i < 3; ++i)
            across.objects.push_back(Sample{"sphere", i == 2 ? 24.0 : 40.0, 0, 0}.make(i + 1));
        across.move = [](std::vector<SoftObject*>& o, int frame) {
            o[0]->moveTo(point(-12, 0, 0));
            o[1]->moveTo(point(12, 2, 4));
            o[2]->moveTo(point(-12 + 2 * frame, 6 - frame, -16));
        };
        plays.push_back(std::move(across));

        Play strengths{"strengths" + end, spacing, {}, {{0, 1}, {1, 2}}, nullptr, {}, 1, {0.6, 2.5, 0.45}};
        for (int i = 0; i < 3; ++i)
            strengths.objects.push_back(Sample{"sphere", 36, 0, 0}.make(i + 1));
        strengths.move = [](std::vector<SoftObject*>& o, int frame) {
            o[0]->moveTo(point(-28 + 2 * frame, 2, 0));
            o[1]->moveTo(point(0, 0, 4));
            o[2]->moveTo(point(24 - frame, 8, -2));
        };
        plays.push_back(std::move(strengths));
    }

    // All kinds blend in one heap.
    for (const double spacing : {2.0, 1.0}) {
        Play heap{spacing == 2 ? "heap" : "heap_1", spacing, {}, {}, nullptr};
        for (size_t i = 0; i < FEW.size(); ++i) {
            heap.objects.push_back(FEW[i].make(static_cast<int>(i + 1)));
            for (size_t j = 0; j < i; ++j)
                heap.links.push_back({static_cast<int>(j), static_cast<int>(i)});
        }
        heap.move = [](std::vector<SoftObject*>& o, int frame) {
            for (size_t i = 0; i < o.size(); ++i) {
                const double angle = 6.2832 * (static_cast<double>(i) / 5 + frame / 30.0), out = 34 - 1.5 * frame;
                o[i]->moveTo(point(out * std::cos(angle), 0.7 * out * std::sin(angle), 3.0 * static_cast<double>(i) - 6));
                tumble(o[i], frame);
            }
        };
        plays.push_back(std::move(heap));

        // All kinds are scaled up and down.
        Play pulse{spacing == 2 ? "pulse" : "pulse_1", spacing, {}, {}, nullptr};
        for (size_t i = 0; i < FEW.size(); ++i) {
            pulse.objects.push_back(FEW[i].make(static_cast<int>(i + 1)));
            pulse.objects.back()->moveTo(point(i % 2 ? 25 : -25, i < 2 ? 22 : i < 4 ? -22 : 0, i < 4 ? 30 : 0));
        }
        pulse.move = [](std::vector<SoftObject*>& o, int frame) {
            for (SoftObject* object : o)
                object->scale(real(frame % 6 < 3 ? 1.09 : 0.92));
        };
        plays.push_back(std::move(pulse));
    }

    for (Play& play : plays)
        if (!run(play, directory, printed)) {
            std::fprintf(stderr, "%s: not drawn\n", play.name.c_str());
            return 1;
        }
    return 0;
}
