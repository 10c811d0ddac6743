// The animation's time. At the usual speed it is the sum of the run's steps, so that a run in which nobody touches
// anything shows the run's own time to the last bit.
#include "app/pace.h"

Time Pace::at(Time now)
{
    const Time by = now - last_;
    last_ = now;
    if (running_)
        shown_ += speed_ >= 0 ? by << speed_ : by >> -speed_;
    return shown_;
}

bool Pace::change(int by)
{
    const int to = speed_ + by;
    if (to < SLOWEST || to > FASTEST)
        return false;
    speed_ = to;
    return true;
}
