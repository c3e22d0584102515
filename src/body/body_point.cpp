#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/body/lines.h"

namespace karinui {

namespace {

using Part = BodyPoint::Part;

struct PartName {
  std::string_view name;
  Part part;
};
constexpr std::array<PartName, 5> kParts{{{"torso", Part::Torso},
                                          {"left_arm", Part::LeftArm},
                                          {"right_arm", Part::RightArm},
                                          {"left_leg", Part::LeftLeg},
                                          {"right_leg", Part::RightLeg}}};

Error unreadable(std::string_view text) {
  return badInput(
      say("\"{0}\" is not a place on a body. Write it like torso:waist+0.4@0.25, landmark:shoulder_left, "
          "line:side_left@0.4 or face:123@0.2,0.3.",
          text.substr(0, 80)));
}

std::optional<double> levelOf(Part part, std::string_view name) {
  const auto levels = chartLevels(part);
  const auto it = std::find(levels.begin(), levels.end(), name);
  if (it == levels.end()) return std::nullopt;
  return static_cast<double>(it - levels.begin());
}

Error unknownLevel(Part part, std::string_view partName, std::string_view level) {
  std::string list;
  for (const auto& name : chartLevels(part)) list += (list.empty() ? "" : ", ") + std::string(name);
  return notFound(say("There is no level \"{0}\" on the {1}. Levels: {2}.", level.substr(0, 40), partName, list));
}

// "3.5", "waist", "waist+0.4" or "waist-0.4"
Result<double> parseAlong(Part part, std::string_view partName, std::string_view text) {
  if (const auto number = parseNumber(text)) return *number;
  const std::size_t sign = text.find_first_of("+-");
  const auto level = levelOf(part, text.substr(0, sign));
  if (!level) return unknownLevel(part, partName, text.substr(0, sign));
  if (sign == std::string_view::npos) return *level;
  const auto offset = parseNumber(text.substr(sign + 1));
  if (!offset || *offset < 0) return unreadable(text);
  return text[sign] == '+' ? *level + *offset : *level - *offset;
}

Result<BodyPoint> parseFace(std::string_view all, std::string_view rest) {
  const std::size_t at = rest.find('@'), comma = rest.find(',');
  if (at == std::string_view::npos || comma == std::string_view::npos || comma < at) return unreadable(all);
  const auto face = parseNumber(rest.substr(0, at)), a = parseNumber(rest.substr(at + 1, comma - at - 1)),
             b = parseNumber(rest.substr(comma + 1));
  if (!face || !a || !b || *face < 0 || *face > 4e9 || *face != std::floor(*face)) return unreadable(all);
  if (*a < 0 || *b < 0 || *a + *b > 1 + 1e-12) return unreadable(all);
  BodyPoint point;
  point.part = Part::Face;
  point.onFace = {static_cast<std::uint32_t>(*face), {*a, *b, std::max(0.0, 1 - *a - *b)}};
  return point;
}

bool isName(std::string_view text) {
  return !text.empty() && text.size() < 64 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

Result<BodyPoint> parseLine(std::string_view all, std::string_view rest) {
  const std::size_t at = rest.find('@');
  if (at == std::string_view::npos || !isName(rest.substr(0, at))) return unreadable(all);
  const auto share = parseNumber(rest.substr(at + 1));
  if (!share || !(*share >= 0 && *share <= 1)) return unreadable(all);
  const auto names = bodyLineNames();
  BodyPoint point;
  point.part = Part::Line;
  point.landmark = rest.substr(0, at);
  point.along = *share;
  if (std::find(names.begin(), names.end(), point.landmark) != names.end()) return point;
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return notFound(say("There is no line \"{0}\" on a body. Lines: {1}.", point.landmark, list));
}

}  // namespace

std::string text(const BodyPoint& point) {
  if (point.part == Part::Landmark) return "landmark:" + point.landmark;
  if (point.part == Part::Face)
    return "face:" + std::to_string(point.onFace.face) + "@" + shortest(point.onFace.weight[0]) + "," +
           shortest(point.onFace.weight[1]);
  if (point.part == Part::Line) return "line:" + point.landmark + "@" + shortest(point.along);
  for (const PartName& p : kParts)
    if (p.part == point.part) return std::string(p.name) + ":" + shortest(point.along) + "@" + shortest(point.around);
  return {};
}

Result<BodyPoint> parseBodyPoint(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return unreadable(text);
  const std::string_view head = text.substr(0, colon), rest = text.substr(colon + 1);
  BodyPoint point;
  if (head == "landmark") {
    if (!isName(rest)) return unreadable(text);
    point.part = Part::Landmark;
    point.landmark = rest;
    return point;
  }
  if (head == "line") return parseLine(text, rest);
  if (head == "face") return parseFace(text, rest);
  const auto it = std::find_if(kParts.begin(), kParts.end(), [&](const PartName& p) { return p.name == head; });
  const std::size_t at = rest.find('@');
  if (it == kParts.end() || at == std::string_view::npos) return unreadable(text);
  point.part = it->part;
  const auto along = parseAlong(point.part, it->name, rest.substr(0, at));
  if (!along) return along.error();
  const auto around = parseNumber(rest.substr(at + 1));
  if (!around) return unreadable(text);
  const double top = static_cast<double>(chartLevels(point.part).size() - 1);
  if (!(*along >= 0 && *along <= top))
    return badInput(
        say("{0} lies beyond the {1}, which has levels 0 to {2}.", text.substr(0, 80), it->name, shortest(top)));
  if (std::abs(*around) > 1e6) return unreadable(text);
  point.along = *along;
  point.around = *around - std::floor(*around);
  if (point.around >= 1) point.around = 0;
  return point;
}

}  // namespace karinui
