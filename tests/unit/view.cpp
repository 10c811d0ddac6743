// Tests of the view: the projection formula, clipping, the closing of gaps, and that clearing and presenting only spans gives the
// same picture as with the whole screen.
#include "picture/view.h"

#include <algorithm>
#include <cstring>

#include "help.h"
#include "model/anim.h"
#include "model/probe.h"
#include "test.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

int32_t steps(double units) { return static_cast<int32_t>(std::lround(units * 256)); }

Voxel voxel(double x, double y, double z, double wide, double high, int colour)
{
    Voxel v{};
    v.x = steps(x);
    v.y = steps(y);
    v.z = steps(z);
    v.halfWidth = static_cast<int16_t>(wide * 256);
    v.halfHeight = static_cast<int16_t>(high * 256);
    v.brightness = static_cast<uint8_t>(colour);
    return v;
}

// The rectangle of a voxel on the screen by the projection formula, pixels.
struct Box {
    double left, top, right, bottom;
};
Box box(const Voxel& v, const Camera& camera)
{
    const double x = v.x / 256.0, y = v.y / 256.0, z = v.z / 256.0;
    const double column = number(camera.centreX) + number(camera.focalX) * x / z;
    const double row = number(camera.centreY) - number(camera.focalY) * y / z;
    const double wide = v.halfWidth / 256.0 * number(camera.focalX) / z, high = v.halfHeight / 256.0 * number(camera.focalY) / z;
    return {column - wide, row - high, column + wide, row + high};
}

}  // namespace

TEST(projection_formula)
{
    View view;
    CHECK(view.open());
    Random random;
    long drawn = 0;
    for (int k = 0; k < 6000; ++k) {
        const double z = random.below(3) ? random.between(62, 258) : random.between(1, 511);
        const double spread = 0.9 * z;
        const Voxel v = voxel(random.between(-spread, spread), random.between(-spread, spread) * 0.7, z, random.between(0.1, 8),
                              random.between(0.1, 8), 1 + random.below(63));
        view.begin();
        drawn += show(view, v);
        view.end();
        const Box b = box(v, view.camera());
        // Factors are tabulated in steps of 1/16 unit, so at z = 76 they are off by 1/2400 at most; numbers have 12 fraction bits.
        // The tolerances leave some room.
        const double ax = 0.01 + 0.0011 * std::fmax(std::fabs(b.left - 160), std::fabs(b.right - 160));
        const double ay = 0.01 + 0.0011 * std::fmax(std::fabs(b.top - 100), std::fabs(b.bottom - 100));
        long wrong = 0;
        for (int row = 0; row < HEIGHT; ++row)
            for (int column = 0; column < WIDTH; ++column) {
                const double x = column + 0.5, y = row + 0.5;
                const bool taken = view.frame()[row * WIDTH + column] != 0;
                const bool inside = x > b.left + ax && x < b.right - ax && y > b.top + ay && y < b.bottom - ay;
                const bool outside = x < b.left - ax || x > b.right + ax || y < b.top - ay || y > b.bottom + ay;
                wrong += (inside && !taken) || (outside && taken);
                if (taken) {
                    wrong += view.frame()[row * WIDTH + column] != v.brightness;
                    wrong += std::fabs(view.zbuffer()[row * WIDTH + column] / 128.0 - v.z / 256.0) > 1.0 / 128;
                } else {
                    wrong += view.zbuffer()[row * WIDTH + column] != Z_EMPTY;
                }
            }
        if (wrong != 0 && CHECK(wrong == 0) == false)
            note("at %g %g %g: %ld pixels", v.x / 256.0, v.y / 256.0, v.z / 256.0, wrong);
    }
    CHECK(drawn > 3000);
}

// Scales of ordinary sizes, and large and near ones with little tilt, which the view projects itself.
TEST(tilted_scales_lie_in_their_plane)
{
    View view;
    CHECK(view.open());
    Random random;
    for (bool large : {false, true}) {
        long tried = 0;
        for (int k = 0; k < 2000; ++k) {
            const double z = large ? random.between(10, 250) : random.between(78, 250);
            const double size = large ? z / 25 : 0.3, most = large ? z / 10 : 1.4, tilt = large ? 0.18 : 2.5;
            Voxel v = voxel(random.between(-0.4 * z, 0.4 * z), random.between(-0.3 * z, 0.3 * z), z, random.between(size, most),
                            random.between(size, most), 9);
            v.tiltX = static_cast<int16_t>(random.between(-tilt, tilt) * 256);
            v.tiltY = static_cast<int16_t>(random.between(-tilt, tilt) * 256);
            view.begin();
            show(view, v);
            view.end();
            const Box b = box(v, view.camera());
            const double column = (b.left + b.right) / 2, row = (b.top + b.bottom) / 2;
            long wrong = 0;
            for (int y = 0; y < HEIGHT; ++y)
                for (int x = 0; x < WIDTH; ++x) {
                    if (view.frame()[y * WIDTH + x] == 0)
                        continue;
                    ++tried;
                    const double dx = x + 0.5 - column, dy = y + 0.5 - row;
                    const double across = v.tiltX / 256.0 * z / 250, down = v.tiltY / 256.0 * z / number(view.camera().focalY);
                    // Depths change by whole steps of 1/128 unit, added up from the corner; the centre is as accurate as the
                    // projection.
                    const double tolerance = (std::fabs(dx) + std::fabs(dy) + b.right - b.left + b.bottom - b.top + 2) / 128 +
                                             0.2 * (std::abs(v.tiltX) + std::abs(v.tiltY)) / 256.0 * z / 208;
                    wrong += std::fabs(view.zbuffer()[y * WIDTH + x] / 128.0 - (z + across * dx - down * dy)) > tolerance;
                }
            SAME(wrong, 0);
        }
        CHECK(tried > 10000);
    }
}

TEST(round_on_a_4_to_3_screen)
{
    // A pixel is 5 wide to 6 high: a length has 1.2 times as many columns as rows.
    View view;
    CHECK(view.open());
    NEAR(number(view.camera().focalX), 1.2 * number(view.camera().focalY), 1e-3);
    const Voxel v = voxel(0, 0, 100, 20, 20, 9);
    view.begin();
    SAME(show(view, v), 1);
    view.end();
    int wide = 0, high = 0;
    for (int x = 0; x < WIDTH; ++x)
        wide += view.frame()[100 * WIDTH + x] == 9;
    for (int y = 0; y < HEIGHT; ++y)
        high += view.frame()[y * WIDTH + 160] == 9;
    NEAR(wide, 100, 1);
    NEAR(high, 83.3, 1);
}

TEST(scales_grow_with_nearness)
{
    // "Gaps brought on by objects being moved closer to the viewpoint [are] solved by magnifying the scales at render time
    // according to their distance": at half the distance a scale is twice as large.
    View view;
    CHECK(view.open());
    double before = 0;
    for (double z : {240.0, 120.0, 60.0, 30.0, 15.0}) {
        const Voxel v = voxel(0, 0, z, 1.4, 1.4, 5);
        view.begin();
        show(view, v);
        view.end();
        int wide = 0;
        for (int x = 0; x < WIDTH; ++x)
            wide += view.frame()[100 * WIDTH + x] == 5;
        NEAR(wide, 2 * 1.4 * 250 / z, 1);
        CHECK(wide > before);
        before = wide;
    }
}

TEST(left_out)
{
    View view;
    CHECK(view.open());
    const Voxel out[] = {
        voxel(0, 0, 0.5, 1, 1, 1),    voxel(0, 0, -10, 1, 1, 1),     voxel(0, 0, 0, 1, 1, 1),
        voxel(0, 0, 512, 5, 5, 1),    voxel(0, 0, 20000, 5, 5, 1),   voxel(0, 0, -32000, 5, 5, 1),
        voxel(100, 0, 100, 1, 1, 1),  voxel(-100, 0, 100, 1, 1, 1),  voxel(0, 80, 100, 1, 1, 1),
        voxel(0, -80, 100, 1, 1, 1),  voxel(30000, 0, 5, 1, 1, 1),   voxel(-30000, -30000, 1.5, 1, 1, 1),
        voxel(0, 30000, 100, 1, 1, 1), voxel(32767, 32767, 511, 1, 1, 1),
    };
    view.begin();
    SAME(show(view, out, sizeof out / sizeof *out), 0);
    view.end();
    for (int i = 0; i < WIDTH * HEIGHT; ++i)
        if (view.frame()[i] != 0) {
            CHECK(view.frame()[i] == 0);
            break;
        }
    // Voxels exactly on the near and the far plane.
    const Voxel in[] = {voxel(0, 0, 1, 0.1, 0.1, 1), voxel(0, 0, 511, 5, 5, 1)};
    view.begin();
    SAME(show(view, in, 2), 2);
}

TEST(anything_may_be_shown)
{
    // Any number of random voxels: the sanitizers watch memory, and nothing is drawn beyond the screen's edges.
    View view;
    CHECK(view.open());
    Random random;
    const auto any = [&] { return static_cast<int32_t>(random.bits()) >> random.below(32); };
    std::vector<Voxel> many(5000);
    for (int round = 0; round < 40; ++round) {
        for (Voxel& v : many) {
            for (int32_t* place : {&v.x, &v.y, &v.z})
                *place = any();
            v.halfWidth = static_cast<int16_t>((random.bits() & 0x7fff) >> random.below(12));
            v.halfHeight = static_cast<int16_t>((random.bits() & 0x7fff) >> random.below(12));
            v.tiltX = static_cast<int16_t>(any());
            v.tiltY = static_cast<int16_t>(any());
            v.brightness = static_cast<uint8_t>(random.below(64));
            v.cutX = static_cast<int8_t>(random.below(4) == 0 ? any() : 0);
            v.cutY = static_cast<int8_t>(random.below(4) == 0 ? any() : 0);
            v.cutAt = static_cast<int16_t>(any());
        }
        view.setPixels(round % 8 == 7);
        view.begin();
        const int drawn = show(view, many.data(), many.size(), any(), any(), any());
        view.closeGaps(real(random.between(0.25, 8)));
        view.end();
        CHECK(drawn >= 0 && drawn <= static_cast<int>(many.size()));
    }
}

