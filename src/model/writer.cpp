// Writer: writes every statement that the reader reads.
#include "writer.h"

#include "math/text.h"
#include "rt.h"

namespace {

const char* const WARP_WORDS[WARP_PARTS] = {"taper", "twist", "bend"};
const char* const AXIS_WORDS[3] = {"x", "y", "z"};

// The order in which periodic motions are written.
const MotionPart PERIODIC_PARTS[] = {MOTION_CIRCLE, MOTION_PATH, MOTION_SPIN, MOTION_SWING, MOTION_PULSE};

// Copies the first motion of a part other than a path to `*move`. Returns false if there is none.
bool firstMove(const Motion& m, MotionPart part, Move* move)
{
    move->part = part;
    if (part == MOTION_CIRCLE) {
        move->a = m.u;
        move->b = m.v;
        move->wave = m.circle;
        return m.circle.period != Real(0);
    }
    if (part == MOTION_SPIN) {
        move->a = m.spinAxis;
        move->wave = m.spin;
    } else if (part == MOTION_SWING) {
        move->a = m.swingAxis;
        move->amount = m.swingAngle;
        move->wave = m.swing;
    } else {
        move->amount = m.pulse;
        move->wave = m.pulsing;
    }
    return (m.parts & part) != 0;
}

// The axis of a path after the first. A path with an amplitude of 0 may be written along any axis that has a path already.
int axisOf(const Motion& m, const Move& move)
{
    const Real none(0);
    const bool still = move.a == Vector{none, none, none};
    if (still ? m.along[0].period != none : move.a.x != none)
        return 0;
    return (still ? m.along[1].period != none : move.a.y != none) ? 1 : 2;
}

// Returns true if all objects are linked with each other at one weight, `*common`.
bool allLinked(const Model& model, Real* common)
{
    Real weight;
    for (int i = 0; i < model.count(); ++i) {
        for (int j = 0; j < i; ++j) {
            if (!Model::linked(model.actor(i).object, model.actor(j).object, &weight))
                return false;
            if (i == 1)
                *common = weight;
            if (weight != *common)
                return false;
        }
    }
    return model.count() > 1;
}

}  // namespace

// --- Words and lines

Writer& Writer::word(const char* text)
{
    if (length_ > 0 && length_ < LINE_MOST)
        line_[length_++] = ' ';
    while (*text != 0 && length_ < LINE_MOST)
        line_[length_++] = *text++;
    return *this;
}

// Writes the shortest text that reads back as the value.
Writer& Writer::number(Real value)
{
    char text[24];
    formatReal(text, sizeof text, value);
    return word(text);
}

Writer& Writer::phase(const Wave& wave)
{
    return number(realFromRaw(static_cast<int32_t>(wave.phase >> 16)));
}

Writer& Writer::period(const Wave& wave)
{
    word("period").number(wave.period);
    return wave.phase != 0 ? word("phase").phase(wave) : *this;
}

// Writes the weight of a link or a dent, unless it is 1.
Writer& Writer::weight(Real weight)
{
    return weight != Real(1) ? number(weight) : *this;
}

void Writer::end()
{
    line_[length_] = '\n';
    line_[length_ + 1] = 0;
    good_ = good_ && put_(to_, line_);
    length_ = 0;
}

// --- Statements

bool Writer::write(const Model& model)
{
    if (model.title[0] != 0) {
        word("title").word(model.title);
        end();
    }
    camera(model);
    if (model.mixed) {
        word("colours").word("mixed");
        end();
    }
    for (int i = 0; i < model.items(); ++i)
        item(model, model.item(i));
    look(model);
    dents(model);
    links(model);
    return good_;
}

// Writes the viewer and the light, except for what names an item.
void Writer::camera(const Model& model)
{
    const Camera& camera = model.camera;
    if (camera.carrier == 0) {
        word("eye").vector(toVector(camera.eye));
        end();
    }
    if (camera.looks == Camera::AT_POINT) {
        word("look").vector(toVector(camera.target));
        end();
    }
    if (camera.roll != Real(0)) {
        word("roll").number(camera.roll);
        end();
    }
    word("focal").number(camera.focalX).number(camera.focalY);
    end();
    word("light").vector(model.light);
    end();
}

// Writes an object, a group or the eye's group, with its motion.
void Writer::item(const Model& model, const Actor& actor)
{
    const Motion& m = actor.motion;
    if (actor.number == model.camera.carrier)
        word("eye").vector(toVector(m.centre));
    else if (actor.object == nullptr)
        word("group").word(actor.name);
    else
        object(actor);
    if (actor.number != model.camera.carrier && !(m.centre == Point{Real(0), Real(0), Real(0)}))
        word("at").vector(toVector(m.centre));
    if (m.parts & MOTION_TURN)
        word("turn").vector(m.turn);
    if (!(actor.stretch == Vector{Real(1), Real(1), Real(1)}))
        word("stretch").vector(actor.stretch);
    if (m.scale != Real(1))
        word("scale").number(m.scale);
    if (actor.object != nullptr)
        word("colour").colour(actor.colour);
    const Actor* parent = m.parent == 0 ? nullptr : model.itemNumbered(m.parent);
    if (parent != nullptr)
        word("in").word(parent->name);
    end();
    coat(actor);
    motion(actor);
    warp(actor);
    keys(model, actor);
}

