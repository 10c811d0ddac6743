// Demo: the program. Reads its switches, plays the model or lets the user play with it, and reports.
#ifndef FB_DEMO_H
#define FB_DEMO_H

// The whole program; returns its exit status: 0 after a normal end, 1 for trouble, 2 for a command line it cannot
// follow.
int demo(int count, char** arguments);

#endif
