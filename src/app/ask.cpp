// The keys that edit a line and choose from a list.
#include "app/ask.h"

#include "rt.h"

void Ask::askLine(const char* question, const char* preset)
{
    state_ = LINE;
    question_ = question;
    length_ = snprintf(line_, sizeof line_, "%s", preset);
    if (length_ >= LINE_ROOM)
        length_ = LINE_ROOM - 1;
}

void Ask::askList(const char* question, int count, int preset)
{
    state_ = LIST;
    question_ = question;
    count_ = count;
    first_ = 0;
    choose(preset);
}

void Ask::choose(int index)
{
    chosen_ = index < 0 ? 0 : index >= count_ ? count_ - 1 : index;
    if (chosen_ < first_)
        first_ = chosen_;
    if (chosen_ >= first_ + LINES_SHOWN)
        first_ = chosen_ - LINES_SHOWN + 1;
}

Ask::Answer Ask::key(int code)
{
    if (code == machine::KEY_ESC) {
        close();
        return CANCELLED;
    }
    if (state_ == LINE) {
        if (code == machine::KEY_ENTER)
            return length_ > 0 ? GIVEN : OPEN;
        if (code == machine::KEY_BACKSPACE && length_ > 0)
            line_[--length_] = 0;
        // Characters that a file name may contain; DOS may still refuse the name.
        if (code > ' ' && code <= '~' && strchr("\"*?<>|", code) == nullptr && length_ + 1 < LINE_ROOM) {
            line_[length_++] = static_cast<char>(code);
            line_[length_] = 0;
        }
        return OPEN;
    }
    switch (code) {
    case machine::KEY_ENTER: return GIVEN;
    case machine::KEY_UP: choose(chosen_ - 1); break;
    case machine::KEY_DOWN: choose(chosen_ + 1); break;
    case machine::KEY_PGUP: choose(chosen_ - LINES_SHOWN); break;
    case machine::KEY_PGDN: choose(chosen_ + LINES_SHOWN); break;
    case machine::KEY_HOME: choose(0); break;
    default: break;
    }
    return OPEN;
}
