// The time of the animation. At the usual speed it is the sum of the time steps of the run, so that without any input it
// equals the time of the run to the last bit.
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
