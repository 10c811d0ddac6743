// Tests of dumped frames: the contents of the three files, and the behaviour when they cannot be written.
#include "app/dump.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "help.h"
#include "model/scene.h"
#include "../drawobj.h"
#include "test.h"

namespace {

std::string scratch()
{
    char name[] = "/tmp/fbdump.XXXXXX";
    if (mkdtemp(name) == nullptr)
        std::abort();
    return name;
}

void discard(const std::string& directory)
{
    if (DIR* d = opendir(directory.c_str())) {
        while (const dirent* e = readdir(d))
            unlink((directory + "/" + e->d_name).c_str());
        closedir(d);
    }
    rmdir(directory.c_str());
}

std::string contents(const std::string& name)
{
    std::ifstream file(name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::string> linesOf(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

void draw(Model& model, View& view)
{
    Counts counts{};
    const FrameContext frame{model.camera.eye, unit(model.light), model.prepareBodies(), &counts};
    view.begin();
    for (int i = 0; i < 4; ++i)
        drawObject(*model.actor(i).object, frame, view);
    view.end();
}

// Compares the files of colours and of depths with the view.
void checkPixels(const std::string& picture, const std::string& depth, const View& view, const Palette& palette)
{
    const std::string header = "P6\n320 200\n255\n";
    SAME(picture.size(), header.size() + 192000);
    TEXT(picture.substr(0, header.size()), header);
    SAME(depth.size(), 256000);
    long wrong = 0, drawn = 0;
    for (size_t i = 0; i < 64000; ++i) {
        for (size_t part = 0; part < 3; ++part) {
            const int full = palette.dac()[3 * view.frame()[i] + part];
            const int shown = static_cast<uint8_t>(picture[header.size() + 3 * i + part]);
            wrong += std::abs(shown * 63 - full * 255) > 63;
        }
        uint32_t z = 0;
        for (size_t part = 0; part < 4; ++part)
            z |= static_cast<uint32_t>(static_cast<uint8_t>(depth[4 * i + part])) << (8 * part);
        if (view.zbuffer()[i] == Z_EMPTY) {
            wrong += z != 0x7fffffff;
        } else {
            ++drawn;
            wrong += std::fabs(z / 65536.0 - view.zbuffer()[i] / 128.0) > 0.01;
        }
    }
    SAME(wrong, 0);
    CHECK(drawn > 5000);
}

// The lines of the time, the camera and the light.
void checkView(const std::vector<std::string>& lines)
{
    TEXT(lines[0], "time 1.200");
    TEXT(lines[1], "eye 0 0 -120");
    TEXT(lines[3], "centre 160 100");
    double lx = 0, ly = 0, lz = 0;
    SAME(std::sscanf(lines[4].c_str(), "light %lf %lf %lf", &lx, &ly, &lz), 3);
    NEAR(lx, 0.5, 0);
    NEAR(ly, 0.7, 1e-5);
    NEAR(lz, -0.5, 0);
    TEXT(lines[5], "isovalue 0.5");
    double fx = 0, fy = 0;
    SAME(std::sscanf(lines[2].c_str(), "focal %lf %lf", &fx, &fy), 2);
    NEAR(fx, 250, 0);
    NEAR(fy, 208.3333, 1e-3);
}

// The lines of the four spheres and of their relations.
void checkObjects(const std::vector<std::string>& lines, const Model& model)
{
    for (int i = 0; i < 4; ++i) {
        int n;
        double x, y, z, r;
        SAME(std::sscanf(lines[static_cast<size_t>(6 + i)].c_str(), "sphere %d %lf %lf %lf %lf", &n, &x, &y, &z, &r), 5);
        const SoftObject& object = *model.actor(i).object;
        SAME(n, object.number());
        NEAR(x, number(object.centre().x), 2e-5);
        NEAR(y, number(object.centre().y), 2e-5);
        NEAR(z, number(object.centre().z), 2e-5);
        NEAR(r, number(object.size()), 0);
    }
    // "Blend lists each linked pair once."
    bool pairs[5][5] = {};
    int blends = 0;
    for (const std::string& line : lines) {
        int a, b;
        if (std::sscanf(line.c_str(), "blend %d %d", &a, &b) != 2)
            continue;
        ++blends;
        CHECK(a >= 1 && a <= 4 && b >= 1 && b <= 4 && a != b && !pairs[a][b] && !pairs[b][a]);
        pairs[a][b] = pairs[b][a] = true;
    }
    SAME(blends, 6);
    SAME(std::count(lines.begin(), lines.end(), "dent 3 1 1.5"), 1);
    SAME(std::count(lines.begin(), lines.end(), "strength 2 2"), 1);
    SAME(std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
        return line.compare(0, 4, "dent") == 0 || line.compare(0, 8, "strength") == 0;
    }), 2);
}

}  // namespace

TEST(a_dumped_frame)
{
    const std::string top = scratch(), directory = top + "/NEW";
    Model model;
    CHECK(model.makeFourSpheres());
    Anim::move(model, 78643);  // 1.2 s
    CHECK(model.dent(model.actor(2).object, model.actor(0).object, Real(1.5)));
    model.actor(1).object->setStrength(Real(2));
    CHECK(model.resample(Real(4), makeEngine));
    View view;
    CHECK(view.open());
    view.setCamera(model.camera);
    Palette palette;
    palette.make(model, false);
    draw(model, view);
    Dump dump;
    CHECK(dump.open(directory.c_str()) == nullptr);
    CHECK(dump.frame(12, 78643, 10, model, view, palette, false) == nullptr);
    checkPixels(contents(directory + "/F0000012.PPM"), contents(directory + "/F0000012.Z"), view, palette);
    const std::string text = contents(directory + "/F0000012.TXT");
    const std::vector<std::string> lines = linesOf(text);
    CHECK(lines.size() >= 17);
    if (lines.size() < 17)
        return;
    checkView(lines);
    checkObjects(lines, model);

    // An existing directory is accepted. The axes of the eye are written if it is turned, and only then.
    CHECK(dump.open(directory.c_str()) == nullptr);
    Camera camera = model.camera;
    camera.axes = viewAlong(vector(1, 0, 0), vector(0, 1, 0), vector(1, 0, 0));
    view.setCamera(camera);
    CHECK(dump.frame(13, 78643, 10, model, view, palette, false) == nullptr);
    std::string turned = contents(directory + "/F0000013.TXT");
    const std::string words = "right 0 0 -1\nup 0 1 0\nahead 1 0 0\n", eye = "eye 0 0 -120\n";
    const size_t at = turned.find(words);
    CHECK(at == turned.find(eye) + eye.size());
    CHECK(turned.find("time 1.300\n") == 0);
    CHECK(at != std::string::npos && turned.erase(at, words.size()).substr(11) == text.substr(11));
    discard(directory);
    discard(top);
}

// Returns the lines of a dump's text from the blends on.
static std::vector<std::string> paintLines(bool grey, bool report98)
{
    const std::string directory = scratch();
    Model model;
    const std::string scene =
        "group g scale 2\nsphere a size 20 at 5 0 0 turn 0 0 90 in g colour red\nsphere b size 30\nblend a b\n"
        "colours mixed\nfinish a mirror\nfinish b shiny\npattern a checks 8.5 1 2 3\n";
    SceneEnd end;
    CHECK(readSceneText("T.FB", scene.data(), static_cast<uint32_t>(scene.size()), model, &end) == nullptr);
    Anim::move(model, 0);
    View view;
    CHECK(view.open());
    Palette palette;
    palette.make(model, grey, report98);
    Dump dump;
    CHECK(dump.open(directory.c_str()) == nullptr);
    CHECK(dump.frame(0, 0, 10, model, view, palette, grey) == nullptr);
    std::vector<std::string> lines;
    bool on = false;
    for (const std::string& line : linesOf(contents(directory + "/F0000000.TXT"))) {
        if (on)
            lines.push_back(line);
        on = on || line.find("blend") == 0;
    }
    discard(directory);
    return lines;
}

TEST(paint_in_a_dump)
{
    const std::vector<std::string> lines = paintLines(false, false);
    SAME(lines.size(), 8u);
    if (lines.size() != 8)
        return;
    TEXT(lines[2], "ramp 1 255 64 48");
    TEXT(lines[4], "mixed");
    TEXT(lines[5], "mirror 1");
    double n[14];
    SAME(std::sscanf(lines[6].c_str(), "checks %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", n, n + 1, n + 2, n + 3,
                     n + 4, n + 5, n + 6, n + 7, n + 8, n + 9, n + 10, n + 11, n + 12, n + 13),
         14);
    // The pattern is twice as large as in the scene and turned from x to y.
    const double wanted[14] = {1, 17, 1, 2, 3, 10, 0, 0, 0, 1, 0, -1, 0, 0};
    for (int i = 0; i < 14; ++i)
        NEAR(n[i], wanted[i], 2e-4);
    TEXT(lines[7], "shiny 2");
    const std::vector<std::string> grey = paintLines(true, false);
    SAME(grey.size(), 2u);
    TEXT(grey[0] + ", " + grey[1], "mirror 1, shiny 2");
    SAME(paintLines(false, true).size(), 4u);
    SAME(paintLines(true, true).size(), 0u);
}

TEST(places_that_cannot_be_written)
{
    const std::string top = scratch();
    const std::string file = top + "/FILE";
    std::ofstream(file) << "x";
    const std::string bad[] = {file, file + "/SUB", top + "/NONE/SUB", top + "/" + std::string(300, 'L'),
                               top + "/" + std::string(118, 'L')};
    for (const std::string& name : bad) {
        Dump dump;
        const char* problem = dump.open(name.c_str());
        if (!CHECK(problem != nullptr)) {
            note("accepted: %s", name.c_str());
            continue;
        }
        CHECK(std::strchr(problem, '\n') == nullptr);
        CHECK(std::strstr(problem, top.substr(0, 10).c_str()) != nullptr);
    }
    // While dumping, the directory disappears, or a file is in the way.
    Model model;
    CHECK(model.makeFourSpheres());
    View view;
    CHECK(view.open());
    Palette palette;
    palette.make(model, true);
    const std::string gone = top + "/GONE";
    Dump dump;
    CHECK(dump.open(gone.c_str()) == nullptr);
    CHECK(mkdir((gone + "/F0000005.Z").c_str(), 0777) == 0);
    const char* problem = dump.frame(5, 0, 10, model, view, palette, true);
    CHECK(problem != nullptr && std::strstr(problem, "F0000005.Z") != nullptr);
    rmdir((gone + "/F0000005.Z").c_str());
    discard(gone);
    problem = dump.frame(6, 0, 10, model, view, palette, true);
    CHECK(problem != nullptr && std::strstr(problem, "F0000006.PPM") != nullptr);
    discard(top);
}
