#include "cloth/collider_face_contact.h"
#include "cloth/work_blocks.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kPointSpacing = 0.02;  // metres between sample points: half of the thinnest limb cloth is hung on
constexpr double kBegin = 0.2;          // of the nodes' offset: where the penalty of a face begins

// The centroids of the parts * parts triangles a triangle is cut into.
std::vector<std::array<double, 3>> centroidsOf(int parts) {
  std::vector<std::array<double, 3>> centroids;
  const double third = 1.0 / 3;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j)
      for (const double in : {third, 2 * third}) {
        if (in > 0.5 && i + j + 2 > parts) continue;
        const double a = (i + in) / parts, b = (j + in) / parts;
        centroids.push_back({1 - a - b, a, b});
      }
  return centroids;
}

}  // namespace

ColliderFaceContact::ColliderFaceContact(const Cloth& cloth, const Collider& collider, double offset)
    : points_(centroidsOf(std::max(1, static_cast<int>(std::lround(cloth.spacing / kPointSpacing))))),
      cache_(0),
      collider_(collider),
      offset_(offset),
      begin_(kBegin * offset) {
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.live) continue;
    const Lattice& lattice = *piece.lattice;
    for (const Triangle& f : lattice.faces) {
      faces_.push_back({piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]});
      const double twice = cross(lattice.nodes[f[1]] - lattice.nodes[f[0]], lattice.nodes[f[2]] - lattice.nodes[f[0]]);
      area_.push_back(0.5 * std::fabs(twice) / static_cast<double>(points_.size()));
    }
  }
  cache_ = ClearanceCache(faces_.size() * points_.size());
}

void ColliderFaceContact::detect(const ContactQuery& query, Workers& workers) {
  const std::span<const Vec3> x = query.x;
  std::vector<std::vector<Touch>> found((faces_.size() + kNodeBlock - 1) / kNodeBlock);
  workers.forBlocks(faces_.size(), kNodeBlock, [&](std::size_t from, std::size_t to) {
    ClearanceCache::Seen last;  // faces that follow each other mostly lie beside each other
    for (std::size_t f = from; f < to; ++f) {
      const Vec3 a = x[faces_[f][0]], b = x[faces_[f][1]], c = x[faces_[f][2]];
      for (std::size_t k = 0; k < points_.size(); ++k) {
        const auto& w = points_[k];
        const Vec3 place = a * w[0] + b * w[1] + c * w[2];
        const auto sample = cache_.sampleWithin(collider_, f * points_.size() + k, place, begin_, last);
        if (!sample || sample->distance >= begin_) continue;
        found[from / kNodeBlock].push_back({static_cast<std::uint32_t>(f), w, sample->normal,
                                            colliderPenalty(area_[f], begin_ - sample->distance, offset_)});
      }
    }
  });
  touching_.clear();
  for (const auto& part : found) touching_.insert(touching_.end(), part.begin(), part.end());
}

void ColliderFaceContact::addGradient(std::span<Vec3> gradient) const {
  for (const Touch& touch : touching_)
    for (int c = 0; c < 3; ++c)
      gradient[faces_[touch.face][c]] -= touch.normal * (touch.penalty.force * touch.weight[c]);
}

// Each corner as if it carried its share of the point alone: an upper bound of the point's own matrix.
void ColliderFaceContact::addHessian(ContactHessian& hessian) const {
  for (const Touch& touch : touching_)
    for (int c = 0; c < 3; ++c)
      hessian.addAtNode(faces_[touch.face][c], touch.weight[c], touch.normal, touch.penalty.stiffness, 0);
}

}  // namespace karinui
