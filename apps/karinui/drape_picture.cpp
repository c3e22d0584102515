#include "drape_picture.h"

#include <cmath>
#include <numbers>

namespace karinui::app {

namespace {

constexpr double kSupportHigh = 0.13;  // metres from the floor to the support's top

TriangleMesh support() {
  constexpr std::uint32_t kAround = 96;
  const double radius = bench::kSupport - 0.003;
  TriangleMesh mesh;
  for (const double y : {0.0, kSupportHigh - 0.003})
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double turn = 2 * std::numbers::pi * k / kAround;
      mesh.points.push_back({radius * std::sin(turn), y, radius * std::cos(turn)});
    }
  mesh.points.push_back({0, 0, 0});
  mesh.points.push_back({0, kSupportHigh - 0.003, 0});
  for (std::uint32_t k = 0; k < kAround; ++k) {
    const std::uint32_t next = (k + 1) % kAround;
    mesh.faces.push_back({k, next, kAround + next});
    mesh.faces.push_back({k, kAround + next, kAround + k});
    mesh.faces.push_back({2 * kAround, next, k});
    mesh.faces.push_back({2 * kAround + 1, kAround + k, kAround + next});
  }
  return mesh;
}

}  // namespace

Result<Image> drapePicture(Picture& picture, const bench::Draped& draped, int pixels) {
  const ClothPiece& piece = draped.disc.cloth.pieces[0];
  SceneFrame frame;
  frame.bodies.push_back({support(), {0.70f, 0.68f, 0.64f}});
  SceneCloth cloth;
  cloth.name = piece.name;
  cloth.mesh = {draped.disc.state.position, piece.lattice->faces};
  for (Vec3& p : cloth.mesh.points) p.y += kSupportHigh;
  cloth.flat = piece.lattice->nodes;
  cloth.outlines.push_back(piece.lattice->border);
  cloth.outlines.back().push_back(piece.lattice->border.front());
  cloth.colour = {0.25f, 0.38f, 0.60f};
  frame.cloths.push_back(std::move(cloth));
  PictureOptions how;
  how.width = how.height = pixels;
  how.lettering = false;
  how.samples = 4;
  Camera camera;
  camera.target = {0, kSupportHigh - 0.035, 0};
  camera.eye = {0.25, kSupportHigh + 0.62, 0.85};
  camera.fieldOfView = 0.30;
  how.camera = camera;
  return picture.draw(frame, how);
}

}  // namespace karinui::app
