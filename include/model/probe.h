// FieldProbe: evaluates the field of a model; quickly where many points lie near each other.
#ifndef FB_PROBE_H
#define FB_PROBE_H

#include "model/model.h"

class FieldProbe {
public:
    // The model must not change as long as the probe is used. A null model has no field to evaluate.
    explicit FieldProbe(const Model* model) : model_(model) {}
    const Model* model() const { return model_; }

    // The greatest of the bodies' fields (model/body.h) at a point, or the field of the body that `member` belongs to; 0 where none
    // reaches. `*strongest` receives the index of that body's member whose own field is the strongest, which gives the point its
    // colour; -1 if none reaches, or the bodies are not known (Model::knownBodies()).
    Real implicitAt(const Point& p, int* strongest, const SoftObject* member = nullptr);
    // That index, of all bodies.
    int strongestAt(const Point& p)
    {
        int strongest;
        implicitAt(p, &strongest);
        return strongest;
    }

    // Where the field is less than this no surface is near.
    static constexpr Real FAINT{0.05};

    // The gradient of the field at the point that implicitAt() was given last, of the body that it chose: world axes, 1/unit, times
    // CORE_SIZE. Zero where the field is less than FAINT.
    Vector gradient() const;

    // Where colours mix, so that each object has a paint: the place in the box of colours (Paints::inBox()) to which those of the
    // chosen body mix at that point.
    Vector mixture() const;

private:
    // An object whose field reaches the point. `body` is the first of its body's members, or null if the object has no surface. In
    // bodies that are not plain, `weighted` is the sum that the object has in its body, `square` that of its field over the
    // strongest.
    struct Part {
        int slot;
        SoftObject* const* body;
        Real field, weighted, square;
        SoftObject::FieldPlace place;
    };

    // An object, and the first of its body's members, or null if it has no surface.
    struct Member {
        const SoftObject* object;
        SoftObject* const* body;
    };
    // Space is divided into cubes. Many cubes share a cell, which holds one of them at a time, with a list of the objects whose
    // fields may reach it: the cube that was asked for last.
    struct Cell {
        int x, y, z;     // the cube's number along each axis
        int count = -1;  // of the objects; -1: no cube
        uint8_t slots[Model::OBJECTS_MOST];
    };
    static_assert(Model::OBJECTS_MOST <= 256, "a slot fits a byte");
    static constexpr int CELLS = 64;

    void begin();
    const Cell& cellAt(const Point& p);
    void gather(Cell& cell) const;
    Real sumOf(SoftObject* const* body, const Part** strongest) const;
    Real blendOf(SoftObject* const* body, Real most);

    const Model* model_;
    // Filled when the field is first asked for; then memberCount_ is not negative. Each cube has one cell that may hold it.
    Member members_[Model::OBJECTS_MOST];
    int memberCount_ = -1;
    Cell cells_[CELLS];
    // The parts at the point that implicitAt() was given last, the chosen body and its field.
    Part parts_[Model::OBJECTS_MOST];
    Part* end_ = parts_;
    const Part* chosen_ = nullptr;
    Real highest_;
};

#endif
