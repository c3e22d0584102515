#include "cloth/detail_transfer.h"

#include <algorithm>
#include <cmath>

#include "cloth/cloth_topology.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr int kTurns = 60;           // iterations for a turn at most: three do from the turn of a part before,
constexpr double kTurnedOut = 1e-7;  // which is found where the next would turn by less, radians
constexpr double kTiniest = 1e-300;

struct InTriangle {
  std::array<std::uint32_t, 3> node{};
  std::array<double, 3> weight{};
};

// Of each node of a cloth the triangle of another level under it on paper.
std::vector<InTriangle> trianglesUnder(const Cloth& cloth, const Cloth& level) {
  std::vector<InTriangle> found(cloth.nodeCount);
  for (const ClothPiece& piece : cloth.pieces) {
    const auto other = std::find_if(level.pieces.begin(), level.pieces.end(),
                                    [&](const ClothPiece& one) { return one.id == piece.id; });
    KARINUI_ASSERT(other != level.pieces.end());
    const LatticeFinder finder(other->lattice->nodes, other->lattice->faces);
    const std::vector<Flat> inwards = inwardsOf(piece.lattice->nodes, piece.lattice->faces);
    for (std::uint32_t k = 0; k < piece.lattice->nodes.size(); ++k) {
      const LatticePlace in = finder.find(piece.lattice->nodes[k], inwards[k]);
      for (int c = 0; c < 3; ++c) found[piece.firstNode + k].node[c] = other->firstNode + in.face[c];
      found[piece.firstNode + k].weight = in.weight;
    }
  }
  return found;
}

// At each node, by the areas of the faces around.
std::vector<Vec3> normalsOf(const Cloth& cloth, std::span<const Vec3> x) {
  std::vector<Vec3> normals(cloth.nodeCount);
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& face : piece.lattice->faces) {
      const std::array<std::uint32_t, 3> n{piece.firstNode + face[0], piece.firstNode + face[1],
                                           piece.firstNode + face[2]};
      const Vec3 area = cross(x[n[1]] - x[n[0]], x[n[2]] - x[n[0]]);
      for (const std::uint32_t k : n) normals[k] += area;
    }
  return normals;
}

}  // namespace

DetailTransfer::DetailTransfer(const Cloth& fine, std::span<const Vec3> x, const Cloth& coarse)
    : coarse_(coarse), start_(coarse.nodeCount), near_(neighboursOf(coarse)), turns_(coarse.nodeCount) {
  const std::vector<InTriangle> onFine = trianglesUnder(coarse, fine);
  for (std::size_t k = 0; k < start_.size(); ++k)
    for (int c = 0; c < 3; ++c) start_[k] += x[onFine[k].node[c]] * onFine[k].weight[c];
  normal_ = normalsOf(coarse, start_);
  for (std::size_t k = 0; k < start_.size(); ++k) {
    double far = 0;
    for (const std::uint32_t n : near_[k]) far += squaredLength(start_[n] - start_[k]);
    normal_[k] *= std::sqrt(far) / std::fmax(length(normal_[k]), kTiniest);
  }
  places_.reserve(fine.nodeCount);
  for (const InTriangle& in : trianglesUnder(fine, coarse)) {
    Place place{in.node, in.weight, {}};
    const Vec3 stands = x[places_.size()];
    for (int c = 0; c < 3; ++c) place.offset[c] = stands - start_[in.node[c]];
    places_.push_back(place);
  }
}

// The rotation nearest to a product of moments, b times a transposed, from one that is not far: Müller, Bender,
// Chentanez and Macklin, "A robust method to extract the rotational part of deformations", 2016. `product`: its
// columns.
DetailTransfer::Turn DetailTransfer::nearest(const std::array<Vec3, 3>& product, Turn turn) {
  for (int k = 0; k < kTurns; ++k) {
    const double along = dot(turn.x, product[0]) + dot(turn.y, product[1]) + dot(turn.z, product[2]);
    const Vec3 about = (cross(turn.x, product[0]) + cross(turn.y, product[1]) + cross(turn.z, product[2])) *
                       (1 / std::fmax(std::fabs(along), kTiniest));
    const double angle = length(about);
    if (!(angle > kTurnedOut)) break;
    const Vec3 axis = about * (1 / angle);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const auto turned = [&](Vec3 v) {
      return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
    };
    turn = {turned(turn.x), turned(turn.y), turned(turn.z)};
  }
  return turn;
}

void DetailTransfer::turnTo(std::span<const Vec3> places, Workers& workers) {
  const std::vector<Vec3> normals = normalsOf(coarse_, places);
  workers.forBlocks(turns_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::array<Vec3, 3> product{};
      const auto add = [&](Vec3 a, Vec3 b) { product[0] += b * a.x, product[1] += b * a.y, product[2] += b * a.z; };
      for (const std::uint32_t n : near_[k]) add(start_[n] - start_[k], places[n] - places[k]);
      add(normal_[k], normals[k] * (length(normal_[k]) / std::fmax(length(normals[k]), kTiniest)));
      turns_[k] = nearest(product, turns_[k]);
    }
  });
}

std::vector<Vec3> DetailTransfer::at(std::span<const Vec3> places, Workers& workers) {
  turnTo(places, workers);
  return at(places, std::vector<double>(places_.size(), 1), workers);
}

std::vector<Vec3> DetailTransfer::at(std::span<const Vec3> places, std::span<const double> share,
                                     Workers& workers) const {
  std::vector<Vec3> out(places_.size());
  workers.forBlocks(out.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t n = places_[k].node[c];
        out[k] += (places[n] + turns_[n](places_[k].offset[c]) * share[k]) * places_[k].weight[c];
      }
  });
  return out;
}

}  // namespace karinui
