// Pixels beside jumps of the depth, held against the surface.
#include "picture/contour.h"

#include "model/model.h"

using machine::HEIGHT;
using machine::WIDTH;

namespace {

// A jump is more than so many spacings: what is less is seen less, and scales are that coarse. But where there are small
// objects it is no more than so much of the size of the smallest.
constexpr Real JUMP(10);
constexpr Real JUMP_SMALL(1);
// What squares of heights, in half units, may add up to of jumps that are left as they are, for a pixel and a spacing of 1;
// and by which steps of heights it is tried.
constexpr Real LEFT(0.8);
constexpr int HEIGHT_STEP = 4;
constexpr int HEIGHTS = 64;
// In jumps, how far one object is behind another where a pixel of it that shows nowhere else is looked for.
constexpr Real DEEP(2);
// Spacing of the seeds in pixels, from which on the background is looked at too: outlines are ragged by as much.
constexpr int COARSE = 10;
// In spacings, the size of objects that are drawn by a few scales only, with which it is the same; as long as they are few, for
// with many it would be the most of the work.
constexpr Real SMALL(8);
constexpr int FEW = 16;
// Who asks for seeds farther apart than this asks for speed.
constexpr Real USUAL(2);
// Jumps are looked for at every so manyth pixel of every so manyth row, and followed from there.
constexpr int STEP_ACROSS = 4;
constexpr int STEP_DOWN = 3;

// Where surfaces cross that do not blend, it is seen at the corners of cells of so many pixels.
constexpr int CELL = 4;
// Of the field: by how much less or more than the isovalue a surface is taken for the one that is shown; difference up to which
// there is doubt which one it is.
constexpr Real SHOWN(0.08);
constexpr Real DOUBTFUL(0.1);
// Of 256 times the field, for a unit: what is too little to find the surface; and how near in units it is found.
constexpr Real STEEP(1);
constexpr Real EXACT(0.01);
// Units by which a scale may lie before its surface.
constexpr Real BEHIND(1.1);
// In spacings, what is a jump where some objects do not blend: their outlines stand out from what is behind.
constexpr Real JUMP_SHARP(4);

// 256 times the squared distance / squared size at which an object alone has the isovalue; up to how far off that its surface
// is taken to be where it was drawn; and from where on what is there is nobody's, unless all blend with all.
constexpr Real ALONE(256 * 0.25);
constexpr Real NEARLY(256 * 0.03);
constexpr Real STRONGEST(256 * 0.36);  // where two make up the isovalue, it is the stronger one
constexpr Real NOBODY(256 * 0.6);
constexpr Real CLEARLY(256 * 0.02);  // by how much less one is stronger than another
constexpr Real UNLIKELY(0.3);  // of the field
constexpr Real FAR(256 * 0.9);  // where others would have to make up for all of it

// Depths between which surfaces are drawn, units; and what lies farther to a side is not seen.
constexpr Real NEAREST(1);
constexpr Real FARTHEST(511);

constexpr int CLIMBS = 5;
constexpr int ROUNDS = 10;
// Of 256 times the field: what is taken for the isovalue, and what is too little to come near it.
constexpr Real SETTLED(256 * 0.002);
constexpr Real HOPELESS(256 * -0.004);

constexpr int NO_DEPTH = Z_EMPTY;
constexpr int beside[8] = {-1, 1, -WIDTH, WIDTH, -WIDTH - 1, -WIDTH + 1, WIDTH - 1, WIDTH + 1};

// A depth before which what lies at `near` is met, and not what lies at `far`.
inline int between(int near, int far)
{
    return far == Z_EMPTY ? NO_DEPTH : (near + far) / 2;
}

inline int least(int a, int b, int c)
{
    return a < b ? (a < c ? a : c) : b < c ? b : c;
}

// a b / 2^BITS, where a is less than 2^(BITS - 17). Of a b with 29 bits of fraction and 25 of them it makes 16 times the product.
template <int BITS>
inline Real product(Real a, int32_t b)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulHigh(a.raw * (1 << (32 - BITS)), b));
#else
    return a * (static_cast<Real>(b) / (1 << BITS));
#endif
}

// 16 v / size, of Drawn::inverse.
inline Vector inSizes(const Vector& v, int32_t inverse)
{
    return {product<25>(v.x, inverse), product<25>(v.y, inverse), product<25>(v.z, inverse)};
}

