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

// Where a part of a name begins: a word of ours, or what the program calls an edge by its number. "e3" counts from one,
// "edge_3" and "seam_3" (GarmentCode) from zero.
struct Stem {
  Message words;
  bool numbered = false;
  std::size_t parts = 0;  // of the name
  std::string number;     // "2" of "line2"
};
std::optional<Stem> stemOf(std::span<const std::string_view> parts) {
  const std::string_view first = parts.front();
  if (first.size() > 1 && first[0] == 'e' && isDigits(first.substr(1)))
    return Stem{say("edge {0}", first.substr(1)), true, 1, {}};
  if (first.size() > 1 && first[0] == 'h' && isDigits(first.substr(1)))
    return Stem{say("hole {0}", first.substr(1)), false, 1, {}};
  if (parts.size() > 1) {
    if ((first == "edge" || first == "seam") && isDigits(parts[1])) {
      const std::string number = std::to_string(std::stol(std::string(parts[1])) + 1);
      return Stem{first == "edge" ? say("edge {0}", number) : say("seam {0}", number), true, 2, {}};
    }
    if (const auto word = termSaid(Term::Word, std::string(first) + "_" + std::string(parts[1])))
      return Stem{*word, false, 2, {}};
  }
  if (const auto word = termSaid(Term::Word, first)) return Stem{*word, false, 1, {}};
  const std::size_t digits = first.find_last_not_of("0123456789") + 1;
  if (digits == 0 || digits == first.size()) return std::nullopt;
  if (const auto word = termSaid(Term::Word, first.substr(0, digits)))
    return Stem{*word, false, 1, std::string(first.substr(digits))};
  return std::nullopt;
}

// One word of a name with what is said of it: "front_left", "side_2".
struct NamePart {
  enum class Side { None, Left, Right } side = Side::None;
  enum class Half { None, Front, Back } half = Half::None;
  Stem stem;
  bool garment = false;  // has a front and a back, and is none itself
};
Message partSaid(const NamePart& part) {
  const Stem& stem = part.stem;
  Message said = stem.words;
  if (part.half != NamePart::Half::None)
    said = part.half == NamePart::Half::Front ? say("front {0}", said) : say("back {0}", said);
  if (!stem.number.empty()) said = say("{0} {1}", said, stem.number);
  if (part.side == NamePart::Side::None) return said;
  if (stem.numbered)
    return part.side == NamePart::Side::Left ? say("{0}, left half", said) : say("{0}, right half", said);
  return part.side == NamePart::Side::Left ? say("left {0}", said) : say("right {0}", said);
}

}  // namespace

bool isNumbered(std::string_view edge) {
  auto parts = splitAt(edge, "_-");
  if (parts.size() > 1 && (parts[0] == "left" || parts[0] == "right")) parts.erase(parts.begin());
  const auto stem = stemOf(parts);
  return stem && stem->numbered;
}

