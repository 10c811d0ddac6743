// Stop: whether the user wants the program to end. Long computations ask now and then, a few times in a tenth of a second on a
// 386, and return early with their work unfinished.
#ifndef FB_STOP_H
#define FB_STOP_H

// Answers the question; the program sets it, and in tests it is null. Once it has returned true it goes on returning true until
// the program is back in its main loop.
inline bool (*stopSource)() = nullptr;

inline bool stopAsked()
{
    return stopSource != nullptr && stopSource();
}

#endif