// a b / 256 with all its bits.
inline Real product256(Real a, Real b)
{
#if FB_REAL == FB_FIXED
    return Real::fromRaw(mulHigh(a.raw * 16, b.raw * 16));
#else
    return a * b / 256;
#endif
}

}  // namespace

void Contours::add(const SoftObject& object, const Rectangle& box)
{
    balls_ = balls_ && object.isBall();
    if (count_ < OBJECTS_MOST)
        drawn_[count_++] = {&object, object.ramp(), box, false, {Real(0), Real(0), Real(0)}, Real(0), 0, Real(0), Real(0)};
}

void Contours::correct(View& view, const Look& look, Real spacing, int pixels)
{
    if (!balls_)
        return;
    view_ = &view;
    queued_ = jumps_ = 0;
    setUp(look, spacing);
    if (count_ < 2 && !whole_)
        return;
    const Real jump = realFromRaw(jump_ << 9), apart = jump * Real(0.75), deep = jump * DEEP;
    deep_ = false;
    for (int i = 0; i < count_; ++i)
        for (int j = 0; j < count_; ++j) {
            const Real behind = drawn_[j].from.z - drawn_[i].from.z;
            deep_ = deep_ || behind > deep;
            if (behind > apart)
                scan(drawn_[i], drawn_[j]);
        }
    if (whole_)
        for (int i = 0; i < count_; ++i)
            if (drawn_[i].within)
                scan(drawn_[i], drawn_[i]);
    choose(pixels, spacing);
    if (!together_)
        for (int i = 0; i < count_; ++i)
            for (int j = 0; j < i; ++j)
                if (drawn_[i].within && drawn_[j].within && !linked(drawn_[i], drawn_[j]) && near(drawn_[i], drawn_[j]))
                    cross(drawn_[i], drawn_[j]);
    owner_ = nullptr;
    for (int i = 0; i < queued_; ++i) {
        const int at = queue_[i];
        if (!visit(at)) {
            seen_[at >> 3] = static_cast<uint8_t>(seen_[at >> 3] & ~(1 << (at & 7)));
            continue;
        }
        this->look(at - 1);
        this->look(at + 1);
        this->look(at - WIDTH);
        this->look(at + WIDTH);
    }
    for (int i = 0; i < queued_; ++i)
        seen_[queue_[i] >> 3] = 0;
}

// The ray at hand is from now on that through the pixel's centre.
void Contours::aim(int at)
{
    const int row = at / WIDTH, column = at - row * WIDTH;
    const Camera& c = view_->camera();
    rayX_ = mulShift16(rawFromReal(Real(column) + Real(0.5) - c.centreX), perColumn_);
    rayY_ = mulShift16(rawFromReal(c.centreY - Real(0.5) - Real(row)), perRow_);
    ray_ = {realFromRaw(rayX_ >> 12), realFromRaw(rayY_ >> 12), Real(1)};
    square_ = dot(ray_, ray_);
}

inline Vector Contours::onRay(Real depth) const
{
    return {product<28>(depth, rayX_), product<28>(depth, rayY_), depth};
}

// Where the ray comes nearest to an object's centre.
inline Real Contours::nearest(const Drawn& d) const
{
    return quotient(dot(d.from, ray_), square_);
}

// 256 times the squared distance / squared size of a place from the eye; no less than 256 where an object has no field.
inline Real Contours::param(const Drawn& d, const Vector& place) const
{
    const Vector v = place - d.from;
    if (absolute(v.x) >= d.size || absolute(v.y) >= d.size || absolute(v.z) >= d.size)
        return Real(256);
    const Vector v16 = inSizes(v, d.inverse);
    return dot(v16, v16);
}

bool Contours::linked(const Drawn& a, const Drawn& b)
{
    Real unused;
    return Model::linked(a.object, b.object, &unused) || Model::linked(b.object, a.object, &unused);
}

// Whether their surfaces may touch, blended with others or not.
bool Contours::near(const Drawn& a, const Drawn& b)
{
    const Real reach = a.size + b.size;
    const Vector apart = a.from - b.from;
    return absolute(apart.x) < reach && absolute(apart.y) < reach && absolute(apart.z) < reach;
}

