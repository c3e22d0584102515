#include "karinui/view/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace karinui {

std::array<float, 16> Matrix4::floats() const {
  std::array<float, 16> f;
  std::transform(m.begin(), m.end(), f.begin(), [](double v) { return static_cast<float>(v); });
  return f;
}

Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
  Matrix4 c;
  for (std::size_t col = 0; col < 4; ++col)
    for (std::size_t row = 0; row < 4; ++row) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a.m[4 * k + row] * b.m[4 * col + k];
      c.m[4 * col + row] = sum;
    }
  return c;
}

std::array<double, 4> operator*(const Matrix4& a, const std::array<double, 4>& v) {
  std::array<double, 4> r{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t k = 0; k < 4; ++k) r[row] += a.m[4 * k + row] * v[k];
  return r;
}

namespace {

struct Axes {
  Vec3 right, up, back;  // unit; back points from the target to the eye
};

Axes axesOf(const Camera& camera) {
  Vec3 back = normalized(camera.eye - camera.target);
  if (back == Vec3{}) back = {0, 0, 1};
  Vec3 right = normalized(cross(camera.up, back));
  // Looking straight along "up": any right will do, but it must be one.
  if (length(right) < 0.5) right = normalized(cross(std::fabs(back.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, back));
  return {right, cross(back, right), back};
}

constexpr std::array<std::string_view, 5> kViews{"front", "back", "left", "right", "oblique"};
constexpr std::array<std::string_view, 4> kEyes{"mono", "side-by-side", "top-bottom", "anaglyph"};

// Unit vector from the target towards the eye.
Vec3 sideOf(View view) {
  const double rise = view == View::Oblique ? 0.24 : 0.075;  // a fitter's eye is a little above the waist
  double turn = 0;
  switch (view) {
    case View::Front:
      turn = 0;
      break;
    case View::Back:
      turn = std::numbers::pi;
      break;
    case View::Left:
      turn = std::numbers::pi / 2;
      break;
    case View::Right:
      turn = -std::numbers::pi / 2;
      break;
    case View::Oblique:
      turn = 0.62;
      break;
  }
  return {std::sin(turn) * std::cos(rise), std::sin(rise), std::cos(turn) * std::cos(rise)};
}

// The box of the scene, or of a person where nothing is in it.
Box boxOrPerson(const SceneFrame& frame) {
  const Box box = extent(frame);
  return box.empty() ? Box{{-0.4, 0, -0.2}, {0.4, 1.7, 0.2}} : box;
}

// Every place of the scene, or the corners of a person's box where nothing is in it.
template <class Visit>
void eachPoint(const SceneFrame& frame, const Visit& visit) {
  const auto visitAll = [&](const std::vector<Vec3>& points) {
    for (const Vec3 p : points)
      if (drawable(p)) visit(p);
  };
  for (const SceneBody& body : frame.bodies) visitAll(body.mesh.points);
  for (const SceneCloth& cloth : frame.cloths) visitAll(cloth.mesh.points);
  for (const SceneLine& line : frame.lines) visitAll(line.points);
  if (!extent(frame).empty()) return;
  const Box box = boxOrPerson(frame);
  for (int i = 0; i < 8; ++i)
    visit(Vec3{i & 1 ? box.low.x : box.high.x, i & 2 ? box.low.y : box.high.y, i & 4 ? box.low.z : box.high.z});
}

constexpr double kMargin = 0.90;

}  // namespace

Vec3 Camera::right() const { return axesOf(*this).right; }

Result<View> viewNamed(std::string_view name) {
  const auto found = std::find(kViews.begin(), kViews.end(), name);
  if (found != kViews.end()) return static_cast<View>(found - kViews.begin());
  return badInput(say("There is no view “{0}”; say front, back, left, right or oblique.", name));
}
std::string_view nameOf(View view) { return kViews[static_cast<std::size_t>(view)]; }

Result<Eyes> eyesNamed(std::string_view name) {
  const auto found = std::find(kEyes.begin(), kEyes.end(), name);
  if (found != kEyes.end()) return static_cast<Eyes>(found - kEyes.begin());
  return badInput(say("There is no way of seeing called “{0}”; say mono, side-by-side, top-bottom or anaglyph.", name));
}
std::string_view nameOf(Eyes eyes) { return kEyes[static_cast<std::size_t>(eyes)]; }

Camera frameAll(const SceneFrame& frame, View view, double aspect) {
  Camera camera;
  camera.target = boxOrPerson(frame).centre();
  camera.eye = camera.target + sideOf(view);
  const Axes axes = axesOf(camera);

  // The middle of the scene as this camera sees it, then the distance at which the outermost point meets the margin.
  double lowR = 0, highR = 0, lowU = 0, highU = 0;
  bool first = true;
  eachPoint(frame, [&](Vec3 p) {
    const double r = dot(p - camera.target, axes.right), u = dot(p - camera.target, axes.up);
    lowR = first ? r : std::min(lowR, r), highR = first ? r : std::max(highR, r);
    lowU = first ? u : std::min(lowU, u), highU = first ? u : std::max(highU, u);
    first = false;
  });
  camera.target += axes.right * ((lowR + highR) / 2) + axes.up * ((lowU + highU) / 2);

  const double tanV = std::tan(camera.fieldOfView / 2) * kMargin, tanH = tanV * aspect;
  double distance = 0.02 / tanV;  // a scene of one point is seen as a patch of a few centimetres
  eachPoint(frame, [&](Vec3 p) {
    const Vec3 q = p - camera.target;
    const double towards = dot(q, axes.back);
    distance = std::max(
        {distance, std::fabs(dot(q, axes.right)) / tanH + towards, std::fabs(dot(q, axes.up)) / tanV + towards});
  });
  camera.eye = camera.target + axes.back * distance;
  return camera;
}

SceneFrame worn(const SceneFrame& frame, std::size_t* apart) {
  constexpr double kApart = 0.4;  // metres between the boxes of what is worn and the figure's at most
  if (apart) *apart = 0;
  Box figure;
  for (const SceneBody& body : frame.bodies)
    for (const Vec3 p : body.mesh.points)
      if (drawable(p)) figure.include(p);
  if (figure.empty()) return frame;
  const auto near = [&](const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3 p : points)
      if (drawable(p)) box.include(p);
    if (box.empty()) return true;
    const auto gap = [](double low, double high, double from, double to) {
      return std::max({0.0, low - to, from - high});
    };
    return length(Vec3{gap(box.low.x, box.high.x, figure.low.x, figure.high.x),
                       gap(box.low.y, box.high.y, figure.low.y, figure.high.y),
                       gap(box.low.z, box.high.z, figure.low.z, figure.high.z)}) <= kApart;
  };
  SceneFrame kept;
  for (const SceneCloth& cloth : frame.cloths)
    if (near(cloth.mesh.points)) kept.cloths.push_back(cloth);
  if (kept.cloths.empty() || kept.cloths.size() == frame.cloths.size()) return frame;
  if (apart) *apart = frame.cloths.size() - kept.cloths.size();
  kept.bodies = frame.bodies;
  for (const SceneLine& line : frame.lines)
    if (near(line.points)) kept.lines.push_back(line);
  return kept;
}

