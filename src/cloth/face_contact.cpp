#include "cloth/face_contact.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kApart = 0.02;  // metres between places of a face: about half of the thinnest limb cloth is hung on
constexpr double kBegin = 0.2;   // of the nodes' skin
constexpr std::size_t kBlock = 256;

// The middles of the parts * parts triangles a triangle is cut into.
std::vector<std::array<double, 3>> middlesOf(int parts) {
  std::vector<std::array<double, 3>> middles;
  const double third = 1.0 / 3;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j)
      for (const double in : {third, 2 * third}) {
        if (in > 0.5 && i + j + 2 > parts) continue;
        const double a = (i + in) / parts, b = (j + in) / parts;
        middles.push_back({1 - a - b, a, b});
      }
  return middles;
}

}  // namespace

FaceContact::FaceContact(const Cloth& cloth, const Collider& body, double offset)
    : places_(middlesOf(std::max(1, static_cast<int>(std::lround(cloth.spacing / kApart))))),
      farOff_(0),
      body_(body),
      offset_(offset),
      begin_(kBegin * offset) {
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.live) continue;
    const Lattice& lattice = *piece.lattice;
    for (const Triangle& f : lattice.faces) {
      faces_.push_back({piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]});
      const double twice = cross(lattice.nodes[f[1]] - lattice.nodes[f[0]], lattice.nodes[f[2]] - lattice.nodes[f[0]]);
      area_.push_back(0.5 * std::fabs(twice) / static_cast<double>(places_.size()));
    }
  }
  farOff_ = FarOff(faces_.size() * places_.size());
}

void FaceContact::find(std::span<const Vec3> x, Workers& workers) {
  std::vector<std::vector<Touch>> found((faces_.size() + kBlock - 1) / kBlock);
  workers.forBlocks(faces_.size(), kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t f = from; f < to; ++f) {
      const Vec3 a = x[faces_[f][0]], b = x[faces_[f][1]], c = x[faces_[f][2]];
      for (std::size_t k = 0; k < places_.size(); ++k) {
        const auto& w = places_[k];
        const Vec3 place = a * w[0] + b * w[1] + c * w[2];
        if (!farOff_.mayBeWithin(body_, f * places_.size() + k, place, begin_)) continue;
        const Collider::Sample contact = body_.sample(place);
        if (contact.distance >= begin_) continue;
        found[from / kBlock].push_back(
            {static_cast<std::uint32_t>(f), w, contact.normal, bodyPush(area_[f], begin_ - contact.distance, offset_)});
      }
    }
  });
  touching_.clear();
  for (const auto& part : found) touching_.insert(touching_.end(), part.begin(), part.end());
}

void FaceContact::addGradient(std::span<Vec3> gradient) const {
  for (const Touch& touch : touching_)
    for (int c = 0; c < 3; ++c) gradient[faces_[touch.face][c]] -= touch.normal * (touch.push.force * touch.weight[c]);
}

void FaceContact::addBlocks(const TieMap& ties, BlockSystem& system) const {
  // Each corner as if it had to carry its part of the place alone: firmer than it is, and never softer.
  for (const Touch& touch : touching_)
    for (int c = 0; c < 3; ++c) {
      const auto parts = ties.parts(faces_[touch.face][c]);
      double whole = 0;
      for (const TieMap::Part& part : parts) whole += std::fabs(part.weight);
      for (const TieMap::Part& part : parts) {
        Block3 block{};
        addStretch(block, 0, whole * std::fabs(part.weight) * touch.weight[c] * touch.push.slope, touch.normal);
        system.addDiagonal(part.unknown, block);
      }
    }
}

}  // namespace karinui