namespace {

// "cotton", "cotton_2", "wool_suiting_2"
std::optional<Message> fabricNameSaid(std::string_view name, const std::vector<std::string_view>& parts) {
  if (parts.size() == 1) return termSaid(Term::Fabric, name);
  if (parts.size() > 3 || !isDigits(parts.back())) return std::nullopt;
  const auto fabric =
      termSaid(Term::Fabric, parts.size() == 2 ? std::string(parts[0])
                                               : std::string(parts[0]).append(" ").append(std::string(parts[1])));
  return fabric ? std::optional(say("{0} {1}", *fabric, parts.back())) : std::nullopt;
}

// What follows a word and says which of several it is.
bool isPlace(std::string_view part) {
  static constexpr std::array<std::string_view, 4> kPlaces{"front", "back", "left", "right"};
  return isDigits(part) || std::find(kPlaces.begin(), kPlaces.end(), part) != kPlaces.end();
}

// What follows "top" or "outer" where that is a garment, not an edge, as when a block's pieces are called so:
// "top_front_left".
bool isOfAGarment(std::string_view part) {
  static constexpr std::array<std::string_view, 10> kParts{"front", "back",   "sleeve", "collar", "cuff",
                                                           "stand", "pocket", "yoke",   "skirt",  "leg"};
  return std::find(kParts.begin(), kParts.end(), part) != kParts.end();
}

// "outer", "outer2"
bool isOuter(std::string_view part) {
  return part.starts_with("outer") && (part.size() == 5 || isDigits(part.substr(5)));
}

// A name the program made up, or that is made of words it knows; nothing: a person's own. What is named later belongs
// to what is named before: "pocket_left_low_right" is the right lower edge of the left pocket.
std::optional<Message> ownNameSaid(std::string_view name) {
  using Side = NamePart::Side;
  using Half = NamePart::Half;
  static constexpr std::array<std::string_view, 11> kGarments{
      "blouse", "cape", "coat", "dress", "jacket", "pants", "shirt", "trousers", "vest", "waistcoat", "yoke"};
  std::vector<std::string_view> parts = splitAt(name, "_-");
  if (const auto fabric = fabricNameSaid(name, parts); fabric && !stemOf(parts)) return fabric;
  // GarmentCode says the side first: "left_sleeve_f".
  Side first = Side::None;
  if (parts.size() > 1 && (parts[0] == "left" || parts[0] == "right")) {
    first = parts[0] == "left" ? Side::Left : Side::Right;
    parts.erase(parts.begin());
  }
  std::vector<NamePart> all;
  bool mirrored = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string_view part = parts[i];
    NamePart* last = all.empty() ? nullptr : &all.back();
    const bool left = part == "left" || part == "l", front = part == "front" || part == "f";
    if (last && (left || part == "right" || part == "r")) {
      if (last->side != Side::None) return std::nullopt;
      last->side = left ? Side::Left : Side::Right;
    } else if (last && !last->garment && last->half == Half::None && (front || part == "back" || part == "b")) {
      last->half = front ? Half::Front : Half::Back;
    } else if (last && (part == "mirror" || part == "mirrored")) {
      mirrored = true;
    } else if (last && isDigits(part)) {
      last->stem.number += (last->stem.number.empty() ? "" : "-") + std::string(part);
    } else if (!last && (part == "top" || isOuter(part)) && i + 1 < parts.size() && isOfAGarment(parts[i + 1])) {
      NamePart top;
      top.stem = {part == "top" ? say("top") : say("outer layer"), false, 1,
                  std::string(part.substr(part == "top" ? 3 : 5))};
      top.side = first;
      top.garment = true;
      all.push_back(std::move(top));
    } else {
      const auto stem = stemOf(std::span(parts).subspan(i));
      if (!stem) return std::nullopt;
      // Of a sleeve's edges: "under_front". In "placket_under" it is no underarm, but what a person called it.
      if (part == "under" && stem->parts == 1 && (last || (i + 1 < parts.size() && !isPlace(parts[i + 1]))))
        return std::nullopt;
      NamePart next;
      if (!last) next.side = first;
      next.stem = *stem;
      next.garment = std::find(kGarments.begin(), kGarments.end(), part) != kGarments.end();
      all.push_back(std::move(next));
      i += stem->parts - 1;
    }
  }
  Message said = partSaid(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) said = say("{0} of {1}", partSaid(all[i]), said);
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

Message nameSaid(std::string_view name) {
  if (const auto own = ownNameSaid(name)) return *own;
  std::string words(name);  // names have no spaces
  const bool single = !name.starts_with('_') && !name.ends_with('_') && name.find("__") == std::string_view::npos;
  if (single) std::replace(words.begin(), words.end(), '_', ' ');
  return say("{0}", words);
}

std::string nameTyped(std::string_view said) {
  static constexpr std::string_view kWideSpace = "\u3000";
  std::string plain;
  while (!said.empty()) {
    const bool wide = said.starts_with(kWideSpace), space = wide || said.front() == ' ' || said.front() == '\t';
    if (!space) {
      plain += said.front();
    } else if (!plain.empty() && plain.back() != ' ') {
      plain += ' ';
    }
    said.remove_prefix(wide ? kWideSpace.size() : 1);
  }
  while (plain.ends_with(' ')) plain.pop_back();
  if (auto known = identifierOf(plain)) return *std::move(known);
  std::replace(plain.begin(), plain.end(), ' ', '_');
  return plain;
}

Message edgeSaid(std::string_view piece, std::string_view edge) {
  return say("{0} of {1}", nameSaid(edge), idSaid(piece).value_or(nameSaid(piece)));
}

Message fasteningSaid(std::string_view name) {
  const std::size_t bar = name.find('_');
  for (const NamedTerm& term : fasteningTerms()) {
    if (term.identifier != name.substr(0, bar)) continue;
    if (bar == std::string_view::npos) return term.name;
    const std::string_view rest = name.substr(bar + 1);
    if (rest == "left") return say("left {0}", term.name);
    if (rest == "right") return say("right {0}", term.name);
    if (isDigits(rest)) return say("{0} {1}", term.name, rest);
  }
  return nameSaid(name);
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
    for (const NamedTerm& term : tableOf(kind))
      if (isSaid(term.name)) return std::string(term.identifier);
  for (const NamedTerm& term : wordTerms()) {
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