// Looks for jumps where both of two rectangles are.
void Contours::scan(const Drawn& near, const Drawn& far)
{
    const Rectangle &a = near.box, &b = far.box;
    const int left = (a.left > b.left ? a.left : b.left) & ~(STEP_ACROSS - 1);
    const int right = least(a.right, b.right, WIDTH - STEP_ACROSS);
    const int top = (a.top > b.top ? a.top : b.top) | 1, bottom = least(a.bottom, b.bottom, HEIGHT - 1);
    const unsigned range = static_cast<unsigned>(2 * jump_);
    const uint16_t* row = view_->zbuffer() + top * WIDTH;
    for (int y = top; y < bottom; y += STEP_DOWN, row += STEP_DOWN * WIDTH) {
        const uint16_t* const end = row + right;
        for (const uint16_t* z = row + left; z < end; z += STEP_ACROSS)
            if (static_cast<unsigned>(z[STEP_ACROSS] - z[0] + jump_) > range)
                find(static_cast<int>(z - view_->zbuffer()), far);
    }
}

void Contours::setUp(const Look& look, Real spacing)
{
    light_.set(look.light, spacing);
    owner_ = nullptr;
    together_ = true;
    Real jump = spacing * JUMP;
    for (int i = 0; i < count_; ++i) {
        Drawn& d = drawn_[i];
        int links = 0;
        for (auto* node = d.object->skel().first(); node != nullptr; node = node->next)
            ++links;
        together_ = together_ && links == count_ - 1;
        d.from = d.object->centre() - look.eye;
        d.size = d.object->size();
        d.within = absolute(d.from.x) < FARTHEST && absolute(d.from.y) < FARTHEST && absolute(d.from.z) < FARTHEST;
        if (d.within)
            jump = ::least(jump, d.size * JUMP_SMALL);
        d.inverse = mulDiv(65536, 1 << 29, rawFromReal(d.size));
        d.inverse16 = Real(16) / d.size;
        d.inverse256 = d.inverse16 * d.inverse16;
    }
    if (!together_)
        jump = ::least(jump, spacing * JUMP_SHARP);
    jump_ = rawFromReal(jump) >> 9;
    const Camera& c = view_->camera();
    const Real fine = ::least(spacing, USUAL), coarse = fine * c.focalX * Real(1.0 / COARSE);
    whole_ = false;
    for (int i = 0; i < count_; ++i) {
        const Drawn& d = drawn_[i];
        whole_ = whole_ || (d.within && (d.from.z - shiftDown(d.size, 1) < coarse || (count_ <= FEW && d.size < fine * SMALL)));
    }
    perColumn_ = mulDiv(65536, 1 << 28, rawFromReal(c.focalX));
    perRow_ = mulDiv(65536, 1 << 28, rawFromReal(c.focalY));
}

// There is a jump from a pixel to one a step on, or the background: where? And where it is the background, may the farther
// one of two objects show there?
void Contours::find(int at, const Drawn& far)
{
    const uint16_t* const z = view_->zbuffer() + at;
    for (int i = 0; i < STEP_ACROSS; ++i) {
        const int difference = z[i + 1] - z[i];
        if (difference <= jump_ && difference >= -jump_)
            continue;
        if (z[i] != Z_EMPTY && z[i + 1] != Z_EMPTY) {
            if (jumps_ < JUMPS_MOST) {
                at_[jumps_] = static_cast<uint16_t>(at + i);
                heights_[jumps_++] = static_cast<uint16_t>((difference < 0 ? -difference : difference) >> 6);
            }
        } else if (whole_) {
            look(at + i);
            look(at + i + 1);
        } else if (deep_) {
            const int edge = difference > 0 ? at + i : at + i + 1;
            aim(edge);
            if (param(far, onRay(nearest(far))) <= ALONE)
                look(edge);
        }
    }
}

