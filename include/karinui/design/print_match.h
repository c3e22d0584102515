#pragma once
// Where a print lies on the pieces, and whether stripes and checks meet in the seams. Pure; any thread.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

// Where on a piece's paper its print begins: its own placing, else the mirror image of its original's; (0, 0)
// otherwise.
Flat printOrigin(const Document& document, const Piece& piece);
// Height over width of a photograph among the document's blobs.
using PhotoTall = std::function<double(const std::string& photo)>;
PhotoTall photosIn(const Blobs& blobs);
// From one stripe, check, dot or photograph to the next: across and along the print.
Flat printRepeat(const Look& look, const PhotoTall& tall);

// How the print of one side of a seam meets that of the other.
struct PrintMeeting {
  double most = 0;  // metres by which it misses, at most
  double at = 0;    // there; share of the seam's length
};
// Nothing: a side has no print, the two are not alike, or the seam closes a dart or a pleat, stitches a pleat down, or
// gathers one side.
std::optional<PrintMeeting> printMeeting(const Document& document, const Seam& seam, const PhotoTall& tall);

// The placing (across and along the grain) at which the print of `moved` meets that of the other side at a share of the
// seam's length. Stripes and checks, which look alike in a mirror, meet as they go on over the seam or as they are
// mirrored in it: whichever stays nearer along the whole seam.
Result<Flat> matchingShift(const Document& document, const Seam& seam, double at, PieceId moved, const PhotoTall& tall);

inline constexpr double kPrintMeets = 0.002;  // metres: what misses by less is called matched
// Of every seam (or of one, which is then not named) at which a print does not match: by how much, and where.
std::vector<Message> unmatchedSaid(const Document& document, const PhotoTall& tall, SeamId of = {});

// Where a repeat of the print begins on one side of a seam in which it matches: a short bar there and where the other
// side meets it, under one number, by which both pieces are laid on the cloth. At most nine a seam, no nearer than 5
// cm.
struct MatchMark {
  PieceId piece;
  Flat from, to;   // from the seam line into the piece, along the line of the print; metres on its paper
  int number = 0;  // 1, 2, …; the same on the piece it is sewn to
};
std::vector<MatchMark> matchMarks(const Document& document, const PhotoTall& tall);

}  // namespace karinui
