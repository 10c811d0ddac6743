// Words: splits a text into lines and words, converts words to the values they stand for, and complains about a word that is
// not what was expected. Nothing here knows what a scene consists of.
#ifndef FB_WORDS_H
#define FB_WORDS_H

#include "model/paint.h"
#include "model/scene.h"

// Room for a name in a message, with the final 0: longer paths lose their middle.
constexpr int PLAIN_ROOM = 260;

bool isLetter(char c);  // lower case only
bool isDigit(char c);

// Writes and returns the complaint "NAME: WHAT". It holds until the next complaint of any kind.
const char* troubleWith(const char* name, const char* what);

// The source of the characters: a file, or a text in memory.
class Source {
public:
    explicit Source(int file) : file_(file) {}
    Source(const char* text, uint32_t length) : at_(text), end_(text + length) {}

    // Returns the next character, -1 at the end, or -2 when the file cannot be read.
    int next();

private:
    int file_ = -1;
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    char buffer_[1024];
};

// Functions that return bool return false after they have complained, except for nextWord(), is() and isEmpty().
class Words {
public:
    Words(const char* name, Source& source) : name_(name), source_(source) {}

    SceneEnd end() const { return end_; }
    const char* complaint() const;

protected:
    // Reads the next line; `*there` becomes false after the last line.
    bool nextLine(bool* there);
    // Reads the next word of the line, in lower case. Returns false, with an empty word, at the end of the line or at a
    // comment. With `hash` a word may begin with '#'.
    bool nextWord(bool hash = false);
    // Complains that `what` was expected instead of the latest word, or of the text that word_ has been set to. Returns false.
    bool expected(const char* what);
    bool expectedAtMost(int most, const char* what);
    // Complains about something that is not the fault of the text. Returns false.
    bool trouble(const char* what);

    bool is(const char* word) const { return strcmp(word_, word) == 0; }
    bool isEmpty() const { return word_[0] == 0; }

    // These functions read values from the next words. In complaints, `what` says what the value is.
    bool readReal(const char* what, Real least, Real most, Real* value);
    bool readColour(Colour* colour);
    // Reads three numbers. In complaints the name of the axis follows `what`: "degrees about ", or "a place, ".
    bool readVector(const char* what, Real least, Real most, Vector* value);
    bool readPlace(const char* what, Vector* value);
    bool readDirection(const char* what, Vector* value);
    // Reads a name, which becomes the latest word: a letter, then letters, digits, '-' or '_'.
    bool readName(const char* what);
    bool readEnd();
    // Converts the latest word to a number.
    bool realIs(const char* what, Real least, Real most, Real* value);
    // The rest of the line with its upper and lower case, without the blanks around it and without a comment.
    const char* restOfLine(int* length);
    // Makes a part of the line, with its upper and lower case, the word that a complaint is about.
    void quote(const char* text, int length);

    const char* name_;
    const char* at_ = nullptr;  // the rest of the line after the word
    const char* word_ = "";

private:
    static constexpr int WORD_ROOM = 32;

    bool tooLong(int length);
    bool hexColour(Colour* colour);
    bool expectedColour();

    Source& source_;
    SceneEnd end_ = SCENE_GOOD;
    int line_ = 0;
    bool over_ = false;
    char text_[LINE_MOST + 1];
    char room_[WORD_ROOM];
};

#endif
