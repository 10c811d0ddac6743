// Ask: a question that the user answers with the keyboard: a line to type, or one of a list. It takes keys and tells the
// answer; src/app/screen.cpp draws it.
#ifndef FB_ASK_H
#define FB_ASK_H

#include "machine.h"

class Ask {
public:
    static constexpr int NAMES_MOST = 256;
    static constexpr int LINE_ROOM = 48;  // with the final 0
    static constexpr int LINES_SHOWN = 14;

    enum State { CLOSED, LINE, LIST };
    enum Answer { OPEN, CANCELLED, GIVEN };

    // Asks for a line; `preset` stands in it already.
    void askLine(const char* question, const char* preset);
    // Changes the words of the question that is open.
    void setQuestion(const char* question) { question_ = question; }

    // Asks for one of `count` names, which the caller has put into names(); `preset` is the first one marked.
    machine::FileName* names() { return names_; }
    void askList(const char* question, int count, int preset);

    State state() const { return state_; }
    const char* question() const { return question_; }
    const char* line() const { return line_; }
    int count() const { return count_; }
    int chosen() const { return chosen_; }
    // The first name of the part of the list that is shown.
    int firstShown() const { return first_; }

    // Takes a key. Enter gives the answer and leaves the question open, for it may not be the last word; ESC cancels
    // and closes it.
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