TEST(cut_scales_end_at_a_line_or_a_curve)
{
    // A cut scale draws those pixels of the whole scale where the cut function is not negative. Within the rounding error of the
    // steps from pixel to pixel either is right.
    View view, whole;
    CHECK(view.open() && whole.open());
    Random random;
    long within = 0, left = 0, doubtful = 0;
    for (int round = 0; round < 3000; ++round) {
        const double z = random.between(40, 480);
        Voxel v = voxel(random.between(-0.4 * z, 0.4 * z), random.between(-0.3 * z, 0.3 * z), z, random.between(0, z / 20),
                        random.between(0, z / 20), 1 + round % 63);
        if (round % 3 == 0) {
            v.slopeX = static_cast<int8_t>(random.below(13) - 6);
            v.slopeY = static_cast<int8_t>(random.below(13) - 6);
        }
        // What is cut along a curve has no dome.
        v.cutX = 1;
        v.cutAt = INT16_MAX;
        v.curveXX = round % 2 == 0 ? 1 : 0;
        whole.begin();
        show(whole, {v});
        v.curveXX = 0;
        v.cutX = static_cast<int8_t>(random.below(255) - 127);
        v.cutY = static_cast<int8_t>(random.below(255) - 127);
        const double most = (std::abs(v.cutX) * v.halfWidth + std::abs(v.cutY) * v.halfHeight) / 256.0;
        v.cutAt = static_cast<int16_t>(random.between(-1.2, 1.2) * most * 8);
        if (round % 2 == 0) {
            v.curveXX = static_cast<int8_t>(random.below(65) - 32);
            v.curveXY = static_cast<int8_t>(random.below(33) - 16);
            v.curveYY = static_cast<int8_t>(random.below(65) - 32);
        }
        view.begin();
        show(view, {v});
        const double column = 160 + 250 * (v.x / 256.0) / (v.z / 256.0),
                     row = 100 - number(view.camera().focalY) * (v.y / 256.0) / (v.z / 256.0);
        // Pixels outside of the box are cleared or were never drawn; other tests check that.
        const Box around = box(v, view.camera());
        const int from = std::max(0, static_cast<int>(around.top) - 2), to = std::min(HEIGHT, static_cast<int>(around.bottom) + 2);
        for (int i = from * WIDTH; i < to * WIDTH; ++i) {
            if (whole.zbuffer()[i] == Z_EMPTY) {
                if (view.zbuffer()[i] != Z_EMPTY)
                    SAME(view.zbuffer()[i], Z_EMPTY);
                continue;
            }
            const double across = i % WIDTH + 0.5 - column, up = row - (i / WIDTH + 0.5);
            const double dx = across * z / 250, dy = up * z / number(view.camera().focalY);
            const double value = v.cutAt / 64.0 + (v.cutX * dx + v.cutY * dy) / 8 +
                                 (v.curveXX * dx * dx + 2 * v.curveXY * dx * dy + v.curveYY * dy * dy) / 32;
            // The loop's positions and steps are so accurate that the line is right to a sixteenth of a pixel.
            const double slopeX = std::abs(v.cutX) / 8.0 + (std::abs(v.curveXX * dx) + std::abs(v.curveXY * dy)) / 16;
            const double slopeY = std::abs(v.cutY) / 8.0 + (std::abs(v.curveXY * dx) + std::abs(v.curveYY * dy)) / 16;
            const double far = std::abs(across) + std::abs(up), rounded = round % 2 == 0 ? far * far / 128 : 0;
            const double doubt = (far + 2) / 256 + rounded + (slopeX * z / 250 + slopeY * z / number(view.camera().focalY)) / 16;
            const bool drawn = view.zbuffer()[i] != Z_EMPTY;
            if (drawn)
                CHECK(view.zbuffer()[i] == whole.zbuffer()[i] && view.frame()[i] == whole.frame()[i]);
            if (v.cutX == 0 && v.cutY == 0)
                CHECK(drawn);
            else if (std::abs(value) > doubt)
                SAME(drawn, value > 0);
            else
                ++doubtful;
            ++(drawn ? within : left);
        }
    }
    note("%ld pixels drawn, %ld cut off, %ld in doubt", within, left, doubtful);
    CHECK(within > 20000 && left > 20000 && doubtful < (within + left) / 50);
}

TEST(of_cut_scales_that_overlap_the_nearest_is_seen)
{
    // Two scales of a bulge, drawn in either order: each plane comes before the other's centre, but the domes let every pixel show
    // the scale whose centre is nearest. Pixels about half way between the two may show either.
    View view;
    CHECK(view.open());
    Random random;
    long left = 0, right = 0;
    for (int round = 0; round < 200; ++round) {
        const double z = random.between(130, 240), apart = random.between(1, 2), bulge = random.between(0, 0.12) * apart;
        Voxel one = voxel(-apart, 0, 0, 2 * apart, apart, 20), other = voxel(apart, 0, 0, 2 * apart, apart, 40);
        one.tiltX = static_cast<int16_t>(-bulge * 256);
        other.tiltX = static_cast<int16_t>(bulge * 256);
        one.cutX = other.cutX = 1;
        one.cutAt = other.cutAt = INT16_MAX;
        view.begin();
        // Their places count from the object's centre: far from it the loop of scales, which makes domes, does not draw them.
        const Voxel both[] = {round % 2 == 0 ? one : other, round % 2 == 0 ? other : one};
        show(view, both, 2, 0, 0, steps(z));
        for (int x = 0; x < WIDTH; ++x) {
            const double off = x + 0.5 - 160;
            const uint8_t colour = view.frame()[100 * WIDTH + x];
            if (colour == 0 || std::abs(off) < 0.1 * apart * 250 / z + 0.5)
                continue;
            SAME(colour, off < 0 ? one.brightness : other.brightness);
            ++(off < 0 ? left : right);
        }
    }
    CHECK(left > 500 && right > 500);
}

TEST(domes_are_shallow_whatever_the_shape_of_pixels)
{
    for (const auto& focal : {std::pair<double, double>{100, 400}, {400, 100}}) {
        View view;
        CHECK(view.open());
        Camera camera;
        camera.focalX = real(focal.first);
        camera.focalY = real(focal.second);
        view.setCamera(camera);
        view.begin();
        const double z = 400;
        Voxel v = voxel(0, 0, 0, DOMED - 0.1, DOMED - 0.1, 20);
        v.cutX = 1;
        v.cutAt = INT16_MAX;
        show(view, &v, 1, 0, 0, steps(z));
        int least = Z_EMPTY, most = 0, drawn = 0;
        for (int at = 0; at < WIDTH * HEIGHT; ++at)
            if (view.frame()[at] != 0) {
                ++drawn;
                least = std::min<int>(least, view.zbuffer()[at]);
                most = std::max<int>(most, view.zbuffer()[at]);
            }
        CHECK(drawn > 20 && least >= static_cast<int>(z * 128) - 1 && most <= static_cast<int>(z * 128) + DOME_MOST);
    }
}

TEST(cut_scales_of_one_ramp_are_averaged)
{
    // Where a cut scale lies close before or behind what is drawn, the brightness is the mean, if the ramp is the same. The depth
    // is the lesser one.
    View view;
    CHECK(view.open());
    std::vector<uint8_t> own = plainRamp(), others = plainRamp();
    for (int i = 0; i <= BRIGHTEST; ++i) {
        own[static_cast<size_t>(SHADING_MOST + STEP_OF + i)] = static_cast<uint8_t>(i - STEP_BIAS);
        others[static_cast<size_t>(SHADING_MOST + i)] = static_cast<uint8_t>(i + 100);
    }
    Random random;
    int averaged = 0, apart = 0;
    for (int round = 0; round < 2000; ++round) {
        VoxelList list{};
        list.extent = 10 * 256;
        list.z = steps(100);
        list.count = 1;
        // A slope that does not show makes it a scale whose brightness may change. Both scales have the same dome.
        Voxel v = voxel(0, 0, 0, random.between(1, 2), random.between(1, 2), 20);
        v.slopeX = 1;
        cutNowhere(&v);
        const bool cut = round % 4 != 0, same = round % 8 != 1;
        const int nearer = random.below(320) - 160;  // 1/128 unit
        // What is not cut has no dome.
        if (!cut && std::abs(nearer) < 4)
            continue;
        view.begin();
        list.ramp = (same ? own : others).data() + SHADING_MOST;
        list.voxels[0] = v;
        view.show(list);
        const int at = 100 * WIDTH + 160, before = view.zbuffer()[at];
        v.brightness = 41;
        if (!cut)
            v.cutX = 0;
        v.z = -2 * nearer;
        list.ramp = own.data() + SHADING_MOST;
        list.voxels[0] = v;
        view.show(list);
        const bool averages = cut && same && nearer < AVERAGED && nearer >= -AVERAGED && nearer != 0;
        SAME(view.frame()[at], averages ? 30 : nearer > 0 ? 41 : same ? 20 : 120);
        if (cut)
            SAME(view.zbuffer()[at], nearer > 0 ? before - nearer : before);
        ++(averages ? averaged : apart);
    }
    CHECK(averaged > 400 && apart > 400);
}

TEST(places_count_from_the_lists_own)
{
    // An object's voxels are relative to its centre. Wherever the centre is, the picture is the same as with voxels relative to the
    // eye, both for voxels that the loop draws and for those that it leaves to the view.
    View one, two;
    CHECK(one.open() && two.open());
    Random random;
    for (int round = 0; round < 20; ++round) {
        std::vector<Voxel> list, moved;
        const int32_t x = steps(random.between(-3000, 3000)), y = steps(random.between(-3000, 3000)),
                      z = steps(random.between(-3000, 3000));
        for (int i = 0; i < 200; ++i) {
            Voxel v = voxel(random.between(-60, 60), random.between(-50, 50), random.between(20, 300), random.between(0, 6),
                            random.between(0, 6), 1 + i % 63);
            v.tiltX = static_cast<int16_t>(random.below(1000) - 500);
            v.tiltY = static_cast<int16_t>(random.below(1000) - 500);
            list.push_back(v);
            v.x -= x;
            v.y -= y;
            v.z -= z;
            moved.push_back(v);
        }
        one.begin();
        two.begin();
        SAME(show(one, list), show(two, moved.data(), moved.size(), x, y, z));
        one.end();
        two.end();
        CHECK(std::memcmp(one.frame(), two.frame(), WIDTH * HEIGHT) == 0);
        CHECK(std::memcmp(one.zbuffer(), two.zbuffer(), WIDTH * HEIGHT * 2) == 0);
        CHECK(std::memcmp(one.rows(), two.rows(), HEIGHT * sizeof(Span)) == 0);
    }
}

