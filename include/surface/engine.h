// The two ways in which the surface of an object is found (model/surface.h): ours and the report's.
#ifndef FB_ENGINE_H
#define FB_ENGINE_H

#include "model/surface.h"

// Ours: finds the surface of the body's field (model/body.h) with as little work as we know, in one way for every kind of object
// and any graph of links. Null: no memory, or the user wants to stop.
Surface* makeEngine(SoftObject& object);

// The report's own methods, as printed (/P).
Surface* makeReport98(SoftObject& object);

#endif
