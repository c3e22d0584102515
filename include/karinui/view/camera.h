#pragma once
// Where one looks from, and the eyes that look. Plain values and free functions: no GL, any thread. Metres, radians;
// the body faces +z and stands on y = 0, its left is +x.
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

// A 4x4 matrix as OpenGL wants it: m[4 * column + row].
struct Matrix4 {
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::array<float, 16> floats() const;
};
Matrix4 operator*(const Matrix4& a, const Matrix4& b);
std::array<double, 4> operator*(const Matrix4& a, const std::array<double, 4>& v);

struct Camera {
  Vec3 eye{0, 1, 4};
  Vec3 target{0, 1, 0};  // in focus: at this distance the two eyes' pictures coincide
  Vec3 up{0, 1, 0};
  double fieldOfView = 0.42;  // of the picture's height
  double distance() const { return karinui::distance(eye, target); }
  Vec3 right() const;  // unit
};

// What a fitter walks round to see. Left is the side of the body's left hand.
enum class View { Front, Back, Left, Right, Oblique };
Result<View> viewNamed(std::string_view name);  // "front", "back", "left", "right", "oblique"
std::string_view nameOf(View view);

// A camera from this side that holds everything drawable of the frame with a margin, in a picture of this aspect (width
// / height). An empty frame is seen as if a person stood there.
Camera frameAll(const SceneFrame& frame, View view, double aspect);

// The scene as a picture of it is framed: without the cloths, and the lines, that stand apart from its bodies, as
// pieces do that nobody has placed yet; with them the figure would be a dot. All of it where it has no body, or no
// cloth that stands near one. `apart`: how many cloths were left out.
SceneFrame worn(const SceneFrame& frame, std::size_t* apart = nullptr);

// What a scene is turned about: the upright axis through the middle of its box, where it meets y = 0.
Vec3 axisOf(const SceneFrame& frame);
// A camera from this side for scenes that are turned, each about its own axis: it holds every one of them at every turn
// with one distance and one aim, so that all are seen at one scale and on one floor. For an axis at x = z = 0.
Camera frameTurning(std::span<const SceneFrame> frames, View view, double aspect);
// This camera for a scene with that axis, walked so many radians round it, towards the body's left first.
Camera walkedRound(const Camera& camera, Vec3 axis, double turn);

// One eye, ready for the renderer.
struct Eye {
  Matrix4 view;        // world to eye
  Matrix4 projection;  // eye to clip
  Vec3 place;
};

// The eye `sideways` metres along the camera's right (negative: left). The frustum is sheared, not turned, so that
// points at the target's distance fall on the same pixel for every eye and no vertical disparity arises (off-axis
// projection, P. Bourke, "Calculating stereo pairs", 1999).
Eye eyeOf(const Camera& camera, double aspect, double sideways = 0);

// The two halves of an Eye, for whoever has its own: world to eye by its place and its unit axes (back points away from
// what is looked at), and the frustum whose edges have these slopes (sideways metres for a metre ahead; left and bottom
// negative of an eye that looks ahead) with the depths of OpenGL, 0 < near < far metres.
Matrix4 viewOf(Vec3 place, Vec3 right, Vec3 up, Vec3 back);
struct Slopes {
  double left = -1, right = 1, bottom = -1, top = 1;
};
Matrix4 frustumOf(const Slopes& slopes, double near, double far);

// How far apart the two eyes see a point at depth z (along the camera's axis), in pixels of a picture `height` pixels
// high: x_left - x_right = f b (1/z - 1/D), f = height / (2 tan(fieldOfView / 2)), b the eyes' separation, D the
// target.
double disparity(const Camera& camera, double height, double separation, double depth);

// Where a point falls, in pixels from the top left of a picture.
struct OnPicture {
  double x = 0, y = 0, depth = 0;  // depth: metres along the axis; <= 0 behind the eye
};
OnPicture project(const Eye& eye, Vec3 point, double width, double height);

enum class Eyes { Mono, SideBySide, TopBottom, Anaglyph };  // Anaglyph: left eye red, right eye cyan
Result<Eyes> eyesNamed(std::string_view name);              // "mono", "side-by-side", "top-bottom", "anaglyph"
std::string_view nameOf(Eyes eyes);

}  // namespace karinui