TEST(colours_are_the_lists_own)
{
    // Small scales, large ones and single pixels take their colour from the ramp of the list.
    View view;
    CHECK(view.open());
    uint8_t ramp[64];
    for (int i = 0; i < 64; ++i)
        ramp[i] = static_cast<uint8_t>(255 - 2 * i);
    VoxelList list{};
    list.ramp = ramp;
    list.extent = 100 * 256;
    list.count = 3;
    list.voxels[0] = voxel(-19.9, -0.1, 100, 1, 1, 0);
    list.voxels[1] = voxel(10.1, -0.1, 100, 8, 8, 63);
    list.voxels[2] = voxel(0.1, 20, 100, 1, 1, 7);
    for (bool pixels : {false, true}) {
        view.setPixels(pixels);
        view.begin();
        SAME(view.show(list), 3);
        view.end();
        SAME(view.frame()[100 * WIDTH + 110], 255);
        SAME(view.frame()[100 * WIDTH + 185], 255 - 126);
        SAME(view.frame()[58 * WIDTH + 160], 255 - 14);
        SAME(view.frame()[141 * WIDTH + 160], 0);
    }
    view.setPixels(false);
    // A scale that covers no pixel's centre is not counted: a narrow scale halfway between two columns covers none.
    list.voxels[0] = voxel(0, 0, 125, 0.1, 0.1, 5);
    list.voxels[1] = voxel(0.25, 0.3, 125, 0.1, 0.1, 5);
    list.extent = 125 * 256;
    list.count = 2;
    view.begin();
    SAME(view.show(list), 1);
    view.end();
    list.count = 0;
    SAME(view.show(list), 0);
}

TEST(far_aside_is_not_seen)
{
    // Voxels so far to a side that the products of positions and factors would wrap around to the middle of the screen.
    View view;
    CHECK(view.open());
    for (const double z : {40.0, 76.1, 120.0, 300.0})
        for (const double turns : {-1.0, 1.0}) {
            view.begin();
            const double factor = 250 * 4096 / z, aside = turns * 4294967296.0 / factor / 256;
            const Voxel voxels[] = {voxel(aside, 0, z, 2, 2, 9), voxel(0, aside * 1.2, z, 2, 2, 9)};
            SAME(show(view, voxels, 2), 0);
        }
}

TEST(nearest_is_seen)
{
    // With the Z-buffer the nearest scale is visible whatever the order of drawing.
    View one, two;
    CHECK(one.open() && two.open());
    Random random;
    std::vector<Voxel> list;
    for (int i = 0; i < 400; ++i)
        // The depths differ by more than a step of the Z-buffer.
        list.push_back(voxel(random.between(-40, 40), random.between(-30, 30), 80 + i * 0.1, 4, 4, 1 + i % 63));
    std::vector<Voxel> reversed(list.rbegin(), list.rend());
    for (View* view : {&one, &two}) {
        const std::vector<Voxel>& l = view == &one ? list : reversed;
        view->begin();
        show(*view, l);
        view->end();
    }
    CHECK(std::memcmp(one.frame(), two.frame(), WIDTH * HEIGHT) == 0);
    CHECK(std::memcmp(one.zbuffer(), two.zbuffer(), WIDTH * HEIGHT * 2) == 0);
}

TEST(pixels_instead_of_scales)
{
    View view;
    CHECK(view.open());
    CHECK(!view.pixels());
    view.setPixels(true);
    CHECK(view.pixels());
    Random random;
    int ones = 0;
    for (int i = 0; i < 500; ++i) {
        const Voxel v = voxel(random.between(-40, 40), random.between(-30, 30), random.between(70, 250), 3, 3, 8);
        view.begin();
        const int drawn = show(view, v);
        view.end();
        int count = 0, at = -1;
        for (int p = 0; p < WIDTH * HEIGHT; ++p)
            if (view.frame()[p] != 0) {
                ++count;
                at = p;
            }
        CHECK(count <= 1);
        CHECK(drawn == count);
        if (count == 1) {
            ++ones;
            const Box b = box(v, view.camera());
            NEAR(at % WIDTH + 0.5, (b.left + b.right) / 2, 0.75);
            NEAR(at / WIDTH + 0.5, (b.top + b.bottom) / 2, 0.75);
        }
    }
    CHECK(ones > 450);
}

// Draws a rectangle of pixels.
static void block(View& view, int left, int top, int right, int bottom, int colour, double z = 125)
{
    const Camera& camera = view.camera();
    const double unitX = z / number(camera.focalX), unitY = z / number(camera.focalY);
    const Voxel v = voxel(((left + right) / 2.0 - 160) * unitX, (100 - (top + bottom) / 2.0) * unitY, z,
                          (right - left) / 2.0 * unitX, (bottom - top) / 2.0 * unitY, colour);
    SAME(show(view, v), 1);
}

// Counts the drawn pixels of a rectangle.
static int drawnIn(const View& view, int left, int top, int right, int bottom)
{
    int count = 0;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const bool drawn = view.frame()[y * WIDTH + x] != 0;
            CHECK(drawn == (view.zbuffer()[y * WIDTH + x] != Z_EMPTY));
            count += drawn;
        }
    return count;
}

// In the blocks of the next tests, seeds with this spacing are 4 pixels apart: gaps are at most 14 pixels wide and high, narrow
// ends of openings at most 12 wide.
static const Real SPACING(2.25);

TEST(gaps_closed_all_round)
{
    View view;
    CHECK(view.open());
    for (int wide = 1; wide <= 40; ++wide)
        for (int high = 1; high <= 14; ++high) {
            const int left = 150, top = 90, right = left + wide, bottom = top + high;
            view.begin();
            block(view, 120, 60, left, 140, 7, 100);
            block(view, right, 60, 220, 140, 8, 140);
            block(view, 120, 60, 220, top, 9);
            block(view, 120, bottom, 220, 140, 9);
            SAME(drawnIn(view, left, top, right, bottom), 0);
            view.closeGaps(SPACING);
            view.end();
            const int at = (top + high / 2) * WIDTH + left;
            if (wide <= 12 || (wide <= 14 && high <= 14)) {
                SAME(drawnIn(view, left, top, right, bottom), wide * high);
                // A filled pixel has the colour and the depth of the closer side.
                SAME(view.frame()[at], 7);
                SAME(view.zbuffer()[at], view.zbuffer()[at - 1]);
                SAME(view.frame()[at + wide - 1], wide == 1 ? 7 : 8);
            } else if (high <= 6) {
                SAME(drawnIn(view, left, top, right, bottom), wide * high);
                SAME(view.frame()[at], 9);
            } else {
                SAME(drawnIn(view, left, top, right, bottom), 0);
            }
        }
}

// Two balls of size 40 at this distance to the left and to the right of the middle, or above and below it.
static void addPair(Model& model, double away, bool upright = false)
{
    Motion left{}, right{};
    left.centre = upright ? point(0, away, 0) : point(-away, 0, 0);
    right.centre = upright ? point(0, -away, 0) : point(away, 0, 0);
    CHECK(model.add(make<Sphere>(1, Real(40)), {255, 0, 0}, left));
    CHECK(model.add(make<Sphere>(2, Real(40)), {0, 0, 255}, right));
    Anim::move(model, 0);
    CHECK(model.prepareBodies() != nullptr);
}

// A gap between two pixels of one ramp, or of the grey one, is filled with a brightness between theirs; without a palette, with
// that of the closer side.
TEST(gaps_in_one_ramp)
{
    Model model;
    addPair(model, 10);
    for (const bool grey : {false, true}) {
        Palette palette;
        palette.make(model, grey);
        const uint8_t* const ramp = model.actor(0).object->ramp();
        View view;
        CHECK(view.open());
        for (int wide = 1; wide <= 2; ++wide)
            for (const Palette* with : {static_cast<const Palette*>(&palette), static_cast<const Palette*>(nullptr)}) {
                constexpr int LEFT = 120;
                view.begin();
                for (int y = 80; y < 120; ++y)
                    for (int x = 100; x < 140; ++x)
                        if (x < LEFT || x >= LEFT + wide)
                            view.setPixel(y * WIDTH + x, 120 * 128, ramp[x < LEFT ? 10 : 52]);
                view.closeGaps(SPACING, &model, with);
                view.end();
                for (int i = 0; i < wide; ++i) {
                    const int step = palette.step(view.frame()[100 * WIDTH + LEFT + i]);
                    if (with == nullptr)
                        SAME(step, i == 0 ? 10 : 52);
                    else
                        NEAR(step, 10 + 42.0 * (i + 1) / (wide + 1), 1);
                }
            }
    }
}

// Draws what the middle of the screen shows of a model, each pixel in the colour of step 30 of the object that it belongs to and
// `nearer` units before the surface. Returns these objects by pixel, -1 where there is none.
static std::vector<int> drawTruly(View& view, const Model& model, double nearer)
{
    std::vector<int> owners(WIDTH * HEIGHT, -1);
    FieldProbe probe(&model);
    for (int y = 50; y < 150; ++y)
        for (int x = 60; x < 260; ++x)
            for (int at = y * WIDTH + x, depth = 90 * 128, object; depth < 160 * 128; depth += 16)
                if (probe.implicitAt(view.pointAt(at, depth), &object) >= ISOVALUE) {
                    owners[static_cast<size_t>(at)] = object;
                    view.setPixel(at, depth - static_cast<int>(nearer * 128), model.actor(object).object->ramp()[30]);
                    break;
                }
    return owners;
}

// A gap between pixels of two objects, one well in front of the other, shows the surface of the two wherever it lies: its depth,
// and within a pixel the objects' colours.
TEST(gaps_between_two_objects)
{
    Model model;
    Motion front{}, behind{};
    front.centre = point(-10, 0, 0);
    behind.centre = point(10, 0, 45);
    CHECK(model.add(make<Sphere>(1, Real(40)), {255, 0, 0}, front));
    CHECK(model.add(make<Sphere>(2, Real(40)), {0, 0, 255}, behind));
    Anim::move(model, 0);
    CHECK(model.prepareBodies() != nullptr);
    Palette palette;
    palette.make(model, false);
    View view;
    CHECK(view.open());
    int sides[2] = {0, 0};
    view.begin();
    const std::vector<int> owners = drawTruly(view, model, 0);
    const auto owner = [&](int x, int y) { return owners[static_cast<size_t>(y * WIDTH + x)]; };
    int edge = 160;
    while (owner(edge, 99) == 0)
        ++edge;
    for (int from = edge - 9; from < edge - 2; ++from) {
        const int to = from + 12;
        view.begin();
        drawTruly(view, model, 0);
        std::vector<int> depths;
        for (int y = 94; y < 104; ++y)
            for (int x = from; x < to; ++x) {
                depths.push_back(view.zbuffer()[y * WIDTH + x]);
                view.setPixel(y * WIDTH + x, Z_EMPTY, 0);
            }
        view.closeGaps(SPACING, &model, &palette);
        view.end();
        size_t n = 0;
        for (int y = 94; y < 104; ++y) {
            CHECK(owner(from - 1, y) == 0 && owner(to, y) == 1);
            for (int x = from; x < to; ++x, ++n) {
                const int at = y * WIDTH + x, own = owner(x, y);
                CHECK(own >= 0);
                if (owner(x - 1, y) != own || owner(x + 1, y) != own)
                    continue;
                ++sides[own];
                NEAR(view.zbuffer()[at], depths[n], 64);
                SAME(palette.rampOf(view.frame()[at]), palette.numberOf(model.actor(own).object->ramp()));
            }
        }
    }
    CHECK(sides[0] > 200 && sides[1] > 200);
}

