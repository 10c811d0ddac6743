// Saving and loading scenes while the program runs, and screenshots.
#include "app/shot.h"
#include "loop.h"

namespace {

constexpr const char* SCENES = ".FB";
constexpr int SHOTS_MOST = 9999;

bool isThere(const char* name)
{
    const int file = machine::openFile(name);
    if (file >= 0)
        machine::closeFile(file);
    return file >= 0;
}

// Returns the file name at the end of a path.
const char* nameOf(const char* path)
{
    const char* name = path;
    for (const char* c = path; *c != 0; ++c)
        if (*c == '/' || *c == '\\' || *c == ':')
            name = c + 1;
    return name;
}

// Tells whether two names are equal up to their first dots, ignoring case.
bool sameStem(const char* a, const char* b)
{
    const auto letter = [](char c) { return c == '.' ? '\0' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; };
    while (letter(*a) == letter(*b) && letter(*a) != 0) {
        ++a;
        ++b;
    }
    return letter(*a) == letter(*b);
}

}  // namespace

void Demo::askSave()
{
    // The preset is the name saved last, or else a name that is not in use.
    char name[sizeof saved_];
    snprintf(name, sizeof name, "%s", saved_[0] != 0 ? saved_ : "SAVED.FB");
    for (int n = 2; saved_[0] == 0 && n < 100 && isThere(name); ++n)
        snprintf(name, sizeof name, "SAVED%d.FB", n);
    replaces_[0] = 0;
    ask_.askLine("save the scene as", name);
}

void Demo::askLoad()
{
    // List the scenes of the current directory, then those beside the program whose names are not in the list yet.
    machine::FileName* names = ask_.names();
    int count = listedHere_ = machine::listFiles("", SCENES, names, Ask::NAMES_MOST);
    if (directory_[0] != 0) {
        const int beside = machine::listFiles(directory_, SCENES, names + count, Ask::NAMES_MOST - count);
        for (int i = 0; i < beside; ++i) {
            const machine::FileName name = names[listedHere_ + i];
            bool listed = false;
            for (int j = 0; j < listedHere_; ++j)
                listed = listed || sameStem(names[j].text, name.text);
            if (!listed)
                names[count++] = name;
        }
    }
    if (count == 0) {
        say("no scenes here");
        return;
    }
    int marked = 0;
    for (int i = 0; i < count; ++i)
        if (sameStem(names[i].text, nameOf(saved_[0] != 0 ? saved_ : scene_)))
            marked = i;
    ask_.askList("load a scene", count, marked);
}

// Passes a key to the open question and acts on its answer.
void Demo::answer(int code)
{
    if (ask_.key(code) != Ask::GIVEN)
        return;
    if (ask_.state() == Ask::LIST) {
        char name[sizeof scene_];
        const int chosen = ask_.chosen();
        snprintf(name, sizeof name, "%s%s", chosen < listedHere_ ? "" : directory_, ask_.names()[chosen].text);
        ask_.close();
        load(name, true);
        say(editor_.message());
        return;
    }
    char name[sizeof saved_];
    snprintf(name, sizeof name, "%s%s", ask_.line(), strchr(nameOf(ask_.line()), '.') == nullptr ? SCENES : "");
    if (strcmp(name, saved_) != 0 && strcmp(name, replaces_) != 0 && isThere(name)) {
        // The file exists: the user must press Enter a second time.
        strcpy(replaces_, name);
        ask_.setQuestion("that file is there: Enter replaces it");
        return;
    }
    ask_.close();
    if (editor_.save(name))
        strcpy(saved_, name);
    say(editor_.message());
}

// Loads a scene. On failure it returns false, and the model stays. The editor's message tells the result.
bool Demo::load(const char* name, bool undoable)
{
    char text[sizeof scene_ + 10];
    snprintf(text, sizeof text, "loading %s", name);
    busy(text);
    snprintf(scene_, sizeof scene_, "%s", name);
    if (!editor_.load(name, spacing_, undoable))
        return false;
    saved_[0] = 0;
    pace_.restart();
    orbit_.reset();
    shown_ = 0;
    changed();
    return true;
}

// Loads the scene that follows the current one in the directory of the program, and shows its title.
void Demo::nextScene()
{
    machine::FileName* names = ask_.names();
    const int count = machine::listFiles(directory_, SCENES, names, Ask::NAMES_MOST);
    if (count == 0) {
        say("no scenes beside the program");
        return;
    }
    int next = 0;
    for (int i = 0; i < count; ++i)
        if (sameStem(names[i].text, nameOf(scene_)))
            next = (i + 1) % count;
    char path[sizeof scene_], text[TITLE_ROOM + sizeof(machine::FileName) + 4];
    snprintf(path, sizeof path, "%s%.31s", directory_, names[next].text);
    if (!load(path, false)) {
        say(editor_.message());
        return;
    }
    snprintf(text, sizeof text, "%.*s%s%s", static_cast<int>(strlen(names[next].text) - strlen(SCENES)),
             names[next].text, model_.title[0] != 0 ? ": " : "", model_.title);
    say(text);
}

// Writes the frame as SHOTnnnn.PCX, with the next number that is not in use.
void Demo::shoot()
{
    shotWanted_ = false;
    char name[24], text[40];
    do {
        if (shots_ == SHOTS_MOST) {
            say("no number left for a picture");
            return;
        }
        snprintf(name, sizeof name, "SHOT%04d.PCX", ++shots_);
    } while (isThere(name));
    const char* problem = writePcx(name, view_.frame(), palette_.dac());
    snprintf(text, sizeof text, "picture in %s", name);
    say(problem != nullptr ? problem : text);
}
