// The yardstick: computes from the implicit surface itself what a dumped frame should have shown.
//
// This header exists so that the tool and its tests share one description of a scene, of the point where a viewing ray
// meets the surface, and of the figures. It knows nothing of seeds, scales or the program's fixed-point numbers: the dump
// format is all that it shares with the program. All arithmetic is in double precision, all lengths are in model units.
#ifndef TRUTH_H
#define TRUTH_H

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace truth {

const int WIDTH = 320, HEIGHT = 200;    // mode 13h
const int MARGIN = 2;                   // pixels traced beyond each edge of the picture
const int RAMP = 64;                    // brightness steps of a ramp
const int32_t EMPTY = 0x7FFFFFFF;       // word in a .Z file for a pixel that nothing was drawn on

struct Vec {
  double x, y, z;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(Vec a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(Vec a);

// A viewing ray. The component of `dir` along the viewing axis is 1, so that the parameter t is the depth that .Z files
// hold: the distance along that axis.
struct Ray {
  Vec eye, dir;
};

// An object as the scene text gives it. Which members are used depends on its kind; `middle` and `reach` are a bounding
// sphere of its field.
struct Object;

// A kind of object: one row of the table in truthray.cpp; a new primitive adds one row. q is the squared distance to the
// core divided by the squared size, and is the argument of the Geoff function; the field is zero where q >= 1.
struct Kind {
  const char *word;   // name of the kind in a scene text
  int numbers;        // count of the numbers that follow the object's own number
  // Fills the object from the numbers. Returns a message if they are wrong, or null.
  const char *(*set)(Object &, const double *);
  // Returns q at a point, and stores its gradient unless `gradient` is null.
  double (*q)(const Object &, Vec p, Vec *gradient);
  // Appends the depths along a ray at which the smooth pieces of q meet. If q is a chain of quadratics, the depths where
  // q = 1 are appended too.
  void (*breaks)(const Object &, const Ray &, std::vector<double> &);
  // Stores the quadratic that is valid at depth t: q = c[0] + c[1] t + c[2] t^2. Null if q along a ray is not a chain of
  // quadratics.
  void (*quadratic)(const Object &, const Ray &, double t, double c[3]);
  // Used where `quadratic` is null: bounds of q for depths in [a, b]. The bounds become tighter as b - a shrinks.
  void (*bounds)(const Object &, const Ray &, double a, double b, double &low, double &high);
};

struct Object {
  const Kind *kind;
  int number;         // number of the object in the scene text
  Vec middle;
  double reach;
  Vec a, u;           // end or centre of the core; unit vector along its axis or normal
  double len;         // length of a segment, radius of a circle or disc
  double size;        // R: the field is zero at this distance from the core
  double size2;       // R at the far end of the core of a cone; 0 for other kinds
  Vec axis[3], half;  // box: unit axes, and half extents along them
  double strength = 1;  // factor of the object's field in every sum
  bool ghost = false;   // the object digs into others and is linked with none: it has no surface of its own
  // The object's own space, if `plain` is false: space about `centre`, with the unit axes `own`, is stretched by the factors
  // `stretch`, then tapered (a share), twisted and bent (radians) between the heights -h and h along the y axis.
  bool plain = true;
  Vec centre, own[3], stretch{1, 1, 1};
  double taper = 0, twist = 0, bend = 0, h = 1;
  bool warped() const { return taper != 0 || twist != 0 || bend != 0; }
  // Sets one of these from a line of the scene text. Returns a message if the numbers are wrong, or null.
  const char *setShape(const std::string &word, const double *numbers);
  // Returns an upper bound of the factor by which distances grow from the world to plain space, within `distance` of p.
  double steepest(Vec p, double distance) const;
  // Point and ray as they lie in plain space, where the functions of the kind apply. A ray keeps its parameter t.
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

// The finish and pattern of an object; its own colour is in Scene::ramps.
struct Coat {
  enum Finish { MATT, SHINY, MIRROR } finish = MATT;
  enum Pattern { NONE, CHECKS, STRIPES, MARBLE } pattern = NONE;
  double grain = 0;                      // width of a check or stripe, half the period of marble, units
  Colour colour{0, 0, 0};                // second colour of the pattern
  Vec middle{0, 0, 0}, axis[3];          // origin and axes of the pattern
};

struct Scene {
  double time = 0;                       // seconds
  Vec eye{0, 0, 0};
  Vec right{1, 0, 0}, up{0, 1, 0}, ahead{0, 0, 1};  // axes of the view, unit vectors
  double focalX = 0, focalY = 0;         // pixels
  double centreX = 0, centreY = 0;       // pixels
  Vec light{0, 0, 0};                    // unit vector towards the light
  double isovalue = 0.5;
  double ambient = 0;                    // share of the ramp that the ambient light fills
  // Returns the steps of light in one step of the ramp (light fills what the ambient share leaves). Figures of brightness
  // are in steps of light, so that a frame in colour is judged as strictly as a grey one, which has no ambient share.
  double lightSteps() const { return ambient < 1 ? 1 / (1 - ambient) : 1; }
  std::vector<Object> objects;
  std::vector<std::vector<double>> weight;  // [i][j]: factor of j's field in g_i: weight of the link less that of j's dent in i
  std::vector<std::vector<double>> link;    // [i][j]: weight of their link alone (0: no link), equal to [j][i]
  double highlight = 1;                  // share of light above which a colour turns towards white
  std::map<int, Colour> ramps;           // object number -> colour at full light, without highlight
  std::vector<Coat> coats;               // one for each object
  bool mixed = false;                    // a point shows the mean of its objects' colours, weighted by their fields
  // Returns whether the colour of a point can differ from the colour of its object.
  bool painted() const {
    bool any = mixed;
    for (const Coat &c : coats) any = any || c.finish != Coat::MATT || c.pattern != Coat::NONE;
    return any;
  }
};

// Returns the Geoff function of q = r^2/R^2, and its derivative with respect to q; both are 0 beyond q = 1.
double geoff(double q);
double geoffSlope(double q);

// Returns the kind of this name, or null.
const Kind *findKind(const std::string &word);

// Reads a scene text. Returns false, and the reason with its line in `why`, if the text is wrong. An unknown word is an
// error, because a scene with an object left out would give wrong figures.
bool parseScene(const std::string &text, const std::string &name, Scene &, std::string &why);

// The point where a ray first meets the surface.
struct Hit {
  double depth = -1;  // -1: no surface
  float shade = 0;    // brightness in ramp steps, 0 to 63, not rounded
  int object = -1;    // index of the object whose own field is strongest there
  // An object of another colour has an equally strong field there, for example where cores coincide. The point may have
  // either colour, so its colour is not judged.
  bool tied = false;
  // For a painted scene: the point's colour at full light, and whether more light turns the colour into white.
  Colour colour{0, 0, 0};
  bool shines = false;
  bool any() const { return depth >= 0; }
};

// Finds the first point where rays meet the surface of one scene. The scene must outlive the tracer. Several threads may
// call trace() at once.
class Tracer {
public:
  explicit Tracer(const Scene &);
  // Traces the ray through image position (column, row); the centre of pixel i is i + 0.5.
  Hit trace(double column, double row) const;
  // Does so for the `count` objects whose indices are listed in `which` only.
  Hit trace(double column, double row, const int *which, int count) const;
  // Returns whether rays through this image row (column) can meet the bounding sphere of object i.
  bool inRow(int i, double row) const;
  bool inColumn(int i, double column) const;
  // Returns whether the eye lies inside the surface; such a picture is not judged.
  bool eyeInside() const;
  // Returns the field of a body at a point, and stores its gradient and the index of the object whose own field is strongest
  // (both unchanged where no field reaches; either pointer may be null).
  double field(int number, Vec p, Vec *gradient, int *strongest) const;
  // Returns the body of an object, -1 if the object has no surface. Objects that links join, directly or through others,
  // are one body.
  int bodyOf(int object) const { return body[object]; }
  // Returns the brightness, 0 to 1, of a point with this finish and this outward unit normal.
  double brightness(const Coat &, Vec normal) const;
  // Returns the colour of a point, given the object whose field is strongest there.
  Colour colour(int object, Vec p) const;
  // For tests: turns off the shortcut that takes a plain sum where all weights are 1.
  void forgetPlain();
private:
  struct Work;
  struct Group;
  void aim(double column, double row, const int *which, int count, Work &) const;
  void gather(const int *which, int count, double a, double b, Work &) const;
  double firstOfBodies(Work &, double a, double b, int &owner) const;
  double firstOfMembers(Work &, int from, int end, double a, double b) const;
  bool isSum(const Work &, int from, int end) const;
  double first(const Work &, const Group &, const double *form, const char *known, double a, double b) const;
  bool excludes(const Work &, const Group &, const double *form, const char *known, double a, double b) const;
  double firstOfForms(const Group &, const double *form, double a, double b) const;
  Hit hitAt(const Ray &, double depth, int owner) const;
  double strengthened(int object, Vec p) const;
  bool digs(int object, const int *members, int n) const;
  bool tie(int object, Vec p) const;
  bool follow(const Work &, int object, double a, double b, double *form) const;
  const Scene &scene;
  std::vector<int> body;     // body of each object, or -1
  std::vector<char> plain;   // for each body: every pair is linked with weight 1, and nothing digs into it
  int bodies = 0;
  bool usePlain = true;
};

// The hits of all pixels of a picture, and of MARGIN pixels beyond each edge so that pixels at the edge have neighbours.
class Picture {
public:
  Picture() : hits((WIDTH + 2 * MARGIN) * (HEIGHT + 2 * MARGIN)) {}
  // Traces every pixel with this number of threads (1 or more).
  void trace(const Scene &, int threads);
  const Hit &at(int column, int row) const {
    return hits[(row + MARGIN) * (WIDTH + 2 * MARGIN) + column + MARGIN];
  }
  // The picture as bytes for a file of this program's own; and takes it from these. Returns false if they are not a picture.
  std::string bytes() const;
  bool take(const std::string &bytes);
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
  // Returns whether the brightness of a drawn pixel can be read in ramp steps: the frame is grey, or the scene gives the
  // colours of the ramps.
  bool shaded() const { return grey || !scene.ramps.empty(); }
  bool drawn(int column, int row) const { return z[row * WIDTH + column] != EMPTY; }
  double depth(int column, int row) const { return z[row * WIDTH + column] / 65536.0; }
  const uint8_t *pixel(int column, int row) const { return &rgb[3 * (row * WIDTH + column)]; }
};

// Reads object and brightness from the colours of a frame's pixels. A ramp has the 64 colours that the dump may show for
// one object colour (a palette may hold fewer, with six bits a channel). Objects of one colour share a ramp and cannot be
// told apart. A frame without ramps is read as grey.
class Ramps {
public:
  explicit Ramps(const Scene &);
  // Returns the ramp of an object given by index, or -1 if it has none.
  int of(int object) const { return object < 0 ? -1 : ofObject[object]; }
  // Returns the ramp that a pixel's colour comes from, or -1 if no ramp is near the colour or several ramps are equally near.
  int shown(const uint8_t *rgb) const;
  // Returns the brightness of a pixel in ramp steps. `object` is the index of the object that should be there, or -1; its
  // ramp is used if it fits as well as the nearest one.
  double step(const uint8_t *rgb, int object) const;
  // Stores the colour of an object at this brightness in ramp steps.
  void paint(int object, double step, uint8_t *rgb) const;
  // The same two functions for pixels whose true point is known; these work for painted scenes too. `miss` receives the
  // distance of the pixel's colour from the nearest colour that this point has under any light.
  double step(const uint8_t *rgb, const Hit &, double *miss = nullptr) const;
  void paint(const Hit &, uint8_t *rgb) const;
  // Returns whether the scene is painted and its frame is in colour.
  bool painted() const { return paints && !steps.empty(); }
private:
  struct Reading {
    int ramp;                  // result of shown()
    int nearest;
    std::vector<double> miss;  // for each ramp: squared distance from its nearest colour
    std::vector<double> step;  // for each ramp: brightness of that nearest colour
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

// Reads DIR/F<n>.TXT, .PPM and .Z. Returns false, and a reason, if any of them is missing or bad.
bool readFrame(const std::string &dir, long n, Frame &, std::string &why);
bool readScene(const std::string &path, Scene &, std::string &why);
bool readFile(const std::string &path, std::string &data, std::string &why);
bool writeFile(const std::string &path, const std::string &data, std::string &why);
bool writePpm(const std::string &path, int width, int height, const std::vector<uint8_t> &rgb,
              std::string &why);
// Lists the numbers of the frames in a directory in ascending order.
bool listFrames(const std::string &dir, std::vector<long> &, std::string &why);
std::string frameName(const std::string &dir, long n, const char *extension);

// Makes the frame that the surface itself would give: in the colours of the ramps if the scene has ramps, else grey.
void drawTruth(const Scene &, const Picture &, Frame &);

// The figures of one frame, or of a run when added up. Counts are of pixels.
struct Figures {
  long frames = 0, eyeInside = 0;
  long surface = 0;        // surface there
  long drawn = 0;          // something drawn
  long interior = 0;       // surface there and at all eight neighbours
  long holes = 0;          // interior pixels where nothing is drawn
  long seeThrough = 0;     // interior pixels drawn more than 4 units too far away
  long outside = 0;        // drawn, but no surface within a distance of 2 pixels
  long outsideBox = 0;     // drawn, but no surface in the 5 by 5 square of pixels round it
  long missing = 0;        // surface there, nothing drawn, interior or not
  long both = 0;           // drawn, surface there
  double depth2 = 0;       // sum of squared depth errors over `both`
  long smooth = 0;         // pixels of `both` without a jump of the true depth beside them
  double smooth2 = 0;
  long shaded = 0;         // pixels of `both` whose brightness can be read
  double shade2 = 0;       // sum of squared brightness errors over `shaded`, steps of light
  long coloured = 0;       // pixels of `both` whose colour tells their object
  long wrongColour = 0;    // pixels of `coloured` in a colour that is not the true one within a distance of 1 pixel
  long borderTrue = 0;     // neighbouring pairs of coloured pixels that truly belong to differently coloured objects
  long border = 0;         // such pairs that show different objects by their drawn colours
  long pairs = 0;          // pairs of frames close enough in time for flicker to be judged
  long flickerBase = 0;    // drawn pixels of the second frame of such pairs
  long flicker = 0;        // pixels whose brightness jumps while the true brightness does not
  long flickerEdge = 0;    // like `flicker`, but also pixels that appear or vanish
  void add(const Figures &);
  double depthRms() const;
  double smoothRms() const;
  double shadeRms() const;
  double colourShare() const;      // percent of drawn pixels
  double borderRatio() const;      // 1: as long as the true borders
  double seeThroughShare() const;  // percent, as are the next four figures
  double outsideShare() const;
  double outsideBoxShare() const;
  double flickerShare() const;
  double flickerEdgeShare() const;
};

const double BEHIND = 4.0;             // units; a pixel drawn further behind the surface is see-through
const double PAIR = 1 / 70.0 + 0.001;  // longest time between frames of a pair, seconds; scene times are rounded to 1/1000 s

// Compares a frame with its true picture.
Figures compare(const Frame &, const Picture &);
// Adds the flicker between two consecutive frames to the figures of the later one, if the frames are close enough in time
// and the brightness of both can be read.
void compareFlicker(const Frame &before, const Picture &beforeTruth,
                    const Frame &after, const Picture &afterTruth, Figures &);

// Returns the frame, its true picture and their difference side by side: 968 x 200 pixels.
const int SHEET_WIDTH = 3 * WIDTH + 8;
std::vector<uint8_t> sheet(const Frame &, const Picture &);

}  // namespace truth

#endif
