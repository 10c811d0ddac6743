// Words: a text line by line and word by word, the values that words stand for, and the complaint where one is not what was
// expected. Nothing here knows what a scene is made of.
#ifndef FB_WORDS_H
#define FB_WORDS_H

#include "model/paint.h"
#include "model/scene.h"

// Names in messages are whole as long as no path is longer than this.
constexpr int PLAIN_ROOM = 260;

bool isLetter(char c);  // a small one
bool isDigit(char c);

// The complaint "NAME: WHAT". It holds until the next one, of whatever kind.
const char* troubleWith(const char* name, const char* what);

// Where the characters come from: a file, or a text in memory.
class Source {
public:
    explicit Source(int file) : file_(file) {}
    Source(const char* text, uint32_t length) : at_(text), end_(text + length) {}

    // The next character; -1 at the end, -2 when the file cannot be read.
    int next();

private:
    int file_ = -1;
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    char buffer_[1024];
};

// Every function that returns a bool says by false that it has complained, but for nextWord() and is().
class Words {
public:
    Words(const char* name, Source& source) : name_(name), source_(source) {}

    SceneEnd end() const { return end_; }
    const char* complaint() const;

protected:
    // The next line; `*there` is false behind the last.
    bool nextLine(bool* there);
    // The next word of the line, in lower case; false, and the word is empty, at its end or a comment. With `hash` a word may
    // begin with '#'.
    bool nextWord(bool hash = false);
    // What was read instead of what was expected: a complaint about the word read last, or about `word_` as it was set.
    bool expected(const char* what);
    bool expectedAtMost(int most, const char* what);
    // A complaint about what is no fault of the text.
    bool trouble(const char* what);

    bool is(const char* word) const { return strcmp(word_, word) == 0; }
    bool isEmpty() const { return word_[0] == 0; }

    // The values of the next words. `what` says in the complaint what the value is.
    bool readReal(const char* what, Real least, Real most, Real* value);
    bool readColour(Colour* colour);
    // Three numbers. The name of the axis follows `what`: "degrees about ", or "a place, ".
    bool readVector(const char* what, Real least, Real most, Vector* value);
    bool readPlace(const char* what, Vector* value);
    bool readDirection(const char* what, Vector* value);
    // A name, which becomes the word read last: a letter, then letters, digits, '-' or '_'.
    bool readName(const char* what);
    bool readEnd();
    // The word read last as a number.
    bool realIs(const char* what, Real least, Real most, Real* value);
    // All that is left of the line, in its own letters, without the blanks around it and without a comment.
    const char* restOfLine(int* length);
    // Makes some of the line's own characters the word that a complaint is about.
    void quote(const char* text, int length);

    const char* name_;
    const char* at_ = nullptr;  // what follows the word in the line
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
