#pragma once
// What the gestures share.
#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "karinui/session/gesture.h"

namespace karinui {

std::unique_ptr<Gesture> selectGesture();
std::unique_ptr<Gesture> drawGesture();
std::unique_ptr<Gesture> moveGesture();
std::unique_ptr<Gesture> sewGesture();
std::unique_ptr<Gesture> cutGesture();
std::unique_ptr<Gesture> pullGesture();
std::unique_ptr<Gesture> reshapeGesture();
std::unique_ptr<Gesture> pointsGesture();
std::unique_ptr<Gesture> notchGesture();
std::unique_ptr<Gesture> dartGesture();
std::unique_ptr<Gesture> lineGesture();
std::unique_ptr<Gesture> rectangleGesture();
std::unique_ptr<Gesture> circleGesture();
std::unique_ptr<Gesture> ringGesture();
std::unique_ptr<Gesture> polygonGesture();
std::unique_ptr<Gesture> pinGesture();
std::unique_ptr<Gesture> traceGesture();

inline constexpr Colour kChalk{0.93f, 0.33f, 0.10f};    // what is being done
inline constexpr Colour kGood{0.05f, 0.42f, 0.25f};     // will be accepted
inline constexpr Colour kBad{0.70f, 0.04f, 0.06f};      // will be refused
inline constexpr Colour kPartner{0.05f, 0.25f, 0.62f};  // the other side

constexpr double kShortestDrag = 0.01;  // metres: a shorter one was a click
constexpr double kDragStep = 0.005;     // metres: what is dragged is no finer; what is finer is typed, or drawn freely
constexpr double kFreeStep = 1e-4;      // metres: with the key held that leaves snapping out

// What is said where a slit or dart left the other half of a symmetric piece without a counterpart.
Message onlyThisHalf();

// The symmetric copies of a piece (or the piece it is the copy of) that are still its likeness.
std::vector<PieceId> copiesOf(const Document& document, PieceId piece);

// Tenths of a millimetre: a hand is no finer, and the record stays readable.
double tenth(double metres);
Flat tenth(Flat place);
Vec3 tenth(Vec3 step);

// The same where the place is that but for rounding; else to a ten-thousandth of a millimetre, as what has snapped to a
// line stays on it.
Flat exact(Flat place);

// A share of an edge's length in thousandths; the middle where it is within `near` of it.
double roundShare(double share, double near);

// The middle of an edge near a place of a piece's paper, else the middle line of a symmetric piece: there a place is
// meant to lie exactly.
struct MiddleSnap {
  Flat place;
  std::string edge;      // the edge whose middle it is, or on which the middle line ends; empty: within the piece
  bool onAxis = false;   // it lies on the middle line
  Message said() const;  // that it is so
};
std::optional<MiddleSnap> middleNear(const Piece& piece, Flat paper, double near);
// So near, in metres, is near enough for that.
double nearMiddle(const PointerSample& sample, const Hit& hit);
// A dot there, on the table and on the cloth.
void showMiddle(Preview& preview, const GestureContext& context, PieceId piece, const MiddleSnap& snap);

// Where the ray of a sample meets the plane through `through` that faces who looks.
Vec3 onFacing(const PointerSample& sample, Vec3 through);
// Where the hand is: its tip, or without one the place onFacing() gives.
Vec3 handAt(const PointerSample& sample, Vec3 through);
// How a tip has moved and turned from one sample to another; none where either has no tip.
std::optional<Rigid> tipMotion(const PointerSample& from, const PointerSample& to);

template <class Point>
double awayFromSegment(Point a, Point b, Point p) {
  const auto side = b - a;
  const double ss = dot(side, side);
  const double t = ss > 0 ? std::clamp(dot(p - a, side) / ss, 0.0, 1.0) : 0.0;
  return length(p - (a + side * t));
}

// The places of a line that matter, ends included (Douglas and Peucker, 1973); indices in order.
template <class Point>
std::vector<std::size_t> mattering(std::span<const Point> line, double miss);

// A part of an edge on the table, and its length.
std::vector<Flat> edgeOnTable(const GestureContext& context, const EdgeRef& part);
double lengthOf(const GestureContext& context, const EdgeRef& part);
void showEdge(Preview& preview, const GestureContext& context, const EdgeRef& part, const Colour& colour);
// "12.3 cm / 12.8 cm   +0.5 cm (4.1 %)": two sides of a seam, and what the second has to spare.
std::string easeSaid(const GestureContext& context, double one, double other);
// A line on a piece's paper, on the table and on the cloth.
void showOnPaper(Preview& preview, const GestureContext& context, PieceId piece, const std::vector<Flat>& line,
                 const Colour& colour);
// The mirror image of such a line on the symmetric copies of the piece.
void showOnCopies(Preview& preview, const GestureContext& context, PieceId piece, std::vector<Flat> line);

}  // namespace karinui