// Of the jumps that were found, leaves out the least, as many as do not matter in a picture of so many pixels; the others
// are to be visited, and what is deeper than those left out.
void Contours::choose(int pixels, Real spacing)
{
    // Each stands for those of the rows between, and only a part of them are wrong: how many is in LEFT, which is as large as
    // the error of the default animation's depths allows.
    int32_t room = mulDiv(pixels, rawFromReal(spacing * spacing * LEFT), 65536);
    if (jumps_ == JUMPS_MOST || whole_ || !together_)
        room = 0;
    int32_t squares[HEIGHTS] = {};
    for (int i = 0; i < jumps_; ++i) {
        const int step = heights_[i] / HEIGHT_STEP;
        squares[step < HEIGHTS ? step : HEIGHTS - 1] += heights_[i] * heights_[i];
    }
    int lowest = jump_ >> 6;
    for (int step = lowest / HEIGHT_STEP; step < HEIGHTS; ++step) {
        room -= squares[step];
        if (room < 0)
            break;
        // What was not found may be a little less than what was, so that nothing is left out for nothing.
        if (squares[step] != 0)
            lowest = (step + 1) * HEIGHT_STEP;
    }
    jump_ = lowest << 6 > jump_ ? lowest << 6 : jump_;
    for (int i = 0; i < jumps_; ++i)
        if (heights_[i] >= lowest) {
            look(at_[i]);
            look(at_[i] + 1);
        }
}

// A pixel that may lie beside a jump is to be visited.
inline void Contours::look(int at)
{
    uint8_t& seen = seen_[at >> 3];
    const int bit = 1 << (at & 7);
    if ((seen & bit) || queued_ == PIXELS_MOST)
        return;
    seen = static_cast<uint8_t>(seen | bit);
    queue_[queued_++] = static_cast<uint16_t>(at);
}

// Whether there is a jump beside it; then it is put right.
bool Contours::visit(int at)
{
    const int row = at / WIDTH, column = at - row * WIDTH;
    if (column < 1 || column >= WIDTH - 1 || row < 1 || row >= HEIGHT - 1)
        return false;
    const uint16_t* const z = view_->zbuffer() + at;
    const int here = *z;
    if (here == Z_EMPTY && !whole_)
        return false;
    int before = here, behind = here;
    int open = 0;
    const auto compare = [&](int to) {
        const int there = z[to];
        if (there < before)
            before = there;
        else if (there > behind)
            (there == Z_EMPTY && !whole_ ? open : behind) = there;
    };
    compare(-1);
    compare(1);
    compare(-WIDTH);
    compare(WIDTH);
    compare(-WIDTH - 1);
    compare(-WIDTH + 1);
    compare(WIDTH - 1);
    compare(WIDTH + 1);
    if (here - before <= jump_ && behind - here <= jump_)
        return deep_ && open != 0 && peek(at, here);
    if (deep_ && open != 0)
        for (const int to : beside)
            look(at + to);
    aim(at);
    if (here - before > jump_) {
        if (own(before) && grazes(between(before, here))) {
            front();
            put(at);
            return true;
        }
    }
    if (here == Z_EMPTY) {
        putAny(at, before);
        return true;
    }
    const int middle = between(here, behind);
    if (behind - here > jump_ && own(here) && !grazes(middle) && !meets(here, middle))
        uncover(at);
    return true;
}

// A pixel at the edge of all, near a jump: where what it shows is not there, another surface may be that shows nowhere else.
bool Contours::peek(int at, int here)
{
    aim(at);
    if (!own(here) || grazes(here + jump_) || meets(here, here + jump_))
        return false;
    return putAny(at, here);
}

// Whether the ray meets any surface, about a depth or elsewhere; then the pixel shows it.
bool Contours::putAny(int at, int depth)
{
    for (int i = 0; i < count_; ++i) {
        if (!drawn_[i].within)
            continue;
        // Most are far from the ray; to find what they blend with takes longer than to see that.
        if (param(drawn_[i], onRay(nearest(drawn_[i]))) > FAR && param(drawn_[i], onRay(realFromRaw(depth << 9))) >= Real(256))
            continue;
        setOwner(&drawn_[i]);
        if (grazes(NO_DEPTH) || meets(depth, NO_DEPTH)) {
            front();
            if (!together_ && buried())
                continue;
            put(at);
            return true;
        }
    }
    return false;
}

// Whether something that blends with the owner is stronger at u_: then it is not the owner's surface, and nobody's if the two do
// not blend with the same others.
bool Contours::buried() const
{
    const auto param = [&](const Along& a) { return a.param + u_ * (a.slope + u_ * a.bend); };
    const Real own = param(along_[0]);
    for (int n = 1; n < reached_; ++n)
        if (along_[n].weight >= Real(1) && own - param(along_[n]) > CLEARLY)
            return true;
    return false;
}

