#pragma once
// What every operation is made of. An operation is a plain struct of ids and MATERIAL values only (edge and fraction,
// paper u-v, places on the body), never a ray, a pixel or a pose of the cloth; so undo, replay, scripts and
// made-to-measure are one thing.
//
//   kName, kHelp     its word, and what it does in a sentence
//   kDisturbsDrape   cloth that was at rest is brought to rest again after it (see disturbsDrape in operation.h)
//   fields()         its fields, each listed once by visit(name, value, help, kNeeded | kOptional): text form, file,
//                    help and JSON all grow from that list
//
// A field that has its default value is not written. Values and their text forms: values.h. A field whose numbers are
// given by formulas (formula.h) keeps the formulas: see Operation.
#include <string_view>

namespace karinui {

enum Need { kOptional, kNeeded };

// The operations of one header, for the variant of all.
template <class... Ops>
struct OperationList {};
template <class... A, class... B>
constexpr OperationList<A..., B...> operator+(OperationList<A...>, OperationList<B...>) {
  return {};
}

// Fields that many operations have.
inline constexpr std::string_view kClearHelp =
    "turned back only as far as the body and the cloth that stands let it: auto, yes, no (auto: yes beyond a right "
    "angle, but no in a record that does not have it)";
inline constexpr std::string_view kRoundHelp =
    "where on the body it is led round while the run's edges stand apart (otherwise beside the run's middle, on the "
    "part most of the run lies by)";
inline constexpr std::string_view kWrapHelp =
    "the edge of it that lies on top, for what goes round the body more than once (otherwise it stands as one ring)";
inline constexpr std::string_view kOverHelp =
    "where on the body it goes over (otherwise a shoulder, the nape, or straight across, by where its ends are)";

inline constexpr std::string_view kSeamsWithinHelp =
    "the seams within the pieces too, as those of their darts: auto, yes, no (auto: yes, but no in a record that does "
    "not "
    "have it)";
inline constexpr std::string_view kCornersHelp =
    "an end of the line within 3 mm of a corner goes to the corner: auto, yes, no (auto: yes, but no in a record that "
    "does not have it)";
inline constexpr std::string_view kCutEdgeHelp = "what the edges along the line are called (otherwise cut)";
inline constexpr std::string_view kEasesHelp =
    "what is declared as ease of a seam is of its copy too: auto, yes, no (auto: yes, but no in a record that does not "
    "have it)";
inline constexpr std::string_view kBothHalvesHelp =
    "on both halves of a symmetric piece: auto, yes, no (auto: if it is symmetric)";

inline constexpr std::string_view kCopiesHelp =
    "on the symmetric copy too: auto, yes, no (auto: if it is still the piece's likeness)";

template <class Self, class Visit>
void visitCloth(Self& self, Visit&& visit) {
  visit("fabric", self.fabric, "what it is cut from", kOptional);
  visit("layer", self.layer, "0 next to the skin", kOptional);
}

}  // namespace karinui