Vec3 axisOf(const SceneFrame& frame) {
  const Vec3 middle = boxOrPerson(frame).centre();
  return {middle.x, 0, middle.z};
}

// A point at the radius r and the height y above the target comes to r cos f towards the camera at the turn f. With
// the camera's rise p it is seen y cos p - r cos f sin p above the target's line of sight and r sin f beside it, and is
// r cos f cos p + y sin p nearer. The distance that keeps it within a slope t is (beside or above) / t + nearer. Over
// all f the greatest value of the one is r sqrt(1 / t^2 + cos^2 p) + y sin p, and the other is linear in cos f.
Camera frameTurning(std::span<const SceneFrame> frames, View view, double aspect) {
  struct Ring {
    double radius, height;
  };
  std::vector<Ring> rings;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const SceneFrame& frame : frames) {
    const Vec3 axis = axisOf(frame);
    const Box box = boxOrPerson(frame);
    low = std::min(low, box.low.y), high = std::max(high, box.high.y);
    eachPoint(frame, [&](Vec3 p) { rings.push_back({std::hypot(p.x - axis.x, p.z - axis.z), p.y}); });
  }
  if (rings.empty()) return frameAll({}, view, aspect);
  Camera camera;
  camera.target = {0, (low + high) / 2, 0};
  const Vec3 back = sideOf(view);
  const double rise = back.y, level = std::hypot(back.x, back.z);  // sine and cosine
  const double tanV = std::tan(camera.fieldOfView / 2) * kMargin, tanH = tanV * aspect;
  const double beside = std::sqrt(1 / (tanH * tanH) + level * level);
  double distance = 0.02 / tanV;
  for (const Ring& ring : rings) {
    const double y = ring.height - camera.target.y;
    distance = std::max(distance, ring.radius * beside + y * rise);
    for (const double side : {-1.0, 1.0})
      distance =
          std::max(distance, side * y * level / tanV + y * rise + ring.radius * std::fabs(level - side * rise / tanV));
  }
  camera.eye = camera.target + back * distance;
  return camera;
}