// Writes the kind, name and measures of an object. An object without a kind, made in code, is written as a sphere.
void Writer::object(const Actor& actor)
{
    if (actor.kind == nullptr) {
        word("sphere").word(actor.name).word("size").number(actor.measure[0]);
        return;
    }
    word(actor.kind->word).word(actor.name);
    for (int i = 0; i < actor.kind->measures; ++i)
        word(actor.kind->measure[i].word).number(actor.measure[i]);
}

// Writes what an object's surface shows, and the strength of its field.
void Writer::coat(const Actor& actor)
{
    const Coat& coat = actor.coat;
    if (coat.finish != FINISH_MATT) {
        word("finish").word(actor.name).word(FINISH_WORDS[coat.finish]);
        end();
    }
    if (coat.pattern != PATTERN_NONE) {
        word("pattern").word(actor.name).word(PATTERN_WORDS[coat.pattern]).number(coat.grain).colour(coat.colour);
        end();
    }
    if (actor.strength != Real(1)) {
        word("strength").word(actor.name).number(actor.strength);
        end();
    }
}

// Writes the periodic motions: the first of each part, then the further ones.
void Writer::motion(const Actor& actor)
{
    const Motion& m = actor.motion;
    for (MotionPart part : PERIODIC_PARTS) {
        Move first;
        if (part == MOTION_PATH)
            path(actor);
        else if (firstMove(m, part, &first))
            move(actor, first);
        for (int i = 0; i < m.moreCount; ++i)
            if (m.more[i].part == part)
                move(actor, m.more[i]);
    }
}

void Writer::move(const Actor& actor, const Move& move)
{
    switch (move.part) {
    case MOTION_CIRCLE:
        word("circle").word(actor.name).word("u").vector(move.a).word("v").vector(move.b).period(move.wave);
        break;
    case MOTION_PATH:
        word("path").word(actor.name).word(AXIS_WORDS[axisOf(actor.motion, move)]);
        number(move.a.x + move.a.y + move.a.z).number(move.wave.period).phase(move.wave);
        break;
    case MOTION_SPIN: word("spin").word(actor.name).word("axis").vector(move.a).period(move.wave); break;
    case MOTION_SWING:
        word("swing").word(actor.name).word("axis").vector(move.a).word("angle").number(move.amount).period(move.wave);
        break;
    default: word("pulse").word(actor.name).word("by").number(move.amount).period(move.wave); break;
    }
    end();
}

// Writes the first path along each axis.
void Writer::path(const Actor& actor)
{
    const Motion& m = actor.motion;
    if ((m.parts & MOTION_PATH) == 0)
        return;
    word("path").word(actor.name);
    const Real amplitude[3] = {m.path.x, m.path.y, m.path.z};
    for (int i = 0; i < 3; ++i)
        if (m.along[i].period != Real(0))
            word(AXIS_WORDS[i]).number(amplitude[i]).number(m.along[i].period).phase(m.along[i]);
    end();
}

void Writer::warp(const Actor& actor)
{
    for (int i = 0; i < WARP_PARTS; ++i) {
        const Swaying& part = actor.motion.warp[i];
        const bool swings = part.wave.period != Real(0);
        if (part.amount == Real(0) && !swings)
            continue;
        word(WARP_WORDS[i]).word(actor.name).number(part.amount);
        if (swings)
            word("swing").number(part.swing).period(part.wave);
        end();
    }
}

void Writer::keys(const Model& model, const Actor& actor)
{
    const Motion& m = actor.motion;
    if (m.keyCount > 0 || m.smooth || m.repeat > 0) {
        word("keys").word(actor.name).word(m.smooth ? "smooth" : "linear");
        if (m.repeat > 0)
            word("repeat").number(realFromRaw(m.repeat));
        word("axis").vector(m.keyAxis);
        end();
    }
    for (int i = 0; i < m.keyCount; ++i) {
        const Key& key = model.keys()[m.firstKey + i];
        word("key").word(actor.name).number(realFromRaw(key.time));
        vector({key.value[0], key.value[1], key.value[2]});
        if (key.value[3] != Real(0))
            word("angle").number(key.value[3]);
        if (key.value[4] != Real(1))
            word("scale").number(key.value[4]);
        end();
    }
}

// Writes the name of the item that the eye looks at.
void Writer::look(const Model& model)
{
    const Actor* seen = model.camera.looks == Camera::AT_ITEM ? model.itemNumbered(model.camera.item) : nullptr;
    if (seen == nullptr)
        return;
    word("look").word(seen->name);
    end();
}

void Writer::dents(const Model& model)
{
    for (int i = 0; i < model.count(); ++i) {
        const Actor& dug = model.actor(i);
        for (const List<Link>::Node* node = dug.object->dents().first(); node != nullptr; node = node->next) {
            word("dent").word(dug.name).word(model.itemNumbered(node->item.object->number())->name).weight(node->item.weight);
            end();
        }
    }
}

// Writes one line if all links are alike, else a line for each link.
void Writer::links(const Model& model)
{
    Real weight(1);
    if (allLinked(model, &weight)) {
        word("blend").word("all").weight(weight);
        end();
        return;
    }
    for (int i = 0; i < model.count(); ++i) {
        for (int j = 0; j < i; ++j) {
            if (!Model::linked(model.actor(i).object, model.actor(j).object, &weight))
                continue;
            word("blend").word(model.actor(i).name).word(model.actor(j).name).weight(weight);
            end();
        }
    }
}
