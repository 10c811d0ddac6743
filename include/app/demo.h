// Demo: the program. It reads the switches, plays the model or lets the user edit it, and prints the statistics.
#ifndef FB_DEMO_H
#define FB_DEMO_H

// Runs the whole program and returns its exit status: 0 after a normal end, 1 for a failure, 2 for a command line that is
// not understood.
int demo(int count, char** arguments);

#endif