namespace {

// How two balls belong together: linked; not linked; or not linked, and the first is two weak balls at one place in one colour.
enum Bond { ONE_BODY, TWO_BODIES, WEAK_AND_STRONG };
const char* const BONDS[] = {"one body", "two bodies", "a body of two weak balls and one of a strong ball"};

// The two balls of addPair(), with their palette, and a view that has begun a frame.
struct PairView {
    Model model;
    Palette palette;
    View view;

    explicit PairView(double away, Bond bond = ONE_BODY)
    {
        addPair(model, away);
        SoftObject* const first = model.actor(0).object;
        CHECK(bond != ONE_BODY || model.link(first, model.actor(1).object, Real(1)));
        if (bond == WEAK_AND_STRONG) {
            CHECK(model.add(make<Sphere>(3, Real(30)), {255, 0, 0}, model.actor(0).motion));
            first->setSize(Real(30));
            Anim::move(model, 0);
            CHECK(model.link(first, model.actor(2).object, Real(1)));
        }
        CHECK(model.prepareBodies() != nullptr);
        palette.make(model, false);
        CHECK(view.open());
        view.begin();
    }
};

}  // namespace

// Teeth of a wrong colour at a border get the colour of the object that they belong to, even if their depth is off by half a unit;
// what was right stays, and so does what lies far from the border.
TEST(borders_of_colours)
{
    for (const Bond bond : {ONE_BODY, TWO_BODIES, WEAK_AND_STRONG})
        for (double nearer : {-0.5, 0.0, 0.5}) {
            PairView pair(10, bond);
            const Model& model = pair.model;
            const Palette& palette = pair.palette;
            View& view = pair.view;
            const std::vector<int> owners = drawTruly(view, model, nearer);
            const auto isInside = [&](int at) { return owners[static_cast<size_t>(at)] >= 0; };
            const auto isRight = [&](int at) { return owners[static_cast<size_t>(at)] == 1; };
            // Teeth of four by four pixels to both sides of the border.
            int wrong = 0, left = 0, spoilt = 0;
            const auto isWrong = [&](int at) {
                const int owner = owners[static_cast<size_t>(at)];
                return isInside(at) && palette.rampOf(view.frame()[at]) != palette.numberOf(model.actor(owner).object->ramp());
            };
            const auto isNear = [&](int at) { return isRight(at - 4) != isRight(at + 4); };
            for (int y = 60; y < 140; ++y)
                for (int x = 100; x < 200; ++x) {
                    const int at = y * WIDTH + x, other = (y / 4) % 2;
                    if (!isInside(at) || !isNear(at) || isRight(at) == (other == 1))
                        continue;
                    view.setPixel(at, view.zbuffer()[at], model.actor(other).object->ramp()[30]);
                    wrong += isWrong(at);
                }
            const int far = 100 * WIDTH + 120;
            CHECK(isInside(far));
            view.setPixel(far + 1, view.zbuffer()[far + 1], palette.INK);
            view.closeGaps(SPACING, &model, &palette);
            for (int at = 0; at < WIDTH * HEIGHT; ++at) {
                left += isWrong(at) && isNear(at);
                spoilt += isWrong(at) && !isNear(at) && at != far + 1;
            }
            note("%s, %.1f units off: %d pixels in a wrong colour, %d left", BONDS[bond], nearer, wrong, left);
            CHECK(wrong > 150 && left <= wrong / 20);
            SAME(spoilt, 0);
            SAME(view.frame()[far + 1], palette.INK);
        }
}

// Near a border a pixel of the wrong colour is found that stands alone, in whichever row and column.
TEST(pixels_that_stand_alone_beside_borders)
{
    for (const Bond bond : {ONE_BODY, TWO_BODIES}) {
        PairView pair(10, bond);
        const Model& model = pair.model;
        const Palette& palette = pair.palette;
        View& view = pair.view;
        const std::vector<int> owners = drawTruly(view, model, 0);
        std::vector<int> alone;
        for (int y = 70; y < 130; y += 3)
            for (const int x : {157 + y % 2, 161 + y % 2}) {
                const int at = y * WIDTH + x, owner = owners[static_cast<size_t>(at)];
                CHECK(owner >= 0);
                view.setPixel(at, view.zbuffer()[at], model.actor(1 - owner).object->ramp()[30]);
                alone.push_back(at);
            }
        view.closeGaps(SPACING, &model, &palette);
        int left = 0;
        for (const int at : alone)
            left += palette.rampOf(view.frame()[at]) !=
                    palette.numberOf(model.actor(owners[static_cast<size_t>(at)]).object->ramp());
        note("%s: %d pixels stood alone, %d are left", BONDS[bond], static_cast<int>(alone.size()), left);
        SAME(left, 0);
    }
}

// An object with a pattern has two colours. Beside a border it keeps both, and neither goes beyond the border; nor does one go
// beyond an edge of the pattern.
TEST(borders_of_patterns)
{
    PairView pair(10);
    Model& model = pair.model;
    model.actor(1).coat.pattern = PATTERN_CHECKS;
    model.actor(1).coat.grain = Real(8);
    model.actor(1).coat.colour = {0, 255, 0};
    pair.palette.make(model, false);
    View& view = pair.view;
    const std::vector<int> owners = drawTruly(view, model, 0);
    const SoftObject& checked = *model.actor(1).object;
    const Paint& paint = *checked.paint();
    const uint8_t* const colours[] = {model.actor(0).object->ramp(), paint.ramp, paint.ramps + paint.other * paint.rampRoom};
    std::vector<int> colour(WIDTH * HEIGHT, -1);
    // Whether the colour is not judged: on an edge of the pattern, and beside the outline, where the surface is too steep to be
    // found.
    std::vector<bool> open(WIDTH * HEIGHT);
    for (int at = 0; at < WIDTH * HEIGHT; ++at) {
        if (owners[static_cast<size_t>(at)] < 0)
            continue;
        const Vec p = vec(view.pointAt(at) - checked.centre()) * (1 / 8.0);
        const double parts[] = {p.x, p.y, p.z};
        int sum = 0;
        for (double part : parts) {
            sum += static_cast<int>(std::floor(part));
            open[static_cast<size_t>(at)] = open[static_cast<size_t>(at)] || std::fabs(part - std::round(part)) < 0.02;
        }
        for (int beside = at - 2; beside <= at + 2; ++beside)
            open[static_cast<size_t>(at)] = open[static_cast<size_t>(at)] || owners[static_cast<size_t>(beside)] < 0;
        colour[static_cast<size_t>(at)] = owners[static_cast<size_t>(at)] == 0 ? 0 : 1 + (sum & 1);
    }
    // Each fourth row of the border at column 160, and of the edges of the pattern, is two columns too far to one side.
    for (int at = 0; at < WIDTH * HEIGHT; ++at) {
        const int y = at / WIDTH, from = y % 8 == 0 ? at - 2 : y % 8 == 4 ? at + 2 : at;
        if (colour[static_cast<size_t>(at)] < 0)
            continue;
        const bool any = from >= 0 && from < WIDTH * HEIGHT && colour[static_cast<size_t>(from)] >= 0;
        view.setPixel(at, view.zbuffer()[at], colours[colour[static_cast<size_t>(any ? from : at)]][30]);
    }
    const auto wrong = [&] {
        int count = 0;
        for (int at = 0; at < WIDTH * HEIGHT; ++at)
            if (colour[static_cast<size_t>(at)] >= 0 && !open[static_cast<size_t>(at)])
                count += pair.palette.rampOf(view.frame()[at]) != pair.palette.numberOf(colours[colour[static_cast<size_t>(at)]]);
        return count;
    };
    const int before = wrong();
    view.closeGaps(SPACING, &model, &pair.palette);
    note("%d pixels had a wrong colour, %d have it still", before, wrong());
    // Single pixels that stand alone in odd columns may be missed.
    CHECK(before > 150 && wrong() <= 4);
}

// Where one object fills the whole view a pixel of the wrong colour is mended, and nothing is looked for outside the frame.
TEST(borders_of_colours_where_an_object_fills_the_view)
{
    PairView pair(10);
    View& view = pair.view;
    Camera camera = view.camera();
    camera.eye.x = real(-10);
    camera.focalX = camera.focalY = real(4000);
    view.setCamera(camera);
    FieldProbe probe(&pair.model);
    int depth = 60 * 128, owner;
    while (probe.implicitAt(view.pointAt(100 * WIDTH + 160, depth), &owner) < ISOVALUE)
        ++depth;
    SAME(owner, 0);
    const uint8_t *const own = pair.model.actor(0).object->ramp(), *const other = pair.model.actor(1).object->ramp();
    for (int at = 0; at < WIDTH * HEIGHT; ++at)
        view.setPixel(at, depth, own[30]);
    view.setPixel(2 * WIDTH + 2, depth, other[30]);
    view.closeGaps(SPACING, &pair.model, &pair.palette);
    int wrong = 0;
    for (int at = 0; at < WIDTH * HEIGHT; ++at)
        wrong += pair.palette.rampOf(view.frame()[at]) != pair.palette.numberOf(own);
    SAME(wrong, 0);
}

// At a crease the two sides differ in brightness. A pixel that gets the other colour gets a brightness between those of the two.
TEST(brightness_beside_borders_of_colours)
{
    PairView pair(10);
    View& view = pair.view;
    drawTruly(view, pair.model, 0);
    // The border should be at column 160, and is at column 162.
    const uint8_t *const left = pair.model.actor(0).object->ramp(), *const right = pair.model.actor(1).object->ramp();
    for (int y = 95; y < 105; ++y)
        for (int x = 150; x < 170; ++x)
            view.setPixel(y * WIDTH + x, view.zbuffer()[y * WIDTH + x], x < 162 ? left[20] : right[50]);
    view.closeGaps(SPACING, &pair.model, &pair.palette);
    view.end();
    for (int y = 97; y < 103; ++y) {
        const uint8_t* const row = view.frame() + y * WIDTH;
        SAME(row[159], left[20]);
        SAME(row[162], right[50]);
        SAME(pair.palette.rampOf(row[161]), pair.palette.numberOf(right));
        NEAR(pair.palette.step(row[161]), 35, 1);
    }
}

