// Scene files: opens and saves them. The Reader (reader.h) reads the text, the Writer (writer.h) writes it.
#include "model/scene.h"

#include "machine.h"
#include "reader.h"
#include "rt.h"
#include "writer.h"

namespace {

const char* readFrom(const char* name, Source& source, Model& model, SceneEnd* end)
{
    Reader reader(name, source, model);
    const bool good = reader.read();
    *end = reader.end();
    return good ? nullptr : reader.complaint();
}

// Returns true if the last part of a path has an extension.
bool hasEnding(const char* name)
{
    bool dot = false;
    for (const char* c = name; *c != 0; ++c)
        dot = *c == '.' || (dot && *c != '/' && *c != '\\');
    return dot;
}

// Opens a scene. The name is tried as given first; WALK may also stand for WALK.FB. Returns a negative number if there is no
// such file; `*trouble` then says why the name as given failed. If the longer name is used, it is stored in `longer` and
// becomes `*name`.
int openScene(const char** name, char (&longer)[PLAIN_ROOM], const char** trouble)
{
    static const char* const ENDINGS[] = {".FB", ".fb"};
    const int asGiven = machine::openFile(*name);
    *trouble = machine::fileTrouble();
    const size_t length = strlen(*name);
    if (asGiven >= 0 || hasEnding(*name) || length == 0 || length + 4 > sizeof longer)
        return asGiven;
    for (const char* ending : ENDINGS) {
        strcpy(longer, *name);
        strcpy(longer + length, ending);
        const int file = machine::openFile(longer);
        if (file >= 0) {
            *name = longer;
            return file;
        }
    }
    return asGiven;
}

bool putToFile(void* to, const char* line)
{
    return machine::writeFile(*static_cast<int*>(to), line, static_cast<uint32_t>(strlen(line))) >= 0;
}

}  // namespace

const char* readScene(const char* name, Model& model, SceneEnd* end)
{
    char longer[PLAIN_ROOM];
    const char* trouble;
    const int file = openScene(&name, longer, &trouble);
    if (file < 0) {
        *end = SCENE_BAD;
        return troubleWith(name, trouble);
    }
    Source source(file);
    const char* wrong = readFrom(name, source, model, end);
    machine::closeFile(file);
    return wrong;
}

const char* readSceneText(const char* name, const char* text, uint32_t length, Model& model, SceneEnd* end)
{
    Source source(text, length);
    return readFrom(name, source, model, end);
}

bool writeSceneText(bool (*put)(void* to, const char* line), void* to, const Model& model)
{
    return Writer(put, to).write(model);
}

const char* writeScene(const char* name, const Model& model)
{
    int file = machine::beginSave(name);
    bool good = file >= 0;
    if (good) {
        good = writeSceneText(putToFile, &file, model);
        good = machine::endSave(file, good);
    }
    return good ? nullptr : troubleWith(name, machine::fileTrouble());
}
