#include "session/clear_of_skin.h"

#include <algorithm>

namespace karinui {

namespace {

constexpr double kClear = 0.003;  // metres before the skin, and for each layer as much again
constexpr double kDeep = 0.08;    // farther in, it is another limb's skin
constexpr int kRounds = 3;
constexpr std::size_t kBlock = 256;

// From a place that lies nearer before the skin than `clear` to where it should be; zero for all others.
Vec3 wayOut(Vec3 place, const Skin& skin, double clear) {
  const auto near = skin.bvh.nearest(place, skin.deep);
  if (!near) return {};
  const Vec3 out = faceNormal(skin.mesh, near->place.face);
  return dot(place - near->point, out) < clear ? near->point + out * clear - place : Vec3{};
}

}  // namespace

// Its points, and then its faces: between its points coarse cloth cuts off what is round.
void leadOut(std::vector<Vec3>& points, const std::vector<Triangle>& faces, const Skin& skin, double clear,
             Workers& workers) {
  workers.forBlocks(points.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) points[k] += wayOut(points[k], skin, clear);
  });
  std::vector<Vec3> ways(faces.size());
  for (int round = 0; round < kRounds; ++round) {
    workers.forBlocks(faces.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const auto& [i, j, k] = faces[f];
        ways[f] = wayOut((points[i] + points[j] + points[k]) * (1.0 / 3), skin, clear / 2);
      }
    });
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const std::uint32_t corner : faces[f]) points[corner] += ways[f] * (1.0 / 3);
  }
}

Document clearOfSkin(Document document, const Body& body, Workers& workers) {
  for (auto& [id, held] : document.pattern.pieces) {
    if (!held->form) continue;
    Piece piece = *held;
    Form form = *piece.form;
    std::transform(form.space.begin(), form.space.end(), form.space.begin(), piece.pose);
    leadOut(form.space, form.faces, {body.mesh(), body.bvh(), kDeep}, kClear * (1 + piece.layer), workers);
    piece.form = std::make_shared<const Form>(std::move(form));
    piece.pose = Rigid();
    held = std::make_shared<const Piece>(std::move(piece));
  }
  return document;
}

}  // namespace karinui
