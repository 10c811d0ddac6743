// Scene: the model and its motion as a text that people write by hand, and that the editor saves (the report's "some
// way of scripting animations and reading in models from files").
//
// One statement a line; words separated by blanks; everything behind a '#' is a comment; upper and lower case are the
// same. Lines end with LF or CR LF; a Ctrl-Z ends the text, as DOS editors have it. Numbers are decimal. The README.md
// of tools/scenes describes the statements.
#ifndef FB_SCENE_H
#define FB_SCENE_H

#include "model/model.h"

// Limits, beside those of Model (128 objects, 64 groups, 1,024 keys; every pair of objects may be linked, and each may dig
// into each other). A line may
// be LINE_MOST characters long, without its end; a text SCENE_LINES_MOST lines.
constexpr int LINE_MOST = 250;
constexpr int SCENE_LINES_MOST = 32000;

// The ranges of numbers, units, seconds, degrees. Places and amplitudes lie within +-SPACE.
constexpr Real PERIOD_LEAST(0.1);
constexpr Real PERIOD_MOST(3600);
constexpr Real KEY_TIME_MOST(3600);
constexpr Real DEGREES_MOST(360);
constexpr Real KEY_DEGREES_MOST(3600);
constexpr Real PULSE_MOST(0.75);
constexpr Real WEIGHT_MOST(4);  // of a link and of a dent
constexpr Real GRAIN_LEAST(1);
constexpr Real GRAIN_MOST(100);
constexpr int FOCAL_LEAST = 1;
constexpr int FOCAL_MOST = 500;

// How reading or writing ended, as the program's exit status has it.
enum SceneEnd { SCENE_GOOD = 0, SCENE_TROUBLE = 1, SCENE_BAD = 2 };

// Reads a scene file into an empty model; where there is no file of that name, and it has no ending, ".FB" is tried.
// Null, or one line that names the file, the line, what was read and what was
// expected; the model is then only good for being destroyed. `*end` tells bad files (and missing ones) from memory that
// ran out.
const char* readScene(const char* name, Model& model, SceneEnd* end);

// The same from memory, for texts that never were files, as tests make them; `name` is what a complaint calls it.
const char* readSceneText(const char* name, const char* text, uint32_t length, Model& model, SceneEnd* end);

// Writes the model as a scene file that reads back as the same model. Null, or one line that says why not.
const char* writeScene(const char* name, const Model& model);

// The same by way of a function that takes the text line by line (each with its LF); false from it ends the writing.
bool writeSceneText(bool (*put)(void* to, const char* line), void* to, const Model& model);

#endif
