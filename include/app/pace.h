// Pace: derives the time of the animation from the time of the run. The animation can be paused, resumed, stepped, slowed
// down, sped up and restarted.
#ifndef FB_PACE_H
#define FB_PACE_H

#include "model/anim.h"

class Pace {
public:
    // The speed is 2^step: from 1/8 to 8 times the usual speed.
    static constexpr int FASTEST = 3;
    static constexpr int SLOWEST = -3;

    explicit Pace(bool running) : running_(running) {}

    // Returns the time of the animation when the time of the run is `now`; `now` must never decrease.
    Time at(Time now);

    bool running() const { return running_; }
    void setRunning(bool running) { running_ = running; }

    // Advance the time of the animation by `by`, and reset it to the start.
    void step(Time by) { shown_ += by; }
    void restart() { shown_ = 0; }

    // Changes the speed by one step: `by` is 1 (faster) or -1 (slower). Returns false at the end of the range.
    bool change(int by);
    // The animation runs 2^speed() times as fast as the scene prescribes.
    int speed() const { return speed_; }

private:
    Time last_ = 0;
    Time shown_ = 0;
    int speed_ = 0;
    bool running_;
};

#endif
