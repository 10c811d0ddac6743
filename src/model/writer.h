// Writer: writes a model as the text of a scene file that the reader reads back as the same model.
#ifndef FB_WRITER_H
#define FB_WRITER_H

#include "model/scene.h"

class Writer {
public:
    // Calls `put` for each line; when `put` returns false, the writing ends.
    Writer(bool (*put)(void*, const char*), void* to) : put_(put), to_(to) {}

    bool write(const Model& model);

private:
    // Words and numbers are gathered in line_ until end() writes it. No line is longer than LINE_MOST.
    Writer& word(const char* text);
    Writer& number(Real value);
    Writer& vector(const Vector& v) { return number(v.x).number(v.y).number(v.z); }
    Writer& colour(const Colour& c) { return number(Real(c.red)).number(Real(c.green)).number(Real(c.blue)); }
    Writer& phase(const Wave& wave);
    Writer& period(const Wave& wave);
    Writer& weight(Real weight);
    void end();

    void camera(const Model& model);
    void item(const Model& model, const Actor& actor);
    void object(const Actor& actor);
    void coat(const Actor& actor);
    void motion(const Actor& actor);
    void move(const Actor& actor, const Move& move);
    void path(const Actor& actor);
    void warp(const Actor& actor);
    void keys(const Model& model, const Actor& actor);
    void look(const Model& model);
    void dents(const Model& model);
    void links(const Model& model);

    bool (*put_)(void*, const char*);
    void* to_;
    bool good_ = true;
    int length_ = 0;
    char line_[LINE_MOST + 2];
};

#endif
