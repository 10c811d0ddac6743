// Ask: a question that the user answers with the keyboard, either by typing a line or by choosing from a list. Ask takes
// the keys and gives the answer; src/app/screen.cpp draws the question.
#ifndef FB_ASK_H
#define FB_ASK_H

#include "machine.h"

class Ask {
public:
    static constexpr int NAMES_MOST = 256;
    static constexpr int LINE_ROOM = 48;  // bytes, including the final 0
    static constexpr int LINES_SHOWN = 14;

    enum State { CLOSED, LINE, LIST };
    enum Answer { OPEN, CANCELLED, GIVEN };

    // Asks for a line; `preset` is the text to begin with.
    void askLine(const char* question, const char* preset);
    // Changes the text of the question that is open.
    void setQuestion(const char* question) { question_ = question; }

    // Asks for one of `count` names, which the caller has stored in names(); `preset` is the index of the name marked first.
    machine::FileName* names() { return names_; }
    void askList(const char* question, int count, int preset);

    State state() const { return state_; }
    const char* question() const { return question_; }
    const char* line() const { return line_; }
    int count() const { return count_; }
    int chosen() const { return chosen_; }
    // Index of the first name in the part of the list that is shown.
    int firstShown() const { return first_; }

    // Takes a key. Enter returns GIVEN but leaves the question open, because the caller may still refuse the answer; ESC
    // cancels and closes the question.
    Answer key(int code);
    void close() { state_ = CLOSED; }

private:
    void choose(int index);

    State state_ = CLOSED;
    const char* question_ = "";
    char line_[LINE_ROOM] = "";
    int length_ = 0;
    machine::FileName names_[NAMES_MOST];
    int count_ = 0;
    int chosen_ = 0;
    int first_ = 0;
};

#endif
