#pragma once
// One text form for each kind of value an operation is made of: kindOf names it for help, writeValue and readValue are
// exact inverses. readValue also takes the friendlier spellings that people write.
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operation.h"

namespace karinui {

// "12.5mm" where that reads back as the same double, else bare metres.
std::string lengthText(double metres);
// The shortest text of `metres` in millimetres and its inverse, exact for every double: the decimal point moves,
// nothing is multiplied.
std::string millimetreText(double metres);
std::optional<double> parseMillimetres(std::string_view text);

// Splits at ";" and, if `atSpaces`, at white space; items are trimmed, empty ones fall away. White space beside a comma
// or an equals sign does not split.
std::vector<std::string> splitList(std::string_view text, bool atSpaces = true);

#define KARINUI_VALUE(Type, kind)                     \
  std::string writeValue(const Type& value);          \
  Done readValue(std::string_view text, Type& value); \
  inline std::string kindOf(const Type*) { return kind; }
KARINUI_VALUE(std::string, "name")
KARINUI_VALUE(bool, "yes|no")
KARINUI_VALUE(int, "whole number")
KARINUI_VALUE(double, "number")
KARINUI_VALUE(Length, "length")
KARINUI_VALUE(Angle, "angle")
KARINUI_VALUE(Flat, "u,v")
KARINUI_VALUE(Vec3, "x,y,z")
KARINUI_VALUE(Turn, "axis angle")
KARINUI_VALUE(Rigid, "x,y,z turn")
KARINUI_VALUE(Stated, "measurement=length")
KARINUI_VALUE(PieceRef, "piece")
KARINUI_VALUE(SeamRef, "seam")
KARINUI_VALUE(EdgeRef, "piece.edge")
KARINUI_VALUE(BodyPoint, "place on the body")
KARINUI_VALUE(Outline, "outline")
KARINUI_VALUE(std::vector<Outline>, "outlines")
KARINUI_VALUE(std::vector<InternalLine>, "lines")
KARINUI_VALUE(std::vector<Mark>, "marks")
KARINUI_VALUE(GradePoints, "graded places")
KARINUI_VALUE(Sex, "female|male|child")
KARINUI_VALUE(Choice, "auto|yes|no")
KARINUI_VALUE(SewEdges::Tie, "auto|1:1|2:1|pleat")
KARINUI_VALUE(PleatKind, "knife|box|inverted")
KARINUI_VALUE(AddPleat::Turned, "along|against|inwards|outwards")
KARINUI_VALUE(SetLength::Keep, "auto|start|end|middle")
KARINUI_VALUE(SetLength::Neighbours, "keep|follow")
KARINUI_VALUE(Lengthen::Beside, "slide|keep|follow")
KARINUI_VALUE(DraftBlock::Kind, "bodice|sleeve|skirt|trousers|leggings|shirt|collar")
KARINUI_VALUE(DraftBlock::Worn, "auto|holds|waist|high_hip")
KARINUI_VALUE(Fabric::Law, "woven|simcloth")
KARINUI_VALUE(Settings::Collider, "field|planes")
KARINUI_VALUE(Dye, "colour")
KARINUI_VALUE(Finish, "poplin|linen|denim|suiting|tweed|jersey|satin|chiffon|velvet|leather")
KARINUI_VALUE(PrintKind, "none|stripe|check|dot|photo")
KARINUI_VALUE(EdgeKind, "seam|hem|neckline|fold")
KARINUI_VALUE(FasteningKind, "button|snap|hook|tie|zip")
KARINUI_VALUE(Fasten::From, "auto|top|bottom|start|end")
KARINUI_VALUE(Fasten::Holes, "across|along")
KARINUI_VALUE(SewPocket::Kind, "seam|slant")
KARINUI_VALUE(SewWelt::Kind, "jetted|single")
KARINUI_VALUE(CornerKind, "mitre|points|mirror_before|mirror_after|square_before|square_after")
#undef KARINUI_VALUE

Done readValue(std::string_view text, std::vector<Stated>& values);

template <class T>
std::string kindOf(const std::optional<T>*) {
  return kindOf(static_cast<const T*>(nullptr));
}
template <class T>
std::string kindOf(const std::vector<T>*) {
  return "list of " + kindOf(static_cast<const T*>(nullptr));
}

template <class T>
std::string writeValue(const std::optional<T>& value) {
  return value ? writeValue(*value) : std::string();
}
template <class T>
Done readValue(std::string_view text, std::optional<T>& value) {
  return readValue(text, value.emplace());
}

template <class T>
std::string writeValue(const std::vector<T>& values) {
  std::string all;
  for (const T& value : values) all += (all.empty() ? "" : "; ") + writeValue(value);
  return all;
}
template <class T>
Done readValue(std::string_view text, std::vector<T>& values) {
  values.clear();
  for (const std::string& item : splitList(text)) {
    if (Done done = readValue(item, values.emplace_back()); !done) return done;
  }
  return {};
}

}  // namespace karinui