// The nearest surface is not what the pixel shows: it is the next one beside it. Where there are more than one, that which the
// ray meets, or else the last; where the background is looked at, it may be that.
void Contours::uncover(int at)
{
    const uint16_t* const z = view_->zbuffer() + at;
    for (int before = *z + jump_;;) {
        int next = NO_DEPTH, place = 0, farthest = 0;
        for (const int to : beside) {
            const int there = z[to];
            if (there <= before || (there == Z_EMPTY && !whole_))
                continue;
            if (there < next) {
                next = there;
                place = to;
            }
            farthest = there > farthest ? there : farthest;
        }
        if (next == NO_DEPTH)
            break;
        before = next + jump_;
        const bool last = farthest <= before;
        if (last && !(whole_ && own(next))) {
            view_->copyPixel(at, at + place);
            return;
        }
        const int most = last ? NO_DEPTH : before;
        if (own(next) && (grazes(most) || meets(next, most))) {
            front();
            put(at);
            return;
        }
        if (last)
            break;
    }
    if (!putAny(at, *z))
        view_->setPixel(at, Z_EMPTY, 0);
}

// Finds whose surface the ray meets at a depth (1/128 unit). False: nobody's that is known.
bool Contours::own(int depth)
{
    const Vector place = onRay(realFromRaw(depth << 9));
    if (owner_ != nullptr) {
        const Real p = param(*owner_, place);
        if (together_ ? p < STRONGEST : absolute(p - ALONE) < NEARLY)
            return true;
    }
    const Drawn* best = nullptr;
    if (together_) {
        Real least{256};
        for (int i = 0; i < count_; ++i) {
            const Real p = param(drawn_[i], place);
            if (p < least) {
                least = p;
                best = &drawn_[i];
            }
        }
    } else {
        // The strongest may be none of those that make up the surface.
        Real least = UNLIKELY;
        for (int i = 0; i < count_; ++i) {
            const Real off = absolute(drawn_[i].object->fieldSum(view_->camera().eye + place) - ISOVALUE);
            if (off < least && param(drawn_[i], place) < NOBODY) {
                least = off;
                best = &drawn_[i];
            }
        }
    }
    if (best == nullptr || !best->within)
        return false;
    if (best != owner_)
        setOwner(best);
    return true;
}

void Contours::setOwner(const Drawn* owner)
{
    gatherParty(parties_[0], owner);
    take(parties_[0]);
}

void Contours::gatherParty(Party& party, const Drawn* head) const
{
    party.head = head;
    party.links = 0;
    // Few are near and many may be linked.
    for (int i = 0; i < count_ && party.links < NEAR_MOST; ++i) {
        const Drawn& d = drawn_[i];
        if (d.within && near(*head, d) && Model::linked(head->object, d.object, &party.weights[party.links]))
            party.linked[party.links++] = &d;
    }
}

void Contours::take(const Party& party)
{
    party_ = &party;
    owner_ = party.head;
}

// What has a field at a depth of the ray is laid along it, the owner in any case.
void Contours::gather(Real depth)
{
    origin_ = depth;
    const Vector place = onRay(depth);
    along_[0].drawn = owner_;
    along_[0].weight = Real(1);
    lay(along_[0], place - owner_->from);
    reached_ = 1;
    for (int n = 0; n < party_->links; ++n) {
        const Drawn& d = *party_->linked[n];
        const Vector v = place - d.from;
        if (absolute(v.x) >= d.size || absolute(v.y) >= d.size || absolute(v.z) >= d.size)
            continue;
        Along& a = along_[reached_];
        a.drawn = &d;
        a.weight = party_->weights[n];
        lay(a, v);
        if (a.param < Real(256))
            ++reached_;
    }
}

// `place`: from the object's centre.
inline void Contours::lay(Along& a, const Vector& place) const
{
    const Drawn& d = *a.drawn;
    const Vector v = inSizes(place, d.inverse);
    a.param = dot(v, v);
    a.slope = shiftUp(dot(v, ray_), 1) * d.inverse16;
    a.bend = square_ * d.inverse256;
}

