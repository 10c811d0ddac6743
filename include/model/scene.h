// Scene: the model and its motion as a text that people write by hand, and that the editor saves (the report's "some way of
// scripting animations and reading in models from files").
//
// A line holds one statement; its words are separated by blanks; text after a '#' is a comment; upper and lower case are
// equivalent. Lines end with LF or CR LF; a Ctrl-Z ends the text, as DOS editors write it. Numbers are decimal. The README.md
// of tools/scenes describes the statements.
#ifndef FB_SCENE_H
#define FB_SCENE_H

#include "model/model.h"

// Limits, besides those of Model (128 objects, 64 groups, 1,024 keys; every pair of objects may be linked, and each object may
// dig into each other). A line may be LINE_MOST characters long, without its end, and a text SCENE_LINES_MOST lines.
constexpr int LINE_MOST = 250;
constexpr int SCENE_LINES_MOST = 32000;

// The ranges of numbers, in units, seconds or degrees. Coordinates and amplitudes lie within +-SPACE.
constexpr Real PERIOD_LEAST(0.1);
constexpr Real PERIOD_MOST(3600);
constexpr Real KEY_TIME_MOST(3600);
constexpr Real DEGREES_MOST(360);
constexpr Real KEY_DEGREES_MOST(3600);
constexpr Real PULSE_MOST(0.75);
constexpr Real WEIGHT_MOST(4);  // of a link or a dent
constexpr Real GRAIN_LEAST(1);
constexpr Real GRAIN_MOST(100);
constexpr int FOCAL_LEAST = 1;
constexpr int FOCAL_MOST = 500;

// How reading or writing ended; the program's exit status has the same values.
enum SceneEnd { SCENE_GOOD = 0, SCENE_TROUBLE = 1, SCENE_BAD = 2 };

// Reads a scene file into an empty model. If there is no file of that name, and the name has no extension, ".FB" is appended.
// Returns null, or one line that names the file, the line, the text read and the text expected; the model can then only be
// destroyed. `*end` distinguishes bad and missing files from lack of memory.
const char* readScene(const char* name, Model& model, SceneEnd* end);

// Like readScene(), from a text in memory, as tests have it; complaints call the text `name`.
const char* readSceneText(const char* name, const char* text, uint32_t length, Model& model, SceneEnd* end);

// Writes the model as a scene file that reads back as the same model. Returns null, or one line that says why it failed.
const char* writeScene(const char* name, const Model& model);

// Like writeScene(), but calls a function for each line (with its LF); when that returns false, writing ends.
bool writeSceneText(bool (*put)(void* to, const char* line), void* to, const Model& model);

#endif
