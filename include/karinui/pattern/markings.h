#pragma once
// What is marked on the edges and on the inside of a pattern's pieces: notches, drill holes, the seams' numbers. Every
// drawing of the flat pattern, printed sheet and cutting table alike, takes its marks from here. Metres on paper. Pure;
// any thread.
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/piece.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

struct PaperStroke {
  Flat from, to;
  bool operator==(const PaperStroke&) const = default;
};

// A place on an outline or on the edge of a hole; `outward` is a unit step at right angles to it, out of the cloth.
struct BorderPlace {
  Flat place, outward;
  bool corner = false;  // at a corner of the outline that anyone sees
};
std::optional<BorderPlace> borderPlace(const Pattern& pattern, const SeamPlace& at);  // nothing: no such piece or edge
// The same on an internal line too, of which either side is cloth: then outward is to its right.
std::optional<BorderPlace> sewnPlace(const Pattern& pattern, const SeamPlace& at);

// Places where sewn pieces must meet, for each seam as many on either side, two beside each other where a back meets
// anything but a front; the mouths of folded darts, the folds and placement lines of pleats; then the person's own
// notches.
struct NotchPlace {
  PieceId piece;
  Flat place, outward;
  std::string seam;     // its name; a seam need not have one
  bool own = false;     // the person's own
  std::string edge;     // on which it is
  bool corner = false;  // of the outline, which marks the place by itself
};
std::vector<NotchPlace> notchPlaces(const Pattern& pattern);
// From the seam line out to the cut line; on a pattern of seam lines only (allowance 0), a short stroke inwards.
inline constexpr double kNotchLength = 0.005;
PaperStroke strokeOf(const NotchPlace& notch, double allowance = 0);

std::vector<Flat> drillHoles(const Piece& piece);                          // the person's own,
std::vector<Flat> drillHoles(const Pattern& pattern, const Piece& piece);  // and short of the points of folded darts
inline constexpr double kDrillShort = 0.010;
inline constexpr double kDrillInside = 0.003;   // of the legs of a dart with two points
inline constexpr double kDrillRadius = 0.0025;  // of the circle round a drill hole,
inline constexpr double kDrillArm = 0.004;      // and of each arm of the cross through it

// What is said along an edge or a line: "elastic 56 cm", "fold 90°".
struct PaperNote {
  PieceId piece;
  Message words;
  Flat place;  // the middle of the lettering
  bool upright = true;
};
inline constexpr double kNoteSize = 0.004;  // of the font
std::vector<PaperNote> notesOf(const Pattern& pattern, const Allowances& finish);
// Where an elastic's quarters come, to be pinned before it is sewn, and the ends of zips.
std::vector<NotchPlace> finishNotches(const Pattern& pattern, const Allowances& finish);
// Crosses where buttons, snaps, hooks and ties are sewn on, bars where buttonholes are cut; of their true size.
struct PaperFastener {
  PieceId piece;
  std::vector<PaperStroke> strokes;
};
std::vector<PaperFastener> fastenersOf(const Pattern& pattern, const Fastenings& fastenings);
// Arrows across pleats, from the fold to the line where it comes to lie.
struct PaperArrow {
  PieceId piece;
  PaperStroke shaft, head, otherHead;
};
std::vector<PaperArrow> pleatArrows(const Pattern& pattern);
// The number of a seam, counted from 1, beside the middle of what each piece has of either side.
struct SeamTag {
  PieceId piece;
  Flat place;  // the middle of the lettering
  std::size_t number = 0;
};
inline constexpr double kSeamTagSize = 0.0045;  // of the font
std::vector<SeamTag> seamTags(const Pattern& pattern);

}  // namespace karinui
