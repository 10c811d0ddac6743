// The yardstick: what a dumped frame should have shown, worked out from the
// implicit surface itself.
//
// This header exists so that the tool and its tests share one description of
// a scene, of the surface a viewing ray meets, and of the figures. Nothing
// here knows of seeds, scales or the program's fixed-point numbers: the only
// common ground with the program is the dump format. All arithmetic is double
// precision, all lengths are in the model's units.
#ifndef TRUTH_H
#define TRUTH_H

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace truth {

const int WIDTH = 320, HEIGHT = 200;    // mode 13h
const int MARGIN = 2;                   // pixels traced beyond each edge
const int RAMP = 64;                    // brightness steps in a ramp
const int32_t EMPTY = 0x7FFFFFFF;       // .Z word of a pixel nothing was drawn on

struct Vec {
  double x, y, z;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(Vec a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(Vec a);

// A viewing ray. Along the viewing axis the direction is 1 long, so that the
// parameter t is the depth that .Z files hold: the distance along that axis.
struct Ray {
  Vec eye, dir;
};

// An object as the scene text gives it. Which members a kind uses is its own
// affair; `middle` and `reach` are a ball that holds the whole field.
struct Object;

// A kind of object: one row of the table in truthray.cpp. A new primitive is
// one more row. q is the squared distance to the core over the squared size,
// the argument of the Geoff function; the field is zero where q >= 1.
struct Kind {
  const char *word;   // what the scene text calls it
  int numbers;        // how many numbers follow the object's own number
  // Fills the object from the numbers. Returns what is wrong, or null.
  const char *(*set)(Object &, const double *);
  // q at a point, and its gradient if asked for.
  double (*q)(const Object &, Vec p, Vec *gradient);
  // Appends the depths along a ray at which q's smooth pieces meet; of a chain
  // of quadratics also where q = 1.
  void (*breaks)(const Object &, const Ray &, std::vector<double> &);
  // The quadratic that holds at depth t: q = c[0] + c[1] t + c[2] t^2. Null if
  // q along a ray is no chain of quadratics.
  void (*quadratic)(const Object &, const Ray &, double t, double c[3]);
  // Where it is not: bounds of q for depths in [a, b], tightening as b - a
  // shrinks.
  void (*bounds)(const Object &, const Ray &, double a, double b, double &low, double &high);
};

struct Object {
  const Kind *kind;
  int number;         // the scene's own number for it
  Vec middle;
  double reach;
  Vec a, u;           // end or centre of the core; its unit axis or normal
  double len;         // length of a segment, radius of a circle or disc
  double size;        // R: the field is zero at this distance from the core
  double size2;       // R at the core's far end, where it tapers
  Vec axis[3], half;  // a box: its unit axes, half its edges along them
  double strength = 1;  // what its field is multiplied by wherever it counts
  bool ghost = false;   // it digs into others and is linked with none: it has no surface
  // Its own space, where that is no plain one: about `centre`, along unit axes
  // of its own, stretched by these factors, then tapered, twisted and bent by
  // these amounts (a share; radians) from height -h to h along the y axis.
  // setShape() has them from a scene text, and says what is wrong, or null.
  bool plain = true;
  Vec centre, own[3], stretch{1, 1, 1};
  double taper = 0, twist = 0, bend = 0, h = 1;
  bool warped() const { return taper != 0 || twist != 0 || bend != 0; }
  // A point, or a ray, where they would be if the space were plain; what the
  // kind says of it there. A ray's t stays, and its lines stay straight.
  const char *setShape(const std::string &word, const double *numbers);
  // What a distance of so much at a point may be at most there, times this.
  double steepest(Vec p, double distance) const;
  Vec plainPoint(Vec p) const;
  Ray plainRay(const Ray &) const;
  double q(Vec p, Vec *gradient) const;
  void breaks(const Ray &, std::vector<double> &) const;
  bool quadratic() const { return kind->quadratic && !warped(); }
  void quadratic(const Ray &, double t, double c[3]) const;
  void bounds(const Ray &, double a, double b, double &low, double &high) const;
};

struct Colour {
  double r, g, b;     // 0 to 255
};

// What an object has besides its colour.
struct Coat {
  enum Finish { MATT, SHINY, MIRROR } finish = MATT;
  enum Pattern { NONE, CHECKS, STRIPES, MARBLE } pattern = NONE;
  double grain = 0;                      // size of the pattern
  Colour colour{0, 0, 0};                // its other colour
  Vec middle{0, 0, 0}, axis[3];          // where it lies
};

struct Scene {
  double time = 0;                       // seconds
  Vec eye{0, 0, 0};
  Vec right{1, 0, 0}, up{0, 1, 0}, ahead{0, 0, 1};  // how the eye stands
  double focalX = 0, focalY = 0;         // pixels
  double centreX = 0, centreY = 0;       // pixels
  Vec light{0, 0, 0};                    // unit vector towards the light
  double isovalue = 0.5;
  double ambient = 0;                    // share of the ramp that needs no light
  // Steps of light in a step of the ramp: light is what the ambient share
  // leaves. Figures of brightness are in steps of light, so that a frame in
  // colour is judged as strictly as one in grey, which has no ambient share.
  double lightSteps() const { return ambient < 1 ? 1 / (1 - ambient) : 1; }
  std::vector<Object> objects;
  std::vector<std::vector<double>> weight;  // [i][j]: scale of what j adds to i: their link's less what j digs into i; 0: neither
  std::vector<std::vector<double>> link;    // [i][j]: the weight of their link alone, the same both ways
  double highlight = 1;                  // light above which a colour turns towards white
  std::map<int, Colour> ramps;           // object number -> colour at full light, but for the highlight
  std::vector<Coat> coats;               // of each object
  bool mixed = false;                    // a point has the mean of the colours by their objects' fields
  // A point's colour is more than that of its object.
  bool painted() const {
    bool any = mixed;
    for (const Coat &c : coats) any = any || c.finish != Coat::MATT || c.pattern != Coat::NONE;
    return any;
  }
};

// The Geoff function of q = r^2/R^2 and its derivative by q; 0 beyond q = 1.
double geoff(double q);
double geoffSlope(double q);

// The kind of this name, or null.
const Kind *findKind(const std::string &word);

// Reads a scene text. False, and the reason with its line in `why`, if it is
// not one; a scene that names anything unknown is not one, because leaving an
// object out would give wrong figures.
bool parseScene(const std::string &text, const std::string &name, Scene &, std::string &why);

// What a ray meets first.
struct Hit {
  double depth = -1;  // -1: no surface
  float shade = 0;    // ramp steps, 0 to 63, not rounded
  int object = -1;    // index of the object whose own field is strongest there
  // One of another colour is as strong, as where cores coincide: the point's
  // colour is either's, and is not judged.
  bool tied = false;
  // Of a painted scene: its colour at full light, and whether it turns into white above that.
  Colour colour{0, 0, 0};
  bool shines = false;
  bool any() const { return depth >= 0; }
};

// The first meeting of rays with one scene's surface. The scene must outlive
// it. trace() may be called from several threads.
class Tracer {
public:
  explicit Tracer(const Scene &);
  // The ray through image position (column, row); pixel i's centre is i + 0.5.
  Hit trace(double column, double row) const;
  // The same, looking only at the objects listed by index.
  Hit trace(double column, double row, const int *which, int count) const;
  // Whether the ray through this pixel's row (column) can meet object i at all.
  bool inRow(int i, double row) const;
  bool inColumn(int i, double column) const;
  // The eye lies inside the surface: there is no picture to speak of.
  bool eyeInside() const;
  // The field of a body at a point, its gradient, and the object whose own
  // field is the strongest; unchanged where nothing reaches.
  double field(int number, Vec p, Vec *gradient, int *strongest) const;
  // The body of an object: objects that links join, directly or through
  // others, have the same. -1: it has no surface.
  int bodyOf(int object) const { return body[object]; }
  // The brightness that a finish gives a point, 0 to 1, from its outward normal.
  double brightness(const Coat &, Vec normal) const;
  // The colour of a point of a body, the strongest object of which is known.
  Colour colour(int object, Vec p) const;
  // For tests: do not use that a sum is enough where all are linked alike.
  void forgetPlain();
private:
  struct Work;
  double first(const Work &, const int *which, int n, int members, const double *form, const char *known, bool sum,
               double a, double b) const;
  double strengthened(int object, Vec p) const;
  bool digs(int object, const int *members, int n) const;
  bool tie(int object, Vec p) const;
  bool follow(const Work &, int object, double a, double b, double *form) const;
  const Scene &scene;
  std::vector<int> body;     // of each object
  std::vector<char> plain;   // of each body: every pair is linked with weight 1
  int bodies = 0;
  bool usePlain = true;
};

// A picture's worth of hits, with MARGIN pixels beyond each edge so that the
// neighbours of pixels at the edge are known too.
class Picture {
public:
  Picture() : hits((WIDTH + 2 * MARGIN) * (HEIGHT + 2 * MARGIN)) {}
  // Traces every pixel on this many threads (1 or more).
  void trace(const Scene &, int threads);
  const Hit &at(int column, int row) const {
    return hits[(row + MARGIN) * (WIDTH + 2 * MARGIN) + column + MARGIN];
  }
  bool eyeInside = false;
private:
  std::vector<Hit> hits;
};

// A dumped frame.
struct Frame {
  Scene scene;
  std::vector<uint8_t> rgb;   // WIDTH * HEIGHT * 3
  std::vector<int32_t> z;     // WIDTH * HEIGHT, 16.16 units
  bool grey = false;          // every drawn pixel is grey
  // The brightness of a drawn pixel in ramp steps can be told: the frame is
  // grey or the scene gives the ramps' colours.
  bool shaded() const { return grey || !scene.ramps.empty(); }
  bool drawn(int column, int row) const { return z[row * WIDTH + column] != EMPTY; }
  double depth(int column, int row) const { return z[row * WIDTH + column] / 65536.0; }
  const uint8_t *pixel(int column, int row) const { return &rgb[3 * (row * WIDTH + column)]; }
};

// What the colours of a frame's pixels tell: whose they are and how bright. A
// ramp's colours are those of the dump: 64 steps of light, of which a palette
// may hold fewer, six bits a channel. Objects of one colour share a ramp, and
// nothing tells them apart. A frame without ramps is read as grey.
class Ramps {
public:
  explicit Ramps(const Scene &);
  // The ramp of an object, by index; -1: none.
  int of(int object) const { return object < 0 ? -1 : ofObject[object]; }
  // The ramp that a pixel's colour comes from; -1: none, or more than one comes
  // as near.
  int shown(const uint8_t *rgb) const;
  // The brightness of a pixel in ramp steps. `object` is the index of the
  // object that should be there, or -1; its ramp is taken if it fits as well as
  // any.
  double step(const uint8_t *rgb, int object) const;
  // The colour for an object's brightness in ramp steps.
  void paint(int object, double step, uint8_t *rgb) const;
  // Both where the true point is known, of a painted scene too. `miss` is how far
  // the pixel's colour is from all that this point has under any light.
  double step(const uint8_t *rgb, const Hit &, double *miss = nullptr) const;
  void paint(const Hit &, uint8_t *rgb) const;
  // The scene is painted, and its frame has colours.
  bool painted() const { return paints && !steps.empty(); }
private:
  struct Reading {
    int ramp;                  // as shown() has it
    int nearest;
    std::vector<double> miss;  // of each ramp: distance from its nearest colour, squared
    std::vector<double> step;  // and the brightness there
  };
  const Reading &read(const uint8_t *rgb) const;
  struct Steps {
    uint8_t rgb[RAMP][3];
  };
  Steps stepsOf(const Colour &, bool shines) const;
  const Steps &stepsAt(const Hit &) const;
  double ambient, highlight;
  bool paints;
  mutable std::unordered_map<uint32_t, Steps> pointSteps;
  std::vector<int> ofObject;
  std::vector<Steps> steps;
  mutable std::unordered_map<uint32_t, Reading> known;
};

// Reads DIR/F<n>.TXT, .PPM and .Z. False and a reason if any is missing or bad.
bool readFrame(const std::string &dir, long n, Frame &, std::string &why);
bool readScene(const std::string &path, Scene &, std::string &why);
bool readFile(const std::string &path, std::string &data, std::string &why);
bool writeFile(const std::string &path, const std::string &data, std::string &why);
bool writePpm(const std::string &path, int width, int height, const std::vector<uint8_t> &rgb,
              std::string &why);
// The numbers of the frames in a directory, ascending.
bool listFrames(const std::string &dir, std::vector<long> &, std::string &why);
std::string frameName(const std::string &dir, long n, const char *extension);

// Makes the frame that the surface itself would give: grey, or in the ramps'
// colours if the scene has them.
void drawTruth(const Scene &, const Picture &, Frame &);

// The figures of one frame or, added up, of a run. Counts are of pixels.
struct Figures {
  long frames = 0, eyeInside = 0;
  long surface = 0;        // surface there
  long drawn = 0;          // something drawn
  long interior = 0;       // surface there and at all eight neighbours
  long holes = 0;          // interior, nothing drawn
  long seeThrough = 0;     // interior, drawn more than 4 units behind
  long outside = 0;        // drawn, no surface within a distance of 2
  long outsideBox = 0;     // drawn, no surface in the 5 by 5 square round it
  long missing = 0;        // surface there, nothing drawn, interior or not
  long both = 0;           // drawn, surface there
  double depth2 = 0;       // sum of squared depth errors over those
  long smooth = 0;         // those with no jump of the true depth beside them
  double smooth2 = 0;
  long shaded = 0;         // those whose brightness can be told
  double shade2 = 0;       // sum of squared brightness errors, steps of light
  long coloured = 0;       // those whose object can be told by its colour
  long wrongColour = 0;    // of another object's colour, none of which is truly within a distance of 1
  long borderTrue = 0;     // pairs of those above and beside each other, of two objects by the truth
  long border = 0;         // and by their colours
  long pairs = 0;          // pairs of frames close enough in time for flicker
  long flickerBase = 0;    // drawn pixels of the second frame of such pairs
  long flicker = 0;        // brightness jumps where the true one does not
  long flickerEdge = 0;    // the same, counting what appears or vanishes too
  void add(const Figures &);
  double depthRms() const;
  double smoothRms() const;
  double shadeRms() const;
  double colourShare() const;      // percent of drawn pixels
  double borderRatio() const;      // 1: as long as the true borders
  double seeThroughShare() const;  // percent, as are the next four
  double outsideShare() const;
  double outsideBoxShare() const;
  double flickerShare() const;
  double flickerEdgeShare() const;
};

const double BEHIND = 4.0;             // units: further behind is see-through
const double PAIR = 1 / 70.0 + 0.001;  // seconds; the scene gives milliseconds

// Holds a frame against its truth.
Figures compare(const Frame &, const Picture &);
// Adds the flicker between two consecutive frames to the later one's figures,
// if they are close enough in time and both can be read.
void compareFlicker(const Frame &before, const Picture &beforeTruth,
                    const Frame &after, const Picture &afterTruth, Figures &);

// Ours, the truth and the difference side by side: 968 x 200.
const int SHEET_WIDTH = 3 * WIDTH + 8;
std::vector<uint8_t> sheet(const Frame &, const Picture &);

}  // namespace truth

#endif