// Openings between two objects that do not touch stay open at any distance, whether or not they are enclosed by drawn pixels.
TEST(gaps_where_there_is_no_surface)
{
    Model model;
    addPair(model, 25);
    View view;
    CHECK(view.open());
    for (int size = 4; size <= 10; size += 2)
        for (double z : {-15.0, 0.0, 15.0}) {
            const auto between = [&](const Model* with, bool round) {
                view.begin();
                const double depth = 75 + z;
                block(view, 100, 90, 160 - size / 2, 110, 7, depth);
                block(view, 160 + size / 2, 90, 220, 110, 7, depth);
                block(view, 100, 70, 220, 90, 7, depth);
                const int bottom = round ? 100 : 110;
                if (round)
                    block(view, 100, bottom, 220, 130, 7, depth);
                view.closeGaps(SPACING, with);
                view.end();
                return drawnIn(view, 160 - size / 2, 90, 160 + size / 2, bottom);
            };
            CHECK(between(nullptr, false) > 0);
            SAME(between(nullptr, true), size * 10);
            SAME(between(&model, false), 0);
            SAME(between(&model, true), 0);
        }
}

// The same for two objects above each other, with a gap that is open on one side.
TEST(slits_where_there_is_no_surface)
{
    Model model;
    addPair(model, 25, true);
    View view;
    CHECK(view.open());
    for (int high = 1; high <= 6; ++high) {
        const auto between = [&](const Model* with) {
            view.begin();
            block(view, 120, 80, 140, 120, 7, 120);
            block(view, 140, 80, 180, 100 - high / 2, 7, 120);
            block(view, 140, 100 - high / 2 + high, 180, 120, 7, 120);
            view.closeGaps(SPACING, with);
            view.end();
            return drawnIn(view, 140, 100 - high / 2, 180, 100 - high / 2 + high);
        };
        SAME(between(nullptr), 40 * high);
        SAME(between(&model), high <= 2 ? 40 * high : 0);
    }
}

namespace {

// A ball of radius 20 in the middle of the view, and the picture that it truly has.
struct BallView {
    Model model;
    Palette palette;
    View view;
    const uint8_t* ramp;

    BallView()
    {
        Motion still{};
        still.centre = point(0, 0, 0);
        CHECK(model.add(make<Sphere>(1, Real(40)), {255, 0, 0}, still));
        Anim::move(model, 0);
        CHECK(model.prepareBodies() != nullptr && view.open());
        palette.make(model, false);
        ramp = model.actor(0).object->ramp();
    }

    // The brightness of the ball at a pixel, and its depth; negative where the pixel does not show the ball.
    double trueAt(double column, double row, double* depth) const
    {
        const Camera& camera = view.camera();
        const Vec eye = vec(camera.eye), light = vec(model.light) * (1 / size(vec(model.light)));
        const Vec way{(column + 0.5 - number(camera.centreX)) / number(camera.focalX),
                      (number(camera.centreY) - row - 0.5) / number(camera.focalY), 1};
        const double a = dot(way, way), b = dot(way, eye), root = b * b - a * (dot(eye, eye) - 400);
        if (root <= 0)
            return -1.0;
        *depth = (-b - std::sqrt(root)) / a;
        return std::max(0.0, 63 * dot(eye + way * *depth, light) / 20);
    }

    // Sets a pixel to the true depth, in a colour that does not matter, if it shows the ball.
    void set(int column, int row)
    {
        double depth = 0;
        if (trueAt(column, row, &depth) >= 0)
            view.setPixel(row * WIDTH + column, static_cast<int>(depth * 128), ramp[30]);
    }

    // Draws a voxel in the colours of the ball, as one of a list that has borders to another object or not.
    void show(const Voxel& v, bool bordered)
    {
        VoxelList* const list = make<VoxelList>();
        list->begin({Real(0), Real(0), Real(0)}, Real(200), ramp);
        *list->room() = v;
        list->take();
        list->bordered = bordered;
        view.show(*list);
        destroy(list);
    }

    // Judges the pixels of columns left to right and rows 0 to bottom: returns whether all that are well inside the picture of the
    // ball show it with its depth and brightness, and no pixel shows it that is not inside or next to such a pixel.
    bool holds(int left, int right, int bottom, const char* what) const
    {
        int open = 0, wrong = 0, drawn = 0;
        double depth = 0;
        for (int y = 0; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const bool inside = trueAt(x - 1.5, y - 1.5, &depth) >= 0 && trueAt(x + 1.5, y - 1.5, &depth) >= 0 &&
                                    trueAt(x - 1.5, y + 1.5, &depth) >= 0 && trueAt(x + 1.5, y + 1.5, &depth) >= 0;
                const bool near = trueAt(x - 1, y, &depth) >= 0 || trueAt(x + 1, y, &depth) >= 0 ||
                                  trueAt(x, y - 1, &depth) >= 0 || trueAt(x, y + 1, &depth) >= 0;
                const double bright = trueAt(x, y, &depth);
                const int at = y * WIDTH + x, step = palette.step(view.frame()[at]);
                const bool shown = view.frame()[at] != 0 && view.zbuffer()[at] < 140 * 128;
                drawn += shown;
                open += inside && !shown;
                wrong += shown && !near;
                if (inside && shown)
                    wrong += std::fabs(view.zbuffer()[at] / 128.0 - depth) > 0.5 || std::fabs(step - bright) > 2.5;
            }
        note("%s: %d pixels drawn, %d left open, %d wrong", what, drawn, open, wrong);
        return open == 0 && wrong == 0 && drawn > 0;
    }
};

}  // namespace

// A missing corner of a ball's picture is drawn with the true depth and brightness of the ball. Without the model the corner stays
// open, and where the seeds lie far apart only a part of it is drawn.
TEST(surface_is_followed_from_corners)
{
    BallView ball;
    const auto played = [&](const Model* with, int right, int bottom, double spacing = 1) {
        ball.view.begin();
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x)
                if (x < 150 || x >= right || y >= bottom)
                    ball.set(x, y);
        ball.view.closeGaps(real(spacing), with, &ball.palette);
        ball.view.end();
        return ball.holds(150, right, bottom, with == nullptr ? "without the model" : "a bite");
    };
    CHECK(!played(nullptr, 175, 88));
    CHECK(played(&ball.model, 170, 88));
    CHECK(played(&ball.model, 165, 85));
    CHECK(played(&ball.model, WIDTH, 70));
    CHECK(!played(&ball.model, 170, 88, 4));
}

// The same at the edges of the screen, all along which the ball is seen.
TEST(surface_is_followed_to_the_edges_of_the_screen)
{
    BallView ball;
    Camera camera = ball.view.camera();
    camera.eye = point(0, 0, -32);
    ball.view.setCamera(camera);
    constexpr int LONG = 24, DEEP = 6;
    const struct {
        int left, top, right, bottom;
    } bites[] = {{150, 0, 150 + LONG, DEEP}, {150, HEIGHT - DEEP, 150 + LONG, HEIGHT}, {0, 90, DEEP, 90 + LONG},
                 {WIDTH - DEEP, 90, WIDTH, 90 + LONG}};
    for (const auto& bite : bites) {
        ball.view.begin();
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x)
                if (x < bite.left || x >= bite.right || y < bite.top || y >= bite.bottom)
                    ball.set(x, y);
        ball.view.closeGaps(real(0.25), &ball.model, &ball.palette);
        ball.view.end();
        int open = 0;
        for (int y = bite.top; y < bite.bottom; ++y)
            for (int x = bite.left; x < bite.right; ++x) {
                double depth = 0;
                CHECK(ball.trueAt(x, y, &depth) >= 0);
                const int at = y * WIDTH + x;
                open += ball.view.frame()[at] == 0;
                if (ball.view.frame()[at] != 0)
                    NEAR(ball.view.zbuffer()[at] / 128.0, depth, 0.5);
            }
        note("columns %d to %d, rows %d to %d: %d pixels left open", bite.left, bite.right, bite.top, bite.bottom, open);
        SAME(open, 0);
    }
}

// Of a ball only a piece a few pixels wide is drawn. Beside a narrow piece the rest of the surface is looked for, as far as the
// limit of rays allows; a broader one has an outline like any other.
TEST(surface_is_followed_from_slivers)
{
    BallView ball;
    const auto drawn = [&](int width) {
        ball.view.begin();
        for (int y = 90; y < 100; ++y)
            for (int x = 160; x < 160 + width; ++x)
                ball.set(x, y);
        ball.view.closeGaps(Real(1), &ball.model, &ball.palette);
        ball.view.end();
        int count = 0;
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x) {
                const int at = y * WIDTH + x;
                if (ball.view.frame()[at] == 0)
                    continue;
                ++count;
                double depth = 0;
                if (ball.trueAt(x, y, &depth) >= 0)
                    NEAR(ball.view.zbuffer()[at] / 128.0, depth, 0.5);
            }
        note("%d of the 10 rows' %d pixels", count, 10 * width);
        return count;
    };
    CHECK(drawn(1) > 300);
    CHECK(drawn(2) > 300);
    CHECK(drawn(5) == 50);
}

// The right end of a ball's picture is cut off, so that its outline is flat there but has no corner. Close to the viewer all of the
// end is drawn, farther away nothing of it.
TEST(ends_of_rows_are_looked_at_close_to_the_viewer)
{
    BallView ball;
    const auto open = [&](int away) {
        Camera camera = ball.view.camera();
        camera.eye = point(0, 0, -away);
        ball.view.setCamera(camera);
        double depth = 0;
        int cut = 160, missing = 0, left = 0;
        while (ball.trueAt(cut, 100, &depth) >= 0)
            ++cut;
        cut -= 4;
        ball.view.begin();
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < cut; ++x)
                ball.set(x, y);
        ball.view.closeGaps(Real(1), &ball.model, &ball.palette);
        ball.view.end();
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = cut; x < WIDTH; ++x) {
                missing += ball.trueAt(x, y, &depth) >= 0;
                left += ball.trueAt(x, y, &depth) >= 0 && ball.view.frame()[y * WIDTH + x] == 0;
                CHECK(ball.view.frame()[y * WIDTH + x] == 0 || ball.trueAt(x - 1, y, &depth) >= 0);
            }
        note("%d units away: of %d pixels that are cut off %d are left open", away, missing, left);
        CHECK(missing > 50);
        return left * 100 / missing;
    };
    CHECK(open(45) <= 10);
    CHECK(open(100) == 100);
}

