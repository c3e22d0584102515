#include "karinui/design/glossary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "design/glossary/terms.h"
#include "karinui/base/number.h"
#include "karinui/body/lines.h"

namespace karinui {

namespace {

TermTable tableOf(Term kind) {
  switch (kind) {
    case Term::Measure:
      return measureTerms();
    case Term::Landmark:
      return landmarkTerms();
    case Term::Part:
      return partTerms();
    case Term::Level:
      return levelTerms();
    case Term::Fabric:
      return fabricTerms();
    case Term::Size:
      return sizeTerms();
    case Term::OperationName:
      return operationTerms();
    case Term::Field:
      return fieldTerms();
    case Term::Value:
      return valueTerms();
    case Term::Word:
      return wordTerms();
  }
  return {};
}

// A term that should be there, else the identifier itself.
Message termOrItself(Term kind, std::string_view identifier) {
  return termSaid(kind, identifier).value_or(say("{0}", identifier));
}

bool isDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos && text.size() < 9;
}

std::vector<std::string_view> splitAt(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find_first_of(separators);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// "p3" and "p3.2", "s5": what has no name of its own, or is there no more.
std::optional<Message> idSaid(std::string_view text) {
  if (text.size() < 2 || (text[0] != 'p' && text[0] != 's')) return std::nullopt;
  const auto parts = splitAt(text.substr(1), ".");
  if (parts.size() > 2 || !std::all_of(parts.begin(), parts.end(), isDigits)) return std::nullopt;
  std::string number(parts[0]);
  if (parts.size() == 2) number.append("-").append(parts[1]);
  return text[0] == 'p' ? say("piece {0}", number) : say("seam {0}", number);
}

// What a name begins with: a word of ours, or what the program calls an edge by its number. "e3" counts from one,
// "edge_3" and "seam_3" (GarmentCode) from zero.
struct Stem {
  Message words;
  bool numbered = false;
  std::size_t parts = 0;  // of the name
};
std::optional<Stem> stemOf(const std::vector<std::string_view>& parts) {
  const std::string_view first = parts.front();
  if (first.size() > 1 && first[0] == 'e' && isDigits(first.substr(1)))
    return Stem{say("edge {0}", first.substr(1)), true, 1};
  if ((first == "edge" || first == "seam") && parts.size() > 1 && isDigits(parts[1])) {
    const std::string number = std::to_string(std::stol(std::string(parts[1])) + 1);
    return Stem{first == "edge" ? say("edge {0}", number) : say("seam {0}", number), true, 2};
  }
  if (const auto word = termSaid(Term::Word, first)) return Stem{*word, false, 1};
  return std::nullopt;
}

}  // namespace

bool isNumbered(std::string_view edge) {
  auto parts = splitAt(edge, "_-");
  if (parts.size() > 1 && (parts[0] == "left" || parts[0] == "right")) parts.erase(parts.begin());
  const auto stem = stemOf(parts);
  return stem && stem->numbered;
}

namespace {

// A name the program made up, or that is made of words it knows; nothing: a person's own.
std::optional<Message> ownNameSaid(std::string_view name) {
  std::vector<std::string_view> parts = splitAt(name, "_-");
  enum class Side { None, Left, Right } side = Side::None;
  enum class Half { None, Front, Back } half = Half::None;
  bool mirrored = false;
  std::string number;
  const bool alone = parts.size() == 1;
  // GarmentCode says the side first: "left_sleeve_f".
  if (parts.size() > 1 && (parts[0] == "left" || parts[0] == "right")) {
    side = parts[0] == "left" ? Side::Left : Side::Right;
    parts.erase(parts.begin());
  }
  const auto stem = stemOf(parts);
  if (!stem) {
    if (const auto fabric = alone ? termSaid(Term::Fabric, name) : std::nullopt) return fabric;
    const auto fabric = parts.size() == 2 && isDigits(parts[1]) ? termSaid(Term::Fabric, parts[0])
                        : parts.size() == 3 && isDigits(parts[2])
                            ? termSaid(Term::Fabric, std::string(parts[0]) + " " + std::string(parts[1]))
                            : std::nullopt;
    return fabric ? std::optional(say("{0} {1}", *fabric, parts.back())) : std::nullopt;
  }
  for (std::size_t i = stem->parts; i < parts.size(); ++i) {
    const std::string_view part = parts[i];
    if (part == "left" || part == "l") {
      side = Side::Left;
    } else if (part == "right" || part == "r") {
      side = Side::Right;
    } else if (part == "front" || part == "f") {
      half = Half::Front;
    } else if (part == "back" || part == "b") {
      half = Half::Back;
    } else if (part == "mirror" || part == "mirrored") {
      mirrored = true;
    } else if (isDigits(part)) {
      number += (number.empty() ? "" : "-") + std::string(part);
    } else {
      return std::nullopt;
    }
  }
  Message said = stem->words;
  if (half != Half::None) said = half == Half::Front ? say("front {0}", said) : say("back {0}", said);
  if (!number.empty()) said = say("{0} {1}", said, number);
  if (side != Side::None && stem->numbered)
    said = side == Side::Left ? say("{0}, left half", said) : say("{0}, right half", said);
  else if (side != Side::None)
    said = side == Side::Left ? say("left {0}", said) : say("right {0}", said);
  return mirrored ? say("{0}, mirrored", said) : said;
}

// "front.side_left", "p6.edge_0@0.25:0.5"
std::optional<Message> partSaid(std::string_view text) {
  const std::size_t at = text.find('@');
  const std::string_view whole = text.substr(0, at);
  const std::size_t dot = whole.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || whole.find(' ') != std::string_view::npos) return std::nullopt;
  if (!ownNameSaid(whole.substr(dot + 1))) return std::nullopt;
  const Message edge = edgeSaid(whole.substr(0, dot), whole.substr(dot + 1));
  if (at == std::string_view::npos) return edge;
  const auto ends = splitAt(text.substr(at + 1), ":");
  const auto from = parseNumber(ends.front()), to = parseNumber(ends.back());
  if (ends.size() != 2 || !from || !to) return std::nullopt;
  return say("{0}, {1} % to {2} %", edge, fixed(100 * *from, 0), fixed(100 * *to, 0));
}

std::optional<Message> oneSaid(std::string_view text) {
  for (const Term kind : {Term::Measure, Term::Part, Term::Fabric})
    if (const auto name = termSaid(kind, text)) return name;
  if (const auto id = idSaid(text)) return id;
  if (text.find(':') != std::string_view::npos)
    if (const auto place = parseBodyPoint(text)) return placeSaid(*place);
  if (const auto part = partSaid(text)) return part;
  if (const auto name = ownNameSaid(text)) return name;
  for (const Term kind : {Term::Landmark, Term::Level})
    if (const auto name = termSaid(kind, text)) return name;
  return std::nullopt;
}

}  // namespace

