// Pace: how the time of the animation follows the time of the run: held, let go, stepped, slower, faster, begun again.
#ifndef FB_PACE_H
#define FB_PACE_H

#include "model/anim.h"

class Pace {
public:
    // Each step of the speed doubles or halves it, from an eighth to eight times.
    static constexpr int FASTEST = 3;
    static constexpr int SLOWEST = -3;

    explicit Pace(bool running) : running_(running) {}

    // The animation's time where the run's time is `now`, which never goes back.
    Time at(Time now);

    bool running() const { return running_; }
    void setRunning(bool running) { running_ = running; }

    // Moves the animation's time on by hand; back to its start.
    void step(Time by) { shown_ += by; }
    void restart() { shown_ = 0; }

    // 1 faster, -1 slower. False: it is at the end of its range.
    bool change(int by);
    // 0: as the scene has it; n: 2^n times as fast.
    int speed() const { return speed_; }

private:
    Time last_ = 0;
    Time shown_ = 0;
    int speed_ = 0;
    bool running_;
};

#endif