Camera walkedRound(const Camera& camera, Vec3 axis, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  const auto walked = [&](Vec3 p) { return Vec3{axis.x + c * p.x + s * p.z, p.y, axis.z + c * p.z - s * p.x}; };
  Camera after = camera;
  after.eye = walked(camera.eye), after.target = walked(camera.target);
  return after;
}

Matrix4 viewOf(Vec3 p, Vec3 right, Vec3 up, Vec3 back) {
  return {{right.x, up.x, back.x, 0, right.y, up.y, back.y, 0, right.z, up.z, back.z, 0, -dot(right, p), -dot(up, p),
           -dot(back, p), 1}};
}

// glFrustum (OpenGL 2.1, section 2.11.2), by slopes instead of the edges of its near plane.
Matrix4 frustumOf(const Slopes& s, double near, double far) {
  const double wide = s.right - s.left, high = s.top - s.bottom, deep = far - near;
  return {{2 / wide, 0, 0, 0,                                                               //
           0, 2 / high, 0, 0,                                                               //
           (s.right + s.left) / wide, (s.top + s.bottom) / high, -(far + near) / deep, -1,  //
           0, 0, -2 * far * near / deep, 0}};
}

Eye eyeOf(const Camera& camera, double aspect, double sideways) {
  const Axes a = axesOf(camera);
  Eye eye;
  eye.place = camera.eye + a.right * sideways;
  eye.view = viewOf(eye.place, a.right, a.up, a.back);
  const double focus = std::max(camera.distance(), 1e-6);
  const double top = std::tan(camera.fieldOfView / 2), wide = top * aspect;
  const double shear = -sideways / focus;  // the window at the target's distance stays where it is
  // 24 bits of depth resolve 5 micrometres at the target with these planes.
  eye.projection = frustumOf({-wide + shear, wide + shear, -top, top}, focus * 0.05, focus * 40);
  return eye;
}

double disparity(const Camera& camera, double height, double separation, double depth) {
  const double f = height / (2 * std::tan(camera.fieldOfView / 2));
  return f * separation * (1 / depth - 1 / camera.distance());
}

OnPicture project(const Eye& eye, Vec3 point, double width, double height) {
  const auto clip = eye.projection * (eye.view * std::array<double, 4>{point.x, point.y, point.z, 1});
  if (clip[3] <= 0) return {0, 0, clip[3]};
  return {(clip[0] / clip[3] + 1) / 2 * width, (1 - clip[1] / clip[3]) / 2 * height, clip[3]};
}

}  // namespace karinui
