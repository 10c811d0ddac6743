// Contours: where one surface ends in the picture before another, or cuts through one that it does not blend with. Scales are
// flat squares, so the line that they make together is a little off the true one. Beside a deep jump of the depth that is seen
// as a ragged outline, and a pixel that is wrong there is wrong by the whole jump. So those pixels, and no others, are held
// against the surface itself: the ray through the pixel's centre meets it or does not.
//
// It takes looking for jumps in a part of the Z-buffer, following each along the outline, and for a pixel a look at the field
// where the ray comes nearest to the centre of the object at hand; a few hundred instructions. What would matter least is left
// out (see choose() in contour.cpp).
#ifndef FB_CONTOUR_H
#define FB_CONTOUR_H

#include "surface/shade.h"
#include "model/softobj.h"
#include "picture/view.h"

class Contours {
public:
    // Starts a frame: no object is drawn yet.
    void begin()
    {
        count_ = 0;
        balls_ = true;
    }

    // An object as it has just been drawn, with the ramp that it has now, and where it was drawn. No more than OBJECTS_MOST are
    // taken.
    void add(const SoftObject& object, const Rectangle& box);

    // Puts right the pixels beside jumps of the depth, and those where surfaces cross that do not blend, when all is drawn and
    // gaps are closed. Only where all objects are balls. What lies behind is the background only where the viewer is near, or
    // where objects are small and few. `spacing` of the seeds, units; `pixels` that are drawn, about.
    void correct(View& view, const Look& look, Real spacing, int pixels);

private:
    static constexpr int OBJECTS_MOST = 128;
    // Pixels looked at in a frame, at most; what is left over stays as it was drawn.
    static constexpr int PIXELS_MOST = 4096;

    // An object as it was drawn.
    struct Drawn {
        const SoftObject* object;
        const uint8_t* ramp;
        Rectangle box;
        bool within;              // near enough for the numbers here
        Vector from;              // from the eye to its centre
        Real size;
        int32_t inverse;              // 1 / size, 29 bits of fraction
        Real inverse16, inverse256;   // 16 / size, and that squared
    };

    // Its field along the ray at hand: 256 times the squared distance / squared size is param + u (slope + u bend) at u units
    // of depth from origin_.
    struct Along {
        const Drawn* drawn;
        Real weight;
        Real param, slope, bend;
    };

    // An object and what blends with it.
    struct Party {
        const Drawn* head;
        int links;
        const Drawn* linked[NEAR_MOST];
        Real weights[NEAR_MOST];
    };

    void setUp(const Look& look, Real spacing);
    void scan(const Drawn& near, const Drawn& far);
    void find(int at, const Drawn& far);
    void choose(int pixels, Real spacing);
    void look(int at);
    bool visit(int at);
    bool peek(int at, int here);
    bool putAny(int at, int depth);
    bool buried() const;
    void uncover(int at);
    void aim(int at);
    Vector onRay(Real depth) const;
    Real nearest(const Drawn& d) const;
    Real param(const Drawn& d, const Vector& place) const;
    bool own(int depth);
    void setOwner(const Drawn* owner);
    void gatherParty(Party& party, const Drawn* head) const;
    void take(const Party& party);
    static bool linked(const Drawn& a, const Drawn& b);
    static bool near(const Drawn& a, const Drawn& b);
    void cross(const Drawn& a, const Drawn& b);
    Real lead(int at);
    Real sum(const Party& party, const Vector& place) const;
    void decide(int at);
    bool reaches();
    bool grazes(int before);
    bool meets(int depth, int before);
    void gather(Real depth);
    void lay(Along& along, const Vector& place) const;
    bool climb();
    void front();
    void descend();
    void field(Real u);
    void put(int at);

    Drawn drawn_[OBJECTS_MOST];
    int count_ = 0;
    bool deep_;                       // some object is far behind another
    bool whole_;                      // the background is looked at too
    bool together_;                   // all blend with all others
    bool balls_ = true;               // all are balls

    Party parties_[2];
    const Drawn* owner_ = nullptr;    // of the surface in question: the head of party_
    const Party* party_ = parties_;

    // The ray at hand: x and y for a unit of depth, 28 bits of fraction, and as a vector; its square.
    int32_t rayX_, rayY_;
    Vector ray_;
    Real square_;
    Real origin_;                     // a depth
    Along along_[NEAR_MOST + 1];      // what has a field about there, the owner first
    int reached_ = 0;
    Real u_;                          // the place at hand
    Real value_, rise_, bend_;        // 256 times the field there, less the isovalue, and its derivatives by u

    View* view_ = nullptr;
    ShadeSetup light_;
    int32_t perColumn_, perRow_;      // 1 / focal, 28 bits of fraction
    int jump_ = 0;                    // depth steps
    // Jumps that were found: the pixel on their left, and their heights in half units.
    static constexpr int JUMPS_MOST = 1024;
    uint16_t at_[JUMPS_MOST];
    uint16_t heights_[JUMPS_MOST];
    int jumps_ = 0;
    uint16_t queue_[PIXELS_MOST];
    int queued_ = 0;
    uint8_t seen_[machine::WIDTH * machine::HEIGHT / 8] = {};
};

#endif