std::optional<Message> termSaid(Term kind, std::string_view identifier) {
  for (const NamedTerm& term : tableOf(kind))
    if (term.identifier == identifier) return term.name;
  return std::nullopt;
}

Message fieldSaid(std::string_view operation, std::string_view field) {
  if (const auto own = termSaid(Term::Field, std::string(field) + "." + std::string(operation))) return *own;
  return termOrItself(Term::Field, field);
}

Message placeSaid(const BodyPoint& place) {
  if (place.part == BodyPoint::Part::Landmark) return termOrItself(Term::Landmark, place.landmark);
  if (place.part == BodyPoint::Part::Line) return bodyLineSaid(place.landmark);
  const auto levels = chartLevels(place.part);
  if (levels.empty()) return say("a place on the skin");
  constexpr double kOn = 0.2;  // of the way from a level to the next: still at the level
  const double top = static_cast<double>(levels.size() - 1), along = std::clamp(place.along, 0.0, top);
  const auto level = [&](double which) { return termOrItself(Term::Level, levels[static_cast<std::size_t>(which)]); };
  const double nearest = std::round(along);
  Message said = std::fabs(along - nearest) <= kOn
                     ? level(nearest)
                     : say("between {0} and {1}", level(std::floor(along)), level(std::floor(along) + 1));
  switch (static_cast<int>(std::lround(place.around * 8)) % 8) {
    case 0:
      said = say("{0}, front", said);
      break;
    case 1:
      said = say("{0}, left front", said);
      break;
    case 2:
      said = say("{0}, left side", said);
      break;
    case 3:
      said = say("{0}, left back", said);
      break;
    case 4:
      said = say("{0}, back", said);
      break;
    case 5:
      said = say("{0}, right back", said);
      break;
    case 6:
      said = say("{0}, right side", said);
      break;
    default:
      said = say("{0}, right front", said);
      break;
  }
  static constexpr std::array<std::string_view, 5> kParts{"torso", "left_arm", "right_arm", "left_leg", "right_leg"};
  if (place.part == BodyPoint::Part::Torso) return said;
  return say("{0}, {1}", termOrItself(Term::Part, kParts[static_cast<std::size_t>(place.part)]), said);
}

Message nameSaid(std::string_view name) { return ownNameSaid(name).value_or(say("{0}", name)); }

Message edgeSaid(std::string_view piece, std::string_view edge) {
  return say("{0} of {1}", nameSaid(edge), idSaid(piece).value_or(nameSaid(piece)));
}

std::optional<Message> identifierSaid(std::string_view text) {
  if (text.empty() || text.size() > 2000) return std::nullopt;
  if (const auto one = oneSaid(text)) return one;
  if (text.find(", ") == std::string_view::npos) return std::nullopt;
  std::vector<Message> all;
  bool any = false;
  for (std::string_view item : splitAt(text, ",")) {
    while (item.starts_with(' ')) item.remove_prefix(1);
    const auto one = oneSaid(item);
    any = any || one;
    all.push_back(one.value_or(say("{0}", item)));
  }
  return any ? std::optional(listSaid(all)) : std::nullopt;
}

std::optional<std::string> identifierOf(std::string_view said) {
  const auto plain = [](std::string_view words) {
    std::string low(words);
    for (char& c : low) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return low;
  };
  const std::string wanted = plain(said);
  const auto isSaid = [&](const Message& name) {
    return plain(text(name)) == wanted || text(name, Language::Japanese) == wanted;
  };
  for (const Term kind : {Term::Word, Term::Measure, Term::Fabric})
    for (const NamedTerm& term : tableOf(kind)) {
      if (isSaid(term.name)) return std::string(term.identifier);
      if (kind != Term::Word) continue;
      for (const char* side : {"_left", "_right", "_front", "_back"})
        if (const std::string name = std::string(term.identifier) + side; isSaid(nameSaid(name))) return name;
    }
  return std::nullopt;
}

Message listSaid(const std::vector<Message>& all) {
  Message said;
  for (const Message& one : all) said = said.empty() ? one : say("{0}, {1}", said, one);
  return said;
}

}  // namespace karinui