// A ball is drawn too small: its right part, where the depth changes slowly, is missing, or one row near its lower end ends early.
// Where lists have borders the first is found, and most of the second; without borders neither is looked for.
TEST(outlines_that_end_early_are_looked_at_where_lists_have_borders)
{
    BallView ball;
    constexpr int CUT = 188, SHORT = 2;
    double depth = 0;
    const auto left = [&](bool bordered, int cut, int shortRow) {
        ball.view.begin();
        ball.show(voxel(0, 0, 90, 30, 30, 30), bordered);
        ball.view.end();
        for (int at = 0; at < WIDTH * HEIGHT; ++at)
            ball.view.setPixel(at, Z_EMPTY, 0);
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < cut; ++x)
                if (y != shortRow || ball.trueAt(x + SHORT, y, &depth) >= 0)
                    ball.set(x, y);
        ball.view.closeGaps(Real(1), &ball.model, &ball.palette);
        int count = 0;
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < WIDTH; ++x)
                count += ball.trueAt(x, y, &depth) >= 0 && ball.view.frame()[y * WIDTH + x] == 0;
        return count;
    };
    CHECK(left(false, CUT, -1) > 400);
    CHECK(left(true, CUT, -1) < 10);
    int bottom = 100, without = 0, with = 0;
    while (ball.trueAt(160, bottom + 1, &depth) >= 0)
        ++bottom;
    for (int row = bottom - 8; row < bottom; ++row) {
        without += left(false, WIDTH, row);
        with += left(true, WIDTH, row);
    }
    note("of %d pixels at ends of rows %d are left open with borders", without, with);
    CHECK(without >= 8 && with <= without / 2);
}

// A ball has a crack of a few rows or columns, through which something behind it shows. It is closed, if the ball's scales had
// borders to another object, even if the ball is drawn no farther than a pixel beyond the crack. What lies before the ball is truly
// open.
TEST(cracks_are_closed)
{
    BallView ball;
    constexpr int LENGTH = 24, BEHIND = 160 * 128, LEFT = 135, TOP = 80, RIGHT = 185, BOTTOM = 120, ENDED = 4;
    const auto seenThrough = [&](bool upright, int from, int wide, bool bordered, double before, int beside) {
        const int left = upright ? from : 148, right = left + (upright ? wide : LENGTH);
        const int top = upright ? 88 : from, bottom = top + (upright ? LENGTH : wide);
        View& view = ball.view;
        view.begin();
        // Beside the ball something always has borders.
        ball.show(voxel(-50, 0, 90, 5, 20, 30), true);
        ball.show(voxel(0, 0, 90, 30, 20, 30), bordered);
        block(view, 130, 70, 190, 130, 9, 170);
        // Nothing is missing around the ball's part, unless that lies before the ball.
        for (int at = 0; at < WIDTH * HEIGHT; ++at)
            view.setPixel(at, Z_EMPTY, 0);
        for (int at = 0; at < WIDTH * HEIGHT && before == 0; ++at)
            ball.set(at % WIDTH, at / WIDTH);
        for (int y = TOP; y < BOTTOM; ++y)
            for (int x = LEFT; x < RIGHT; ++x) {
                double depth = 0;
                CHECK(ball.trueAt(x, y, &depth) >= 0);
                const int beyond = (upright ? x - right : y - bottom) - beside;
                const bool amid = upright ? y > TOP && y < BOTTOM - 1 : x > LEFT && x < RIGHT - 1;
                const bool ended = amid && beyond >= 0 && beyond < ENDED;
                const bool open = ended || (y >= top && y < bottom && x >= left && x < right);
                view.setPixel(y * WIDTH + x, open ? BEHIND : static_cast<int>((depth - before) * 128), ball.ramp[open ? 10 : 30]);
            }
        view.closeGaps(Real(1), &ball.model, &ball.palette);
        view.end();
        int count = 0;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                const int at = y * WIDTH + x;
                double depth = 0;
                const double bright = ball.trueAt(x, y, &depth);
                count += view.zbuffer()[at] == BEHIND;
                if (view.zbuffer()[at] != BEHIND) {
                    NEAR(view.zbuffer()[at] / 128.0, depth, 0.5);
                    NEAR(ball.palette.step(view.frame()[at]), bright, 2.5);
                }
            }
        return count;
    };
    for (const bool upright : {false, true})
        for (int wide = 1; wide <= 6; ++wide)
            for (int from = 0; from < 12; ++from) {
                const int start = (upright ? 150 : 92) + from, all = wide * LENGTH;
                SAME(seenThrough(upright, start, wide, true, 0, WIDTH), 0);
                SAME(seenThrough(upright, start, wide, true, 0, 1), 0);
                SAME(seenThrough(upright, start, wide, false, 0, WIDTH), all);
                SAME(seenThrough(upright, start, wide, true, 15, WIDTH), all);
            }
}

// A small ball is drawn before a large one, its outline too far out or too far in by up to two pixels. Where the scales of the one
// behind had borders to another object each pixel then shows the ball that its ray meets first, with its depth and brightness;
// elsewhere all stays. What is right stays, too.
TEST(outlines_are_true)
{
    constexpr double SMALL = 10, LARGE = 45, AWAY = 75, LIMB = 119;
    constexpr int LEFT = 132, TOP = 72, RIGHT = 188, BOTTOM = 128;
    BallView ball;
    Model model;
    Motion at{};
    at.centre = point(0, 0, 0);
    CHECK(model.add(make<Sphere>(1, real(2 * SMALL)), {255, 0, 0}, at));
    at.centre = point(0, 0, AWAY);
    CHECK(model.add(make<Sphere>(2, real(2 * LARGE)), {0, 0, 255}, at));
    Anim::move(model, 0);
    CHECK(model.prepareBodies() != nullptr);
    Palette palette;
    palette.make(model, false);
    View& view = ball.view;
    // The depth of a ball's surface at a place of the picture, and its brightness there; -1 where the ball is not seen.
    const auto depthOf = [&](double column, double row, double z, double radius, double* bright) {
        const Camera& camera = view.camera();
        const Vec way{(column + 0.5 - number(camera.centreX)) / number(camera.focalX),
                      (number(camera.centreY) - row - 0.5) / number(camera.focalY), 1};
        const Vec eye = vec(camera.eye) - Vec{0, 0, z}, light = vec(model.light) * (1 / size(vec(model.light)));
        const double a = dot(way, way), b = dot(way, eye), root = b * b - a * (dot(eye, eye) - radius * radius);
        if (root <= 0)
            return -1.0;
        const double depth = (-b - std::sqrt(root)) / a;
        *bright = std::max(0.0, 63 * dot(eye + way * depth, light) / radius);
        return depth;
    };
    for (const bool bordered : {false, true})
        for (int grown = -2; grown <= 2; ++grown) {
            view.begin();
            ball.show(voxel(-50, 0, 90, 5, 20, 30), true);
            ball.show(voxel(0, 0, 90, 30, 20, 30), bordered);
            block(view, 130, 70, 190, 130, 9, 170);
            // Nothing of the large ball is missing.
            for (int pixel = 0; pixel < WIDTH * HEIGHT; ++pixel) {
                double bright = 10;
                const double behind = depthOf(pixel % WIDTH, pixel / WIDTH, AWAY, LARGE, &bright);
                view.setPixel(pixel, behind < 0 ? Z_EMPTY : static_cast<int>(behind * 128),
                              behind < 0 ? 0 : model.actor(1).object->ramp()[static_cast<int>(bright)]);
            }
            const auto pixels = [&](auto each) {
                for (int y = TOP; y < BOTTOM; ++y)
                    for (int x = LEFT; x < RIGHT; ++x)
                        each(x, y);
            };
            pixels([&](int x, int y) {
                double bright = 0, other = 10;
                const double behind = depthOf(x, y, AWAY, LARGE, &bright), depth = depthOf(x, y, 0, SMALL, &other);
                bool drawn = depth >= 0;
                for (int i = 1; i <= std::abs(grown); ++i)
                    for (int k = 0; k < 4; ++k) {
                        double unused;
                        const bool there = depthOf(x + (k - 1) % 2 * i, y + (k - 2) % 2 * i, 0, SMALL, &unused) >= 0;
                        drawn = grown > 0 ? drawn || there : drawn && there;
                    }
                CHECK(behind >= 0);
                const uint8_t* const ramp = model.actor(drawn ? 0 : 1).object->ramp();
                view.setPixel(y * WIDTH + x, static_cast<int>((!drawn ? behind : depth >= 0 ? depth : LIMB) * 128),
                              ramp[static_cast<int>(drawn ? other : bright)]);
            });
            view.closeGaps(Real(1), &model, &palette);
            view.end();
            int wrong = 0, right = 0;
            pixels([&](int x, int y) {
                double bright = 0, other;
                const bool one = depthOf(x - 0.2, y, 0, SMALL, &other) >= 0, two = depthOf(x + 0.2, y, 0, SMALL, &other) >= 0;
                const bool three = depthOf(x, y - 0.2, 0, SMALL, &other) >= 0, four = depthOf(x, y + 0.2, 0, SMALL, &other) >= 0;
                if (one != two || three != four || one != three)
                    return;
                const double depth = one ? depthOf(x, y, 0, SMALL, &bright) : depthOf(x, y, AWAY, LARGE, &bright);
                const int pixel = y * WIDTH + x, step = palette.step(view.frame()[pixel]);
                const bool isRight = std::fabs(view.zbuffer()[pixel] / 128.0 - depth) < 1.5 && std::fabs(step - bright) < 3;
                ++(isRight ? right : wrong);
            });
            note("bordered %d, grown by %d: %d pixels right, %d wrong", bordered, grown, right, wrong);
            CHECK(right > 2500);
            // A pixel whose ray the surface of one that is right hardly promises may be left.
            if (grown == 0)
                SAME(wrong, 0);
            else if (bordered)
                CHECK(wrong <= (grown == -1 ? 40 : 4));
            else
                CHECK(wrong > 60);
        }
}

