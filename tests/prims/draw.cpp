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

typedef std::vector<SoftObject*> Objects;

// A scene: its objects, their relations, and a function that moves the objects before each frame.
struct Play {
    std::string name;
    std::vector<std::pair<int, int>> links;
    std::function<void(Objects&, int frame)> move;
    std::vector<std::pair<int, int>> dents = {};  // the second object of a pair digs into the first
    double dentWeight = 1;
    std::vector<double> strengths = {};
    std::vector<Object> objects = {};

    // Adds an object; they are numbered from 1.
    SoftObject& add(const Sample& sample)
    {
        objects.push_back(sample.make(static_cast<int>(objects.size()) + 1));
        return *objects.back();
    }
};

// Moves the objects of a play into a model. Returns whether there was memory for all.
bool fillModel(Play& play, double spacing, Model& model, Objects& objects)
{
    for (Object& object : play.objects) {
        objects.push_back(object.get());
        if (!model.add(object.release(), {255, 255, 255}, Motion{}))
            return false;
    }
    const auto at = [&](int i) { return objects[static_cast<size_t>(i)]; };
    for (const auto& link : play.links)
        if (!model.link(at(link.first), at(link.second), Real(1)))
            return false;
    for (const auto& dent : play.dents)
        if (!model.dent(at(dent.first), at(dent.second), real(play.dentWeight)))
            return false;
    for (size_t i = 0; i < play.strengths.size(); ++i)
        objects[i]->setStrength(real(play.strengths[i]));
    return model.resample(real(spacing), getenv("FB_PRINTED") != nullptr ? makeReport98 : makeEngine);
}