// Whether the ray is inside the owner's surface where it comes nearest to the owner's centre, or about there, and has met it
// before a depth; then origin_ + u_ is such a place.
bool Contours::grazes(int before)
{
    origin_ = nearest(*owner_);
    if (origin_ < NEAREST)
        return false;
    u_ = Real(0);
    const Real param = this->param(*owner_, onRay(origin_));
    if (param > FAR)
        return false;
    // Others only add to it.
    if (param > ALONE) {
        gather(origin_);
        if (reached_ == 1 || !climb())
            return false;
    }
    const Real most = realFromRaw(before << 9);
    if (origin_ + u_ < most)
        return true;
    front();
    return origin_ + u_ < most;
}

// Whether it meets it elsewhere, where others pull it: somewhere about a depth, and before another one.
bool Contours::meets(int depth, int before)
{
    const Real most = realFromRaw((before - depth) << 9), from = realFromRaw(depth << 9);
    if (param(*owner_, onRay(from)) >= Real(256))
        return false;
    gather(from);
    if (reached_ == 1)
        return false;
    for (int n = 0; n < reached_; ++n) {
        u_ = n == 0 ? Real(0) : -quotient(along_[n].slope, shiftUp(along_[n].bend, 1));
        if (u_ < most && climb()) {
            front();
            if (u_ < most)
                return true;
        }
    }
    return false;
}

// Goes from a place to where the field is greatest, until that is inside.
bool Contours::climb()
{
    const Real stride = shiftDown(owner_->size, 3);
    for (int i = 0; i < CLIMBS; ++i) {
        field(u_);
        if (value_ >= Real(0))
            return true;
        Real step = rise_ > Real(0) ? stride : -stride;
        if (bend_ < Real(0)) {
            const Real top = -rise_ / bend_;
            if (absolute(top) <= stride) {
                if (value_ + shiftDown(rise_ * top, 1) < HOPELESS)
                    return false;
                step = top;
            }
        }
        u_ += step;
    }
    return false;
}

// Goes from a place inside to the surface before it, with all that has a field there.
void Contours::front()
{
    for (int i = 0; i < ROUNDS; ++i) {
        gather(origin_ + u_);
        u_ = Real(0);
        field(u_);
        if (absolute(value_) <= SETTLED)
            return;
        if (value_ > Real(0))
            descend();
        else if (rise_ > -value_ / owner_->size)
            u_ = -value_ / rise_;
        else
            return;
    }
}

// Goes from a place inside to the surface before it.
void Contours::descend()
{
    Real inside = u_, outside{0};
    bool bracketed = false;
    const Real stride = shiftDown(owner_->size, 3);
    for (int i = 0; i < ROUNDS; ++i) {
        field(u_);
        if (absolute(value_) <= SETTLED)
            return;
        if (value_ > Real(0)) {
            inside = u_;
        } else {
            outside = u_;
            bracketed = true;
        }
        const Real under = rise_ * rise_ - shiftUp(value_ * bend_, 1);
        Real next = inside;
        if (bend_ < Real(0) && under >= Real(0))
            next = u_ + (squareRoot(under) - rise_) / bend_;
        if (next >= inside || (bracketed && next <= outside))
            next = bracketed ? shiftDown(inside + outside, 1) : inside - stride;
        else if (!bracketed)
            next = most(next, inside - shiftUp(stride, 2));
        u_ = next;
    }
    u_ = inside;
}

// Where two objects that do not blend cross, one or the other is seen, and the line between them is sharp. Its pixels are those
// where the lead changes its sign.
void Contours::cross(const Drawn& a, const Drawn& b)
{
    const int left = a.box.left > b.box.left ? a.box.left : b.box.left, right = least(a.box.right, b.box.right, WIDTH);
    const int top = a.box.top > b.box.top ? a.box.top : b.box.top, bottom = least(a.box.bottom, b.box.bottom, HEIGHT);
    if (left >= right || top >= bottom)
        return;
    gatherParty(parties_[0], &a);
    gatherParty(parties_[1], &b);
    // Of the corners of cells: bits for a and b.
    uint8_t corners[WIDTH / CELL + 1] = {};
    for (int y = top; y < bottom; y += CELL) {
        uint8_t before = 0, above = 0;
        for (int x = left, i = 0; x < right; x += CELL, ++i) {
            const Real ahead = lead(y * WIDTH + x);
            const uint8_t corner = ahead > Real(0) ? 1 : ahead < Real(0) ? 2 : 0;
            const uint8_t over = corners[i];
            corners[i] = corner;
            if ((corner | before | over | above) == 3 && x > left && y > top)
                for (int row = y - CELL; row < y; ++row)
                    for (int at = row * WIDTH + x - CELL; at < row * WIDTH + x; ++at)
                        decide(at);
            before = corner;
            above = over;
        }
    }
}

