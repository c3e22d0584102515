#pragma once
// What garments are opened and closed by: buttons, snaps, hooks, ties and zips, along two runs of edges (or of internal
// lines) that are walked together as a seam's sides are. Metres on paper; places along a run are shares of its length.
// Pure; any thread.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/pattern/edit.h"

namespace karinui {

enum class FasteningKind { Button, Snap, Hook, Tie, Zip };

// What a kind has and another has not: said here once, for the operation, its help and the dialogs. A kind that is new
// gets a row in fastening.cpp.
struct FasteningTraits {
  FasteningKind kind;
  std::string_view plural;  // one that is given no name is called so
  bool counted = true;      // single places, of which some may be closed; else one run, closed for a length
  bool sized = false;       // a disc that needs cloth about it
  bool holed = false;       // its upper side is cut
  bool gapped = false;      // holds its places apart
};
const FasteningTraits& traitsOf(FasteningKind kind);

struct Fastening {
  FasteningKind kind = FasteningKind::Button;
  std::vector<EdgeSpan> a, b;  // as of a Seam; a, which has the buttonholes, lies over b
  bool reversed = true;
  std::vector<double> at;   // places along the runs, ascending; a zip's two ends
  bool fromStart = true;    // `closed` is counted from the start of a's run. A zip opens there.
  int closed = 0;           // how many of the places are closed; of a zip `zipped` says it
  double zipped = 1;        // share of the zip that is closed, from the end where it does not open
  double inset = 0;         // of the places, into the pieces; of an internal line to its left
  double size = 0.011;      // diameter of a button or snap
  double gap = 0;           // how far apart a tie holds its places
  bool holesAlong = false;  // buttonholes lie along the edge, not across
  bool operator==(const Fastening&) const = default;
};
inline constexpr int kMostFastened = 200;
inline constexpr double kHoleLonger = 0.003;  // a buttonhole is longer than its button by the button's thickness
bool sound(const Fastening& fastening);

using Fastenings = std::map<std::string, Fastening>;  // by name

// A place on one side; `outward`: unit, out of the piece (of an internal line to its right).
struct FasteningPlace {
  PieceId piece;
  Flat place, outward;
};
struct FastenedPlaces {
  FasteningPlace a, b;
  bool closed = true;
};
// In the order along a's run; a zip's two ends. Nothing where a side is not on the pattern.
std::vector<FastenedPlaces> placesOf(const Pattern& pattern, const Fastening& fastening);
double lengthOf(const Pattern& pattern, const Fastening& fastening);  // of a zip; of a's run from first to last place

// The zip's closed part as a seam; nothing where it is open, and for other kinds.
std::optional<Seam> zipSeam(const Pattern& pattern, const Fastening& fastening);
// The pattern as it is worn: with its closed zips as seams. Their ids are no document's.
SeamId zipId(std::size_t number);  // of the number-th fastening by name
Pattern withZips(Pattern pattern, const Fastenings& fastenings);

// Leads them over to the edges of an edited pattern. What has lost a side is dropped.
void updateFastenings(Fastenings& fastenings, const EdgeMap& map, const Pattern& now);

// What is sewn to side a (`over`) or b: "6 buttonholes 14 mm", "6 buttons 11 mm", "zip 20 cm".
Message fastenedSaid(const Pattern& pattern, const Fastening& fastening, bool over);
// What has to be bought, alike things together: "6 buttons 11 mm", "zip 20 cm".
std::vector<Message> notionsSaid(const Pattern& pattern, const Fastenings& fastenings);

}  // namespace karinui
