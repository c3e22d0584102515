#include <algorithm>
#include <cmath>

#include "karinui/design/make_up.h"

namespace karinui {

namespace {

constexpr double kNearly = 0.06;  // metres: a garment drafted for nearly this height stands where its file says
constexpr double kApart = 0.02;   // metres before and behind the middle: pieces stand round a body, not flat beside it

struct Stands {
  double top = -1e9;
  bool before = false, behind = false;
  void add(const Piece& piece) {
    double nearest = 1e9, farthest = -1e9;
    const auto place = [&](Vec3 formed) {
      const Vec3 p = piece.pose(formed);
      top = std::max(top, p.y), nearest = std::min(nearest, p.z), farthest = std::max(farthest, p.z);
    };
    if (piece.form)
      for (const Vec3 p : piece.form->space) place(p);
    else
      for (const Flat p : piece.outline.flattened(1e-3)) place({p.u, p.v, 0});
    before = before || nearest > kApart;
    behind = behind || farthest < -kApart;
  }
  bool round() const { return before && behind; }
};

}  // namespace

RaisedPattern raisedTo(const Body& body, Pattern pattern) {
  Stands trunk, lower;
  for (const auto& [id, reading] : readPieces(pattern)) {
    const Piece& piece = *pattern.pieces.at(id);
    switch (reading.role) {
      case PieceRole::Front:
      case PieceRole::Back:
      case PieceRole::Yoke:
        trunk.add(piece);
        break;
      case PieceRole::Leg:
      case PieceRole::LegFront:
      case PieceRole::LegBack:
      case PieceRole::SkirtFront:
      case PieceRole::SkirtBack:
        lower.add(piece);
        break;
      default:
        break;
    }
  }
  const auto neck = body.landmarks().find("neck_left");
  const auto waist = body.measured().value.find("waist_height");
  double by = 0;
  if (trunk.round() && neck != body.landmarks().end())
    by = neck->second.y - trunk.top;
  else if (lower.round() && waist != body.measured().value.end())
    by = waist->second - lower.top;
  if (std::fabs(by) <= kNearly) return {std::move(pattern), 0};
  for (auto& [id, piece] : pattern.pieces) {
    Piece moved = *piece;
    moved.pose.carry.y += by;
    piece = std::make_shared<const Piece>(std::move(moved));
  }
  return {std::move(pattern), by};
}

}  // namespace karinui