// Draws the frames of a play into the folder `to`.
bool run(Play& play, double spacing, const std::string& to)
{
    static VoxelList list;
    Model model;
    Objects objects;
    View view;
    Palette palette;
    Dump dump;
    if (!fillModel(play, spacing, model, objects) || !view.open())
        return false;
    view.setCamera(model.camera);
    palette.make(model, true);
    if (dump.open(to.c_str()) != nullptr)
        return false;
    for (int frame = 0; frame < FRAMES; ++frame) {
        play.move(objects, frame);
        Counts counts{};
        const FrameContext context{model.camera.eye, unit(model.light), model.prepareBodies(), &counts};
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
        view.closeGaps(real(spacing));
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

// Turns an object from frame to frame about its own centre.
void turn(SoftObject* object, int frame, const Vector& axis, uint32_t angle)
{
    if (frame > 0)
        object->rotate(object->centre(), axis, angle);
}

// Turns an object so that the frames of a scene show it from all sides.
void tumble(SoftObject* object, int frame)
{
    turn(object, frame, {Real(3), Real(1), Real(2)}, 0xffffffffu / 11);
}

Sample ball(double size)
{
    return {"sphere", size, 0, 0};
}

// The object turns on the spot, away from the middle of the picture.
Play turned(const Sample& sample)
{
    Play play{sample.kind + std::string("_turned"), {}, [](Objects& o, int frame) { tumble(o[0], frame); }};
    play.add(sample).moveTo(point(-8, 5, 10));
    return play;
}

// A ball passes by the object.
Play withBall(const Sample& sample)
{
    Play play{sample.kind + std::string("_ball"), {{0, 1}}, [](Objects& o, int frame) {
        tumble(o[0], frame);
        o[1]->moveTo(point(-33 + 6 * frame, 12 - frame, -4 + frame));
    }};
    play.add(sample);
    play.add(FEW[0]);
    return play;
}

// Two crossed objects of one kind draw apart.
Play pair(const Sample& sample)
{
    Play play{sample.kind + std::string("_pair"), {{0, 1}}, [](Objects& o, int frame) {
        o[0]->moveTo(point(-3 * frame, 2, 0));
        o[1]->moveTo(point(3 * frame, 0, 0));
        tumble(o[0], frame);
    }};
    play.add(sample);
    play.add(sample).rotate(point(0, 0, 0), {Real(1), Real(0), Real(0)}, QUARTER);
    return play;
}

// A ball digs into the object and passes by.
Play dented(const Sample& sample)
{
    Play play{sample.kind + std::string("_dented"), {}, [](Objects& o, int frame) {
        tumble(o[0], frame);
        o[1]->moveTo(point(-15 + 3 * frame, 9 - frame, -12));
    }, {{0, 1}}};
    play.add(sample);
    play.add(ball(20));
    return play;
}

// The object digs into a large ball.
Play digs(const Sample& sample)
{
    Play play{sample.kind + std::string("_digs"), {}, [](Objects& o, int frame) {
        tumble(o[1], frame);
        o[1]->moveTo(point(4, -3, -46 + 2 * frame));
    }, {{0, 1}}};
    play.add(ball(60));
    play.add(sample);
    return play;
}

// Stretched and warped objects: each alone, and all in one heap with a ball.
const std::vector<Sample> SHAPES = {{"sphere", 30, 0, 0, 0, 0, {1.8, 1, 0.6}}, {"cylinder", 14, 0, 36}, {"box", 12, 0, 16, 36, 8}};

void sway(Objects& o, int frame)
{
    const double swing = std::sin(frame * 0.15);
    o[1]->setWarp({{real(0.4 * swing), Real(0), real(100 * swing)}});
    o[2]->setWarp({{Real(0), real(150 * swing), Real(0)}});
    for (size_t i = 0; i < SHAPES.size(); ++i)
        turn(o[i], frame, {Real(3), Real(1), Real(2)}, 0xffffffffu / 60);
}

Play shapesTurned()
{
    Play play{"shapes_turned", {}, sway};
    for (int i = 0; i < 3; ++i)
        play.add(SHAPES[static_cast<size_t>(i)]).moveTo(point(-36 + 36 * i, 3, 4));
    return play;
}

Play shapes()
{
    Play play{"shapes", {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {2, 3}}, [](Objects& o, int frame) {
        sway(o, frame);
        o[3]->moveTo(point(-40 + 7 * frame, -10 + frame, -4 + frame));
    }};
    for (int i = 0; i < 3; ++i)
        play.add(SHAPES[static_cast<size_t>(i)]).moveTo(point(-20 + 18 * i, 6 - 5 * i, 4));
    play.add(FEW[0]);
    return play;
}

// A long object close to the viewer, who sees its ends from quite different sides, and a ball that moves along the object.
Play near()
{
    Play play{"near", {{0, 1}}, [](Objects& o, int frame) {
        o[0]->moveTo(point(0, 4, -60));
        turn(o[0], frame, {Real(0), Real(1), real(0.2)}, 0x0a000000u);
        o[1]->moveTo(point(-44 + 8 * frame, 12, -55));
    }};
    play.add({"cylinder", 14, 0, 90}).rotate(point(0, 0, 0), {Real(0), Real(0), Real(1)}, QUARTER);
    play.add(FEW[0]);
    return play;
}

// A ball digs a hollow across two blending balls, one of them strong.
Play across()
{
    Play play{"across", {{0, 1}}, [](Objects& o, int frame) {
        o[0]->moveTo(point(-12, 0, 0));
        o[1]->moveTo(point(12, 2, 4));
        o[2]->moveTo(point(-12 + 2 * frame, 6 - frame, -16));
    }, {{0, 2}, {1, 2}}, 0.8, {1, 1.5, 1}};
    for (const double size : {40, 40, 24})
        play.add(ball(size));
    return play;
}

// A weak ball, a strong one and one too weak to have a surface alone stand in a row.
Play strengths()
{
    Play play{"strengths", {{0, 1}, {1, 2}}, [](Objects& o, int frame) {
        o[0]->moveTo(point(-28 + 2 * frame, 2, 0));
        o[1]->moveTo(point(0, 0, 4));
        o[2]->moveTo(point(24 - frame, 8, -2));
    }, {}, 1, {0.6, 2.5, 0.45}};
    for (int i = 0; i < 3; ++i)
        play.add(ball(36));
    return play;
}

// All kinds blend in one heap.
Play heap()
{
    Play play{"heap", {}, [](Objects& o, int frame) {
        for (size_t i = 0; i < o.size(); ++i) {
            const double angle = 6.2832 * (static_cast<double>(i) / 5 + frame / 30.0), out = 34 - 1.5 * frame;
            o[i]->moveTo(point(out * std::cos(angle), 0.7 * out * std::sin(angle), 3.0 * static_cast<double>(i) - 6));
            tumble(o[i], frame);
        }
    }};
    for (const Sample& sample : FEW) {
        const int i = static_cast<int>(play.objects.size());
        play.add(sample);
        for (int j = 0; j < i; ++j)
            play.links.push_back({j, i});
    }
    return play;
}

// All kinds are scaled up and down.
Play pulse()
{
    Play play{"pulse", {}, [](Objects& o, int frame) {
        for (SoftObject* object : o)
            object->scale(real(frame % 6 < 3 ? 1.09 : 0.92));
    }};
    for (size_t i = 0; i < FEW.size(); ++i)
        play.add(FEW[i]).moveTo(point(i % 2 ? 25 : -25, i < 2 ? 22 : i < 4 ? -22 : 0, i < 4 ? 30 : 0));
    return play;
}

}  // namespace

int drawScenes(const char* directory)
{
    mkdir(directory, 0777);
    for (const double spacing : {2.0, 1.0}) {
        std::vector<Play> plays;
        for (const Sample& sample : FEW)
            for (const auto make : {turned, withBall, pair, dented, digs})
                plays.push_back(make(sample));
        for (const auto make : {shapesTurned, shapes, near, across, strengths, heap, pulse})
            plays.push_back(make());
        for (Play& play : plays) {
            const std::string to = directory + ("/" + play.name) + (spacing == 2 ? "" : "_1");
            if (!run(play, spacing, to)) {
                std::fprintf(stderr, "%s: not drawn\n", to.c_str());
                return 1;
            }
        }
    }
    return 0;
}