// Pixels whose brightness differs much from that of those beside them get that of the ball, if the ball has borders to another
// object, and keep their depth, even one that is off by a few units. What lies well before the ball, or is no part of it, stays.
TEST(brightness_at_creases)
{
    BallView ball;
    constexpr int LEFT = 150, RIGHT = 170, TOP = 90, BOTTOM = 110;
    // Draws the ball with wrong pixels, whose brightness is off by `wrong` steps and which are `before` units too near; returns
    // how many of these are wrong afterwards. They are a comb, or two rows.
    const auto wrongAfter = [&](bool comb, int row, int wrong, double before, bool bordered) {
        View& view = ball.view;
        view.begin();
        ball.show(voxel(0, 0, 90, 30, 20, 30), bordered);
        const auto isWrong = [&](int x, int y) {
            const bool tooth = y >= TOP && y < BOTTOM && (x < LEFT + 4 || y % 4 < 2);
            return x >= LEFT && x < RIGHT && (comb ? tooth : y == row || y == row + 1);
        };
        double depth = 0;
        for (int y = 80; y < 120; ++y)
            for (int x = 135; x < 185; ++x) {
                int step = static_cast<int>(ball.trueAt(x, y, &depth));
                if (isWrong(x, y)) {
                    step += step < 32 ? wrong : -wrong;
                    depth -= before;
                }
                view.setPixel(y * WIDTH + x, static_cast<int>(depth * 128), ball.ramp[step]);
            }
        view.closeGaps(Real(1), &ball.model, &ball.palette);
        view.end();
        int count = 0;
        for (int y = 80; y < 120; ++y)
            for (int x = 135; x < 185; ++x) {
                const double bright = ball.trueAt(x, y, &depth);
                const bool stays = std::fabs(ball.palette.step(view.frame()[y * WIDTH + x]) - bright) > 2.5;
                CHECK(!stays || isWrong(x, y));
                NEAR(view.zbuffer()[y * WIDTH + x] / 128.0, depth - (isWrong(x, y) ? before : 0), 0.02);
                count += stays;
            }
        return count;
    };
    for (const bool grey : {false, true}) {
        ball.palette.make(ball.model, grey);
        ball.ramp = ball.model.actor(0).object->ramp();
        for (const double before : {-3.0, -0.5, 0.0, 0.5, 3.0})
            SAME(wrongAfter(true, 0, 20, before, true), 0);
        CHECK(wrongAfter(true, 0, 20, 8, true) > 200);
        CHECK(wrongAfter(true, 0, 10, 0, true) > 200);
        CHECK(wrongAfter(true, 0, 20, 0, false) > 200);
        // Where no crease was before, a short one is found within a few frames, and then in each.
        for (int row = 84; row < 116; ++row) {
            int frame = 0;
            while (frame < 10 && wrongAfter(false, row, 20, 0, true) > 0)
                ++frame;
            CHECK(frame < 10);
            for (int i = 0; i < 12; ++i)
                SAME(wrongAfter(false, row, 20, 0, true), 0);
            // A frame without creases.
            SAME(wrongAfter(false, 0, 0, 0, true), 0);
        }
    }
}

// Depths that change by less from pixel to pixel than into a crack, but by more over a few pixels, are those of steep surface, down
// to the edges of the screen.
TEST(steep_surface_has_no_cracks)
{
    BallView ball;
    View& view = ball.view;
    for (const int step : {200, -200})
        for (const bool upright : {false, true}) {
            view.begin();
            ball.show(voxel(0, 0, 90, 100, 100, 30), true);
            ball.show(voxel(0, 0, 90, 100, 100, 30), true);
            const auto depthAt = [&](int at) {
                const int way = upright ? at % WIDTH : at / WIDTH;
                // It comes back after seven pixels.
                return 140 * 128 + step * (way % 7);
            };
            for (int at = 0; at < WIDTH * HEIGHT; ++at)
                view.setPixel(at, depthAt(at), ball.ramp[30]);
            view.closeGaps(Real(1), &ball.model, nullptr);
            view.end();
            int changed = 0;
            for (int at = 0; at < WIDTH * HEIGHT; ++at)
                changed += view.zbuffer()[at] != depthAt(at);
            SAME(changed, 0);
        }
}

// A strip of a ball is missing between two things that stand before it. If they stand close to it, it is found; what is farther
// behind them may be missing because there is nothing.
TEST(surface_is_found_behind_gaps)
{
    BallView ball;
    const auto played = [&](double before, int high) {
        constexpr int LEFT = 150, RIGHT = 158, TOP = 80;
        ball.view.begin();
        double depth = 0;
        ball.trueAt(LEFT, TOP + high / 2, &depth);
        block(ball.view, 130, TOP - 10, 180, TOP, 7, depth - before);
        block(ball.view, 130, TOP, LEFT, TOP + high, 7, depth - before);
        block(ball.view, RIGHT, TOP, 180, TOP + high, 7, depth - before);
        ball.view.closeGaps(Real(1), &ball.model, &ball.palette);
        ball.view.end();
        int right = 0;
        for (int y = TOP; y < TOP + high; ++y)
            for (int x = LEFT; x < RIGHT; ++x) {
                ball.trueAt(x, y, &depth);
                right += std::fabs(ball.view.zbuffer()[y * WIDTH + x] / 128.0 - depth) < 0.5;
            }
        note("%d of %d pixels %.1f units behind are right", right, high * (RIGHT - LEFT), before);
        return right;
    };
    SAME(played(0.5, 10), 80);
    SAME(played(1.5, 10), 80);
    SAME(played(2, 10), 80);
    SAME(played(12, 10), 0);
}

// The right part of a ball is missing, and a scale is cut at the border that the ball has there. The rest of the ball is drawn,
// also in front of what is drawn farther away. Nothing is drawn if the scale is hidden or the cut is that of a limb. (The ball is
// so steep there that the ends of rows do not tell what is missing.)
TEST(surface_goes_on_across_borders)
{
    BallView ball;
    const auto played = [&](bool limb, double behind, double before) {
        constexpr int LEFT = 198, ROW = 100;
        ball.view.begin();
        if (behind > 0)
            block(ball.view, 0, 0, WIDTH, HEIGHT, 9, behind);
        for (int y = 0; y < HEIGHT; ++y)
            for (int x = 0; x < LEFT; ++x)
                ball.set(x, y);
        if (before > 0)
            block(ball.view, 0, 0, LEFT, HEIGHT, 9, before);
        // A scale whose right half is cut off at column LEFT.
        double depth = 0;
        ball.trueAt(LEFT - 0.5, ROW, &depth);
        const Camera& camera = ball.view.camera();
        Voxel v = voxel((LEFT - number(camera.centreX)) / number(camera.focalX) * depth,
                        (number(camera.centreY) - ROW - 0.5) / number(camera.focalY) * depth, depth, 1, 1, 30);
        v.cutX = -100;
        v.curveXX = limb ? -1 : 0;
        ball.show(v, true);
        ball.view.closeGaps(Real(1), &ball.model, &ball.palette);
        ball.view.end();
        return ball.holds(LEFT, WIDTH, HEIGHT, "beyond the border");
    };
    CHECK(played(false, 0, 0));
    CHECK(played(false, 150, 0));
    CHECK(!played(false, 0, 60));
    CHECK(!played(true, 0, 0));
}

// The waist of two balls that blend is narrow enough to count as a gap of the outline. What truly lies outside stays empty.
TEST(hollow_outlines_are_not_filled)
{
    PairView pair(25);
    const std::vector<int> owners = drawTruly(pair.view, pair.model, 0);
    const int drawn = static_cast<int>(owners.size() - static_cast<size_t>(std::count(owners.begin(), owners.end(), -1)));
    pair.view.closeGaps(SPACING, &pair.model, &pair.palette);
    pair.view.end();
    const int more = drawnIn(pair.view, 0, 0, WIDTH, HEIGHT) - drawn;
    note("%d pixels of the outline, %d filled", drawn, more);
    CHECK(drawn > 5000 && more <= 4);
}

TEST(gaps_grow_with_spacing_and_nearness)
{
    View view;
    CHECK(view.open());
    for (double z : {50.0, 100.0, 200.0})
        for (double spacing : {0.5, 1.0, 2.0, 4.0}) {
            const int widest = std::min(10 + static_cast<int>(spacing * 250 / z - 0.01), 32);
            for (int size : {widest, widest + 1}) {
                view.begin();
                block(view, 100, 50, 150, 150, 7, z);
                block(view, 150 + size, 50, 200, 150, 7, z);
                block(view, 100, 50, 200, 90, 7, z);
                block(view, 100, 90 + size, 200, 150, 7, z);
                view.closeGaps(real(spacing));
                view.end();
                SAME(drawnIn(view, 150, 90, 150 + size, 90 + size), size == widest ? size * size : 0);
            }
        }
}

TEST(gaps_open_on_a_side)
{
    View view;
    CHECK(view.open());
    for (int size = 1; size <= 10; ++size) {
        // The gap is open above, below, on both of these sides, or to the right.
        view.begin();
        block(view, 20, 20, 40, 50, 7);
        block(view, 40 + size, 20, 70, 50, 7);
        block(view, 20, 50, 70, 60, 7);
        block(view, 120, 20, 140, 50, 7);
        block(view, 140 + size, 20, 170, 50, 7);
        block(view, 120, 10, 170, 20, 7);
        block(view, 20, 120, 40, 150, 7);
        block(view, 40 + size, 120, 70, 150, 7);
        block(view, 120, 100, 150, 120, 7);
        block(view, 120, 100, 130, 150, 7);
        block(view, 120, 120 + size, 150, 150, 7);
        const int before = drawnIn(view, 0, 0, WIDTH, HEIGHT);
        view.closeGaps(SPACING);
        view.end();
        const int above = drawnIn(view, 40, 20, 40 + size, 50), below = drawnIn(view, 140, 20, 140 + size, 50);
        const int both = drawnIn(view, 40, 120, 40 + size, 150), right = drawnIn(view, 130, 120, 150, 120 + size);
        SAME(above, size <= 2 ? 30 * size : size <= 12 ? 14 * size : 0);
        SAME(below, size <= 12 ? 30 * size : 0);
        SAME(both, size <= 2 ? 30 * size : 0);
        SAME(right, size <= 6 ? 20 * size : 0);
        // No pixel beside the gap is filled.
        SAME(drawnIn(view, 0, 0, WIDTH, HEIGHT), before + above + below + both + right);
    }
}

// What is left of a row beside a slit that has been closed is a gap, too, if it is closed below.
TEST(gaps_beside_slits)
{
    View view;
    CHECK(view.open());
    for (int mirrored = 0; mirrored <= 1; ++mirrored) {
        const auto put = [&](int left, int top, int right, int bottom) {
            block(view, mirrored ? WIDTH - right : left, top, mirrored ? WIDTH - left : right, bottom, 7);
        };
        view.begin();
        // The row 80 is open over columns 105 to 114. The slit below the overhang, of columns 105 to 109, reaches down to row 81.
        put(90, 60, 110, 80);
        put(90, 80, 105, 82);
        put(115, 60, 130, 82);
        put(109, 81, 130, 82);
        put(90, 82, 130, 100);
        const int before = drawnIn(view, 0, 0, WIDTH, HEIGHT);
        view.closeGaps(SPACING);
        view.end();
        const auto drawn = [&](int left, int top, int right, int bottom) {
            return drawnIn(view, mirrored ? WIDTH - right : left, top, mirrored ? WIDTH - left : right, bottom);
        };
        SAME(drawn(105, 80, 110, 82), 10);
        const int gap = drawn(110, 60, 115, 81);
        SAME(gap, 14 * 5);
        SAME(drawnIn(view, 0, 0, WIDTH, HEIGHT), before + gap + 9);
    }
}

