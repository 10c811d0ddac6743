// Stop: whether the user wants the program to end. What takes long asks now and then, a few times in a tenth of a second on
// a 386, and ends early with its work undone.
#ifndef FB_STOP_H
#define FB_STOP_H

// What knows; set by the program, null in tests. Once it has said yes it says so until the program is back in its loop.
inline bool (*stopSource)() = nullptr;

inline bool stopAsked()
{
    return stopSource != nullptr && stopSource();
}

#endif
