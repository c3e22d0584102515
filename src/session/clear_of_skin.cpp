#include "session/clear_of_skin.h"

#include <algorithm>

namespace karinui {

namespace {

constexpr double kClear = 0.003;  // metres before the skin, and for each layer as much again
constexpr double kDeep = 0.08;    // farther in, it is another limb's skin
constexpr std::size_t kBlock = 256;

std::vector<Vec3> ledOut(std::vector<Vec3> space, double clear, const Body& body, Workers& workers) {
  workers.forBlocks(space.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto near = body.bvh().nearest(space[k], kDeep);
      if (!near) continue;
      const Vec3 out = faceNormal(body.mesh(), near->place.face);
      if (dot(space[k] - near->point, out) < clear) space[k] = near->point + out * clear;
    }
  });
  return space;
}

}  // namespace

Document clearOfSkin(Document document, const Body& body, Workers& workers) {
  for (auto& [id, held] : document.pattern.pieces) {
    if (!held->form) continue;
    Piece piece = *held;
    Form form = *piece.form;
    std::transform(form.space.begin(), form.space.end(), form.space.begin(), piece.pose);
    form.space = ledOut(std::move(form.space), kClear * (1 + piece.layer), body, workers);
    piece.form = std::make_shared<const Form>(std::move(form));
    piece.pose = Rigid();
    held = std::make_shared<const Piece>(std::move(piece));
  }
  return document;
}

}  // namespace karinui