// By how much more the pixel shows the first of two objects than the second, as a difference of fields; 0: neither.
Real Contours::lead(int at)
{
    const int depth = view_->zbuffer()[at];
    if (depth == Z_EMPTY)
        return Real(0);
    aim(at);
    const Vector place = onRay(realFromRaw(depth << 9));
    const Real a = sum(parties_[0], place), b = sum(parties_[1], place);
    return absolute(most(a, b) - ISOVALUE) < SHOWN ? a - b : Real(0);
}

// The field of an object and what blends with it.
Real Contours::sum(const Party& party, const Vector& place) const
{
    const auto field = [&](const Drawn& d) { return geoff(shiftDown(param(d, place), 8)); };
    Real sum = field(*party.head);
    for (int n = 0; n < party.links; ++n)
        sum += field(*party.linked[n]) * party.weights[n];
    return sum;
}

// The pixel lies near where two objects cross: it shows that which the ray meets first.
void Contours::decide(int at)
{
    const Real ahead = lead(at);
    if (ahead == Real(0) || absolute(ahead) > DOUBTFUL)
        return;
    // What it shows cannot be told from its depth.
    const Real depth = realFromRaw(view_->zbuffer()[at] << 9);
    Real found[2];
    for (int i = 0; i < 2; ++i) {
        take(parties_[i]);
        gather(depth);
        if (!reaches())
            return;
        found[i] = u_;
    }
    // It is a third one's, before both?
    if (::least(found[0], found[1]) > BEHIND)
        return;
    if (found[0] < found[1]) {
        take(parties_[0]);
        gather(depth);
        u_ = found[0];
    }
    put(at);
}

// Whether the owner's surface is near the ray's origin; then u_ is on it.
bool Contours::reaches()
{
    u_ = Real(0);
    for (int i = 0; i < CLIMBS; ++i) {
        field(u_);
        if (rise_ < STEEP)
            return false;
        const Real step = -value_ / rise_;
        u_ += step;
        if (absolute(step) < EXACT)
            return true;
    }
    return false;
}

// The field and its derivatives at u.
void Contours::field(Real u)
{
    value_ = Real(256) * -ISOVALUE;
    rise_ = bend_ = Real(0);
    for (int n = 0; n < reached_; ++n) {
        const Along& a = along_[n];
        const Real q = a.param + u * (a.slope + u * a.bend);
        if (q >= Real(256))
            continue;
        const Real slope = a.slope + shiftUp(u * a.bend, 1), bend = shiftUp(a.bend, 1);
        // Geoff's function (field.h) with more bits.
        const Real square = product256(q, q);
        Real value = Real(256) - q * Real(22.0 / 9) + square * Real(17.0 / 9) - product256(square, q) * Real(4.0 / 9);
        const Real t = shiftDown(q, 8);
        Real second = Real(34.0 / 9) - t * Real(24.0 / 9);
        Real first = shiftDown((second + Real(34.0 / 9)) * t, 1) - Real(22.0 / 9);
        if (a.weight != Real(1)) {
            value = value * a.weight;
            first = first * a.weight;
            second = second * a.weight;
        }
        value_ += value;
        rise_ += first * slope;
        bend_ += first * bend + second * shiftDown(slope * slope, 8);
    }
}

// The pixel shows the surface that the ray meets at u_.
void Contours::put(int at)
{
    const Real depth = origin_ + u_;
    if (depth < NEAREST || depth >= FARTHEST)
        return;
    const Vector place = onRay(depth);
    Vector g{Real(0), Real(0), Real(0)};
    for (int n = 0; n < reached_; ++n) {
        const Along& a = along_[n];
        const Vector v = (place - a.drawn->from) * a.drawn->inverse16;
        const Real q = shiftDown(dot(v, v), 8);
        if (q < Real(1))
            g = g - v * (geoffSlope(q) * a.weight * a.drawn->inverse16);
    }
    view_->setPixel(at, rawFromReal(depth) >> 9, owner_->ramp[light_.brightness(normalise(g))]);
}