TEST(gaps_at_the_edges_of_the_screen)
{
    View view;
    CHECK(view.open());
    for (int high = 1; high <= 14; ++high)
        for (int size = 1; size <= 12; ++size) {
            // The gap is closed above and open at the lower end of the screen, or the other way round.
            view.begin();
            block(view, 20, 150, 40, HEIGHT, 7);
            block(view, 40 + size, 150, 70, HEIGHT, 7);
            block(view, 20, 150, 70, HEIGHT - high, 7);
            block(view, 120, 0, 140, 50, 7);
            block(view, 140 + size, 0, 170, 50, 7);
            block(view, 120, high, 170, 50, 7);
            SAME(drawnIn(view, 40, HEIGHT - high, 40 + size, HEIGHT), 0);
            SAME(drawnIn(view, 140, 0, 140 + size, high), 0);
            view.closeGaps(SPACING);
            view.end();
            SAME(drawnIn(view, 40, HEIGHT - high, 40 + size, HEIGHT), size * high);
            SAME(drawnIn(view, 140, 0, 140 + size, high), size * high);
        }
}

TEST(gaps_anywhere)
{
    // With anything on the screen, up to its edges, drawn pixels stay and new pixels look like one beside them.
    View view;
    CHECK(view.open());
    Random random;
    long closed = 0;
    for (int round = 0; round < 60; ++round) {
        const double spacing = random.between(0.25, 8);
        view.begin();
        for (int i = 2 + random.below(300); i > 0; --i) {
            const double z = random.between(60, 250);
            const Voxel v = voxel(random.between(-0.64 * z, 0.64 * z), random.between(-0.48 * z, 0.48 * z), z,
                                  random.between(0.5, 20), random.between(0.5, 20), 1 + random.below(63));
            show(view, v);
        }
        std::vector<uint8_t> frame(view.frame(), view.frame() + WIDTH * HEIGHT);
        std::vector<uint16_t> depths(view.zbuffer(), view.zbuffer() + WIDTH * HEIGHT);
        view.setPixels(true);
        view.closeGaps(real(spacing));
        view.setPixels(false);
        CHECK(std::memcmp(frame.data(), view.frame(), WIDTH * HEIGHT) == 0);
        view.closeGaps(real(spacing));
        view.end();
        long wrong = 0;
        for (int i = 0; i < WIDTH * HEIGHT; ++i) {
            const int colour = view.frame()[i], depth = view.zbuffer()[i];
            wrong += (colour != 0) != (depth != Z_EMPTY);
            if (depths[i] != Z_EMPTY)
                wrong += colour != frame[i] || depth != depths[i];
            else if (colour != 0) {
                ++closed;
                const Span& span = view.rows()[i / WIDTH];
                wrong += i % WIDTH < span.from || i % WIDTH >= span.to;
                bool like = false;
                for (int k = 1; k <= 32 && !like; ++k)
                    for (const int from : {i - k, i + k, i - k * WIDTH, i + k * WIDTH})
                        like = like || (from >= 0 && from < WIDTH * HEIGHT && view.zbuffer()[from] == depth &&
                                        view.frame()[from] == colour);
                wrong += !like;
            }
        }
        SAME(wrong, 0);
    }
    note("%ld pixels closed", closed);
    CHECK(closed > 1000);
}

TEST(spans_are_enough)
{
    // A model that moves everywhere (past the eye, out of the picture) must look the same whether clears and presents are limited
    // to spans or each frame starts on an empty screen and is presented as a whole.
    Random random;
    View limited;
    CHECK(limited.open());
    std::vector<uint8_t> screen(WIDTH * HEIGHT, 77);  // the video memory may hold anything before the first frame
    long presented = 0;
    const int frames = 120;
    for (int frame = 0; frame < frames; ++frame) {
        Scene scene;
        const double t = frame * 0.13;
        scene.ball(25, 30 * std::sin(t), 20 * std::cos(1.3 * t), -20 + 70 * std::sin(0.3 * t), 3);
        scene.ball(20, 90 * std::sin(0.9 * t), 60 * std::sin(1.1 * t), 20, 3);
        if (frame % 20 == 3)
            scene.ball(12, -20, 10 * std::sin(t), -105 + 3 * std::sin(3 * t), 2);
        // Index 0 is the background's.
        for (std::vector<uint8_t>& ramp : scene.ramps)
            std::replace(ramp.begin(), ramp.end(), uint8_t{0}, uint8_t{1});
        scene.linkAll();
        scene.report98 = frame % 2 == 1;
        scene.update();
        View fresh;
        CHECK(fresh.open());
        fresh.begin();
        limited.begin();
        for (size_t i = 0; i < scene.objects.size(); ++i)
            scene.show(i, {&fresh, &limited});
        if (frame % 3 != 1) {
            fresh.closeGaps(Real(2));
            limited.closeGaps(Real(2));
        }
        if (frame % 10 == 5) {
            const int left = random.below(WIDTH - 20), top = random.below(HEIGHT - 10);
            uint8_t* pixels = limited.overlay(left, top, 20, 10);
            std::vector<uint8_t> same(fresh.frame(), fresh.frame() + WIDTH * HEIGHT);
            for (int y = 0; y < 10; ++y)
                std::memset(pixels + (top + y) * WIDTH + left, 200, 20);
            uint8_t* other = fresh.overlay(left, top, 20, 10);
            for (int y = 0; y < 10; ++y)
                std::memset(other + (top + y) * WIDTH + left, 200, 20);
        }
        limited.end();
        fresh.end();
        CHECK(std::memcmp(fresh.frame(), limited.frame(), WIDTH * HEIGHT) == 0);
        CHECK(std::memcmp(fresh.zbuffer(), limited.zbuffer(), WIDTH * HEIGHT * 2) == 0);
        for (int y = 0; y < HEIGHT; ++y) {
            const Span& span = limited.rows()[y];
            if (span.from >= span.to)
                continue;
            CHECK(span.from >= 0 && span.to <= WIDTH && span.from % 4 == 0 && span.to % 4 == 0);
            presented += span.to - span.from;
            std::memcpy(screen.data() + y * WIDTH + span.from, limited.frame() + y * WIDTH + span.from,
                        static_cast<size_t>(span.to - span.from));
        }
        CHECK(std::memcmp(screen.data(), limited.frame(), WIDTH * HEIGHT) == 0);
    }
    const double share = static_cast<double>(presented) / (static_cast<double>(frames) * WIDTH * HEIGHT);
    note("%.0f%% of the screen presented on average", share * 100);
    // Fewer pixels are cleared and presented than with the whole screen.
    CHECK(share < 0.9);
}

namespace {

// Whether these are perpendicular unit vectors with the orientation of x, y and z.
bool areAxes(const ViewAxes& axes)
{
    const Vec right = vec(axes.right), up = vec(axes.up), ahead = vec(axes.ahead);
    const Vec side{up.y * ahead.z - up.z * ahead.y, up.z * ahead.x - up.x * ahead.z, up.x * ahead.y - up.y * ahead.x};
    return size(side - right) < 2e-4 && std::fabs(dot(up, ahead)) < 2e-4 && std::fabs(size(up) - 1) < 2e-4 &&
           std::fabs(size(ahead) - 1) < 2e-4;
}

}  // namespace

TEST(the_axes_of_a_view)
{
    const Vector x = vector(1, 0, 0), y = vector(0, 1, 0), z = vector(0, 0, 1);
    CHECK(!ViewAxes().turned && viewAlong(vector(0, 0, 77), vector(0, 3, 0), x) == ViewAxes());
    CHECK(!viewAlong(vector(0, 0, 77), vector(0, 3, 0), x).turned);
    CHECK(!viewAlong(vector(0, 0, 0), y, x).turned);
    CHECK(!leaned(ViewAxes(), 0).turned && !turnedBy(Matrix::identity(), ViewAxes()).turned);
    // When the eye looks straight up or down, its right stays where it was.
    for (double d : {1.0, -1.0}) {
        const ViewAxes axes = viewAlong(vector(0, d, 0), y, x);
        CHECK(axes.turned && axes.right == x && areAxes(axes));
        NEAR(number(axes.ahead.y), d, 1e-4);
    }
    Random random;
    for (int i = 0; i < 2000; ++i) {
        const Vector ahead = vector(random.between(-250, 250), random.between(-250, 250), random.between(-250, 250));
        ViewAxes axes = viewAlong(ahead, y, x);
        CHECK(areAxes(axes));
        CHECK(dot(vec(axes.up), Vec{0, 1, 0}) >= -1e-4);
        NEAR(number(axes.right.y), 0, 1e-4);
        axes = turnedBy(Matrix::rotation(ahead + x, random.bits()), leaned(axes, random.bits()));
        CHECK(areAxes(axes));
        const Vector v = vector(random.between(-400, 400), random.between(-400, 400), random.between(-400, 400));
        CHECK(size(vec(axes.toWorld(axes.fromWorld(v))) - vec(v)) < 1e-4 * 700);
    }
    // The eye looks nearly along the upward direction.
    for (int i = 0; i < 2000; ++i) {
        const double a = random.between(40, 100), b = random.between(-100, 100), c = random.between(-100, 100);
        const Vector ahead = vector(a + random.between(-2, 2), b + random.between(-2, 2), c + random.between(-2, 2));
        const double across = std::sqrt(a * a + b * b);
        CHECK(areAxes(viewAlong(ahead, vector(a, b, c), vector(b / across, -a / across, 0))));
    }
    // After a quarter turn to the right about the axis of sight, what was above the eye lies to its left.
    const ViewAxes quarter = leaned(ViewAxes(), 0x40000000u);
    NEAR(number(quarter.fromWorld(y).x), -1, 1e-4);
    NEAR(number(quarter.fromWorld(x).y), 1, 1e-4);
    NEAR(number(quarter.fromWorld(z).z), 1, 1e-4);
}

TEST(a_camera_that_only_moves_keeps_its_table)
{
    View view;
    CHECK(view.open());
    Camera camera;
    camera.eye = point(3, 4, 5);
    camera.axes = viewAlong(vector(1, 0, 0), vector(0, 1, 0), vector(1, 0, 0));
    view.setCamera(camera);
    CHECK(view.camera().eye == camera.eye && view.camera().axes == camera.axes);
    // A voxel straight ahead is drawn in the axes of the view wherever the eye is; with another focal length it is drawn elsewhere.
    const Voxel voxel{10 * 256, 0, 100 * 256, 256, 256, 0, 0, 40, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    view.begin();
    SAME(show(view, voxel), 1);
    const int before = 160 + 25, after = 160 + 50;
    SAME(view.frame()[100 * WIDTH + before], 40);
    camera.focalX = Real(500);
    view.setCamera(camera);
    view.begin();
    SAME(show(view, voxel), 1);
    SAME(view.frame()[100 * WIDTH + before], 0);
    SAME(view.frame()[100 * WIDTH + after], 40);
}
