// FieldProbe: evaluates the field of a model; quickly where one point lies near the one before.
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

private:
    // An object whose field reaches the point. `body` is the first of its body's members, or null if the object has no surface. In
    // bodies that are not plain, `weighted` is the sum that the object has in its body, `share` its field over the strongest.
    struct Part {
        int slot;
        SoftObject* const* body;
        Real field, weighted, share;
        SoftObject::FieldPlace place;
    };

    void gather(const Point& p, const Bodies& bodies);
    Real fieldOf(const Part& one, int* strongest);

    const Model* model_;
    // The objects that may reach points less than AROUND away from `middle_` along each axis; unknown while `count_` is negative.
    Point middle_;
    int count_ = -1;
    struct Near {
        const SoftObject* object;
        int slot;
        SoftObject* const* body;  // Part::body
    };
    Near near_[Model::OBJECTS_MOST];
    // The parts at the point that implicitAt() was given last, the chosen body and its field.
    Part parts_[Model::OBJECTS_MOST];
    Part* end_ = parts_;
    const Part* chosen_ = nullptr;
    Real highest_;
};

#endif
