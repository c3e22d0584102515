#include "design/text/value_text.h"

#include <array>
#include <charconv>

#include "design/text/formula_fields.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::vector<std::string_view> splitAt(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class Word, std::size_t n>
struct Words {
  std::array<std::pair<std::string_view, Word>, n> all;
  std::string write(Word word) const {
    for (const auto& [name, value] : all)
      if (value == word) return std::string(name);
    return {};
  }
  Done read(std::string_view text, Word& word) const {
    std::string names;
    for (const auto& [name, value] : all) {
      if (name == text) return word = value, Done();
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    return badInput(say("“{0}” is not one of: {1}.", text, names));
  }
};
constexpr Words<Sex, 3> kSexWords{{{{"female", Sex::Female}, {"male", Sex::Male}, {"child", Sex::Child}}}};
constexpr Words<Choice, 3> kChoices{{{{"auto", Choice::Auto}, {"yes", Choice::Yes}, {"no", Choice::No}}}};
constexpr Words<SewEdges::Tie, 4> kTies{{{{"auto", SewEdges::Tie::Auto},
                                          {"1:1", SewEdges::Tie::OneToOne},
                                          {"2:1", SewEdges::Tie::TwoToOne},
                                          {"pleat", SewEdges::Tie::Pleat}}}};
constexpr Words<PleatKind, 3> kPleats{
    {{{"knife", PleatKind::Knife}, {"box", PleatKind::Box}, {"inverted", PleatKind::Inverted}}}};
constexpr Words<FasteningKind, 5> kFastenings{{{{"button", FasteningKind::Button},
                                                {"snap", FasteningKind::Snap},
                                                {"hook", FasteningKind::Hook},
                                                {"tie", FasteningKind::Tie},
                                                {"zip", FasteningKind::Zip}}}};
constexpr Words<Fasten::From, 5> kFrom{{{{"auto", Fasten::From::Auto},
                                         {"top", Fasten::From::Top},
                                         {"bottom", Fasten::From::Bottom},
                                         {"start", Fasten::From::Start},
                                         {"end", Fasten::From::End}}}};
constexpr Words<Fasten::Holes, 2> kButtonholes{{{{"across", Fasten::Holes::Across}, {"along", Fasten::Holes::Along}}}};
constexpr Words<SewPocket::Kind, 2> kPockets{{{{"seam", SewPocket::Kind::Seam}, {"slant", SewPocket::Kind::Slant}}}};
constexpr Words<SewWelt::Kind, 2> kWelts{{{{"jetted", SewWelt::Kind::Jetted}, {"single", SewWelt::Kind::Single}}}};
constexpr Words<AddPleat::Turned, 4> kTurned{{{{"along", AddPleat::Turned::Along},
                                               {"against", AddPleat::Turned::Against},
                                               {"inwards", AddPleat::Turned::Inwards},
                                               {"outwards", AddPleat::Turned::Outwards}}}};
constexpr Words<SetLength::Keep, 4> kKept{{{{"auto", SetLength::Keep::Auto},
                                            {"start", SetLength::Keep::Start},
                                            {"end", SetLength::Keep::End},
                                            {"middle", SetLength::Keep::Middle}}}};
constexpr Words<SetLength::Neighbours, 2> kNeighbours{
    {{{"keep", SetLength::Neighbours::Keep}, {"follow", SetLength::Neighbours::Follow}}}};
constexpr Words<Lengthen::Beside, 3> kBeside{
    {{{"slide", Lengthen::Beside::Along}, {"keep", Lengthen::Beside::Keep}, {"follow", Lengthen::Beside::Follow}}}};
constexpr Words<DraftBlock::Kind, 7> kBlocks{{{{"bodice", DraftBlock::Kind::Bodice},
                                               {"sleeve", DraftBlock::Kind::Sleeve},
                                               {"skirt", DraftBlock::Kind::Skirt},
                                               {"trousers", DraftBlock::Kind::Trousers},
                                               {"shirt", DraftBlock::Kind::Shirt},
                                               {"collar", DraftBlock::Kind::Collar},
                                               {"leggings", DraftBlock::Kind::Leggings}}}};
constexpr Words<DraftBlock::Worn, 4> kWorn{{{{"auto", DraftBlock::Worn::Auto},
                                             {"holds", DraftBlock::Worn::Holds},
                                             {"waist", DraftBlock::Worn::Waist},
                                             {"high_hip", DraftBlock::Worn::HighHip}}}};
constexpr Words<Fabric::Law, 2> kLaws{{{{"woven", Fabric::Law::Woven}, {"simcloth", Fabric::Law::Simcloth}}}};
constexpr Words<Finish, 10> kFinishes{{{{"poplin", Finish::Poplin},
                                        {"linen", Finish::Linen},
                                        {"denim", Finish::Denim},
                                        {"suiting", Finish::Suiting},
                                        {"tweed", Finish::Tweed},
                                        {"jersey", Finish::Jersey},
                                        {"satin", Finish::Satin},
                                        {"chiffon", Finish::Chiffon},
                                        {"velvet", Finish::Velvet},
                                        {"leather", Finish::Leather}}}};
constexpr Words<PrintKind, 5> kPrints{{{{"none", PrintKind::None},
                                        {"stripe", PrintKind::Stripe},
                                        {"check", PrintKind::Check},
                                        {"dot", PrintKind::Dot},
                                        {"photo", PrintKind::Photo}}}};
constexpr Words<EdgeKind, 4> kEdgeKindWords{
    {{{"seam", EdgeKind::Seam}, {"hem", EdgeKind::Hem}, {"neckline", EdgeKind::Neckline}, {"fold", EdgeKind::Fold}}}};
constexpr Words<CornerKind, 6> kCorners{{{{"mitre", CornerKind::Mitre},
                                          {"points", CornerKind::Points},
                                          {"mirror_before", CornerKind::MirrorBefore},
                                          {"mirror_after", CornerKind::MirrorAfter},
                                          {"square_before", CornerKind::SquareBefore},
                                          {"square_after", CornerKind::SquareAfter}}}};
constexpr Words<Settings::Collider, 2> kColliders{
    {{{"field", Settings::Collider::Field}, {"planes", Settings::Collider::Planes}}}};

// "p3", "p3.2" -> the id; nothing if it is not of that form.
template <class AnyId>
std::optional<AnyId> idIn(std::string_view text, char letter) {
  if (text.size() < 2 || text[0] != letter) return std::nullopt;
  std::uint32_t serial = 0, count = 1;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data() + 1, end, serial);
  if (first.ec != std::errc() || serial == 0) return std::nullopt;
  if (first.ptr != end) {
    if (*first.ptr != '.') return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, count);
    if (second.ec != std::errc() || second.ptr != end || count == 0 || count > 0x10000) return std::nullopt;
  }
  return madeBy<AnyId>(serial, count - 1);
}

std::string idText(std::uint64_t value, char letter) {
  if (value == 0) return "-";
  const std::uint64_t nth = value & 0xffff;
  return letter + std::to_string(value >> 16) + (nth > 0 ? "." + std::to_string(nth + 1) : "");
}

template <std::size_t n>
Done readLengths(std::string_view text, std::array<double*, n> into) {
  const auto parts = splitAt(text, ',');
  if (parts.size() != n) {
    if (n == 2) return badInput(say("“{0}” is not a place on paper; write it like 12cm,3cm.", text));
    return badInput(say("“{0}” is not a step in space; write it like 0,5cm,10cm.", text));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto length = parseLength(parts[i]);
    if (!length) return length.error();
    *into[i] = *length;
  }
  return {};
}

}  // namespace

std::vector<std::string> splitList(std::string_view text, bool atSpaces) {
  std::vector<std::string> items;
  std::string item;
  const auto finish = [&] {
    if (const auto whole = trimmed(item); !whole.empty()) items.emplace_back(whole);
    item.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == ';') {
      finish();
    } else if (atSpaces && kSpace.find(c) != std::string_view::npos) {
      const std::size_t next = text.find_first_not_of(kSpace, i);
      const bool joins = (!item.empty() && (item.back() == ',' || item.back() == '=')) ||
                         (next != std::string_view::npos && (text[next] == ',' || text[next] == '='));
      if (!joins) finish();
    } else {
      item += c;
    }
  }
  finish();
  return items;
}

std::string text(PieceId id) { return idText(id.value, 'p'); }
std::string text(SeamId id) { return idText(id.value, 's'); }

std::string writeValue(const std::string& value) { return value; }
Done readValue(std::string_view text, std::string& value) { return value = text, Done(); }

std::string writeValue(const bool& value) { return value ? "yes" : "no"; }
Done readValue(std::string_view text, bool& value) {
  if (text != "yes" && text != "no") return badInput(say("“{0}” is not one of: {1}.", text, "yes, no"));
  return value = text == "yes", Done();
}

std::string writeValue(const int& value) { return std::to_string(value); }
Done readValue(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return badInput(say("“{0}” is not a whole number.", text));
  return {};
}

std::string writeValue(const double& value) { return shortest(value); }
Done readValue(std::string_view text, double& value) {
  const auto number = parseNumber(text);
  if (!number) return badInput(say("“{0}” is not a number.", text));
  return value = *number, Done();
}

std::string writeValue(const Length& value) { return lengthText(value); }
Done readValue(std::string_view text, Length& value) {
  const auto length = parseLength(text);
  if (!length) return length.error();
  return value.metres = *length, Done();
}

std::string writeValue(const Angle& value) { return shortest(value.radians); }
Done readValue(std::string_view text, Angle& value) {
  const auto angle = parseAngle(text);
  if (!angle) return angle.error();
  return value.radians = *angle, Done();
}

std::string writeValue(const Flat& value) { return lengthText(value.u) + "," + lengthText(value.v); }
Done readValue(std::string_view text, Flat& value) { return readLengths<2>(text, {&value.u, &value.v}); }

std::string writeValue(const Vec3& value) {
  return lengthText(value.x) + "," + lengthText(value.y) + "," + lengthText(value.z);
}
Done readValue(std::string_view text, Vec3& value) { return readLengths<3>(text, {&value.x, &value.y, &value.z}); }

std::string writeValue(const Turn& value) {
  std::string axis = shortest(value.axis.x) + "," + shortest(value.axis.y) + "," + shortest(value.axis.z);
  if (axis == "1,0,0") axis = "x";
  if (axis == "0,1,0") axis = "y";
  if (axis == "0,0,1") axis = "z";
  return axis + " " + writeValue(value.angle);
}
Done readValue(std::string_view text, Turn& value) {
  const auto words = splitList(text);
  const auto wrong = [&] {
    return badInput(say("“{0}” is not a turn; write an axis and an angle, like “y 90deg”.", text));
  };
  if (words.size() != 2) return wrong();
  if (words[0] == "x") {
    value.axis = {1, 0, 0};
  } else if (words[0] == "y") {
    value.axis = {0, 1, 0};
  } else if (words[0] == "z") {
    value.axis = {0, 0, 1};
  } else {
    const auto parts = splitAt(words[0], ',');
    if (parts.size() != 3) return wrong();
    const std::array<double*, 3> into{&value.axis.x, &value.axis.y, &value.axis.z};
    for (std::size_t i = 0; i < 3; ++i)
      if (Done done = readValue(parts[i], *into[i]); !done) return done;
  }
  if (!(length(value.axis) > 1e-9)) return wrong();
  return readValue(words[1], value.angle);
}

std::string writeValue(const Rigid& value) {
  std::string all = writeValue(value.carry);
  if (Rigid{value.w, value.x, value.y, value.z, {}} != Rigid{}) {
    all += " " + shortest(value.w) + "," + shortest(value.x) + "," + shortest(value.y) + "," + shortest(value.z);
  }
  return all;
}
Done readValue(std::string_view text, Rigid& value) {
  value = Rigid{};
  const auto words = splitList(text);
  const auto wrong = [&] {
    return badInput(
        say("“{0}” is not a placement; write where it stands and how it is turned, like “0,1.2m,0.2m y 90deg”.", text));
  };
  if (words.empty() || words.size() > 3) return wrong();
  Rigid turn;
  if (words.size() == 3) {
    Turn about;
    if (Done done = readValue(words[1] + " " + words[2], about); !done) return done;
    turn = turnAbout(about.axis, about.angle);
  } else if (words.size() == 2) {
    const auto parts = splitAt(words[1], ',');
    if (parts.size() != 4) return wrong();
    const std::array<double*, 4> into{&turn.w, &turn.x, &turn.y, &turn.z};
    for (std::size_t i = 0; i < 4; ++i)
      if (Done done = readValue(parts[i], *into[i]); !done) return done;
    const double size = turn.w * turn.w + turn.x * turn.x + turn.y * turn.y + turn.z * turn.z;
    if (!(std::abs(size - 1) < 1e-6)) return badInput(say("The turn “{0}” is not a unit quaternion.", words[1]));
  }
  Vec3 carry;
  if (Done done = readValue(words[0], carry); !done) return done;
  value = turn;
  value.carry = carry;
  return {};
}

std::string writeValue(const Stated& value) {
  return value.key + "=" + (value.formula.empty() ? writeValue(value.value) : value.formula);
}
Done readValue(std::string_view text, Stated& value) {
  value.formula.clear();
  const auto parts = splitAt(text, '=');
  if (parts.size() != 2 || parts[0].empty()) {
    return badInput(say("“{0}” is not a measurement; write it like bust_girth=88cm.", text));
  }
  value.key = parts[0];
  // Two measurements are angles: how the shoulders slope and how the arms are held.
  if (const auto length = parseLength(parts[1])) return value.value.metres = *length, Done();
  if (const auto angle = parseAngle(parts[1])) return value.value.metres = *angle, Done();
  const auto formula = Formula::parse(parts[1]);
  if (!formula && seemsFormula("length", parts[1])) return formula.error();
  if (!formula) return badInput(say("“{0}” is not a measurement; write it like bust_girth=88cm.", text));
  return value.formula = formula->text(), Done();
}
Done readValue(std::string_view text, std::vector<Stated>& values) {
  // Formulas have blanks within: then items are parted by ";" alone.
  for (const bool atSpaces : {true, false}) {
    values.clear();
    Done done;
    for (const std::string& item : splitList(text, atSpaces))
      if (done = readValue(item, values.emplace_back()); !done) break;
    if (done || !atSpaces) return done;
  }
  return {};
}

std::string writeValue(const PieceRef& value) { return value.id ? text(value.id) : value.name; }
Done readValue(std::string_view text, PieceRef& value) {
  value = PieceRef();
  if (const auto id = idIn<PieceId>(text, 'p')) return value.id = *id, Done();
  return value.name = text, Done();
}

std::string writeValue(const SeamRef& value) { return value.id ? text(value.id) : value.name; }
Done readValue(std::string_view text, SeamRef& value) {
  value = SeamRef();
  if (const auto id = idIn<SeamId>(text, 's')) return value.id = *id, Done();
  return value.name = text, Done();
}

std::string writeValue(const EdgeRef& value) {
  std::string all = writeValue(value.piece) + "." + value.edge;
  if (value.from != 0 || value.to != 1) all += "@" + shortest(value.from) + ":" + shortest(value.to);
  return all;
}
Done readValue(std::string_view text, EdgeRef& value) {
  value = EdgeRef();
  const auto wrong = [&] {
    return badInput(say("“{0}” is not an edge; write piece.edge, or piece.edge@0.25:0.5 for a part of it.", text));
  };
  std::string_view whole = text;
  if (const std::size_t at = text.find('@'); at != std::string_view::npos) {
    whole = text.substr(0, at);
    const auto ends = splitAt(text.substr(at + 1), ':');
    if (ends.size() != 2) return wrong();
    if (!readValue(ends[0], value.from) || !readValue(ends[1], value.to)) return wrong();
  }
  const std::size_t dot = whole.rfind('.');
  if (dot == std::string_view::npos || dot == 0 || dot + 1 == whole.size()) return wrong();
  value.edge = whole.substr(dot + 1);
  return readValue(whole.substr(0, dot), value.piece);
}

std::string writeValue(const BodyPoint& value) { return text(value); }
Done readValue(std::string_view text, BodyPoint& value) {
  auto point = parseBodyPoint(text);
  if (!point) return point.error();
  return value = *std::move(point), Done();
}

std::string writeValue(const Sex& value) { return kSexWords.write(value); }
Done readValue(std::string_view text, Sex& value) { return kSexWords.read(text, value); }
std::string writeValue(const Choice& value) { return kChoices.write(value); }
Done readValue(std::string_view text, Choice& value) { return kChoices.read(text, value); }
std::string writeValue(const SewEdges::Tie& value) { return kTies.write(value); }
Done readValue(std::string_view text, SewEdges::Tie& value) { return kTies.read(text, value); }
std::string writeValue(const PleatKind& value) { return kPleats.write(value); }
Done readValue(std::string_view text, PleatKind& value) { return kPleats.read(text, value); }
std::string writeValue(const AddPleat::Turned& value) { return kTurned.write(value); }
Done readValue(std::string_view text, AddPleat::Turned& value) { return kTurned.read(text, value); }
std::string writeValue(const SetLength::Keep& value) { return kKept.write(value); }
Done readValue(std::string_view text, SetLength::Keep& value) { return kKept.read(text, value); }
std::string writeValue(const SetLength::Neighbours& value) { return kNeighbours.write(value); }
Done readValue(std::string_view text, SetLength::Neighbours& value) { return kNeighbours.read(text, value); }
std::string writeValue(const Lengthen::Beside& value) { return kBeside.write(value); }
Done readValue(std::string_view text, Lengthen::Beside& value) { return kBeside.read(text, value); }
std::string writeValue(const DraftBlock::Worn& value) { return kWorn.write(value); }
Done readValue(std::string_view text, DraftBlock::Worn& value) { return kWorn.read(text, value); }
std::string writeValue(const DraftBlock::Kind& value) { return kBlocks.write(value); }
Done readValue(std::string_view text, DraftBlock::Kind& value) { return kBlocks.read(text, value); }
std::string writeValue(const Fabric::Law& value) { return kLaws.write(value); }
Done readValue(std::string_view text, Fabric::Law& value) { return kLaws.read(text, value); }
std::string writeValue(const Settings::Collider& value) { return kColliders.write(value); }
Done readValue(std::string_view text, Settings::Collider& value) { return kColliders.read(text, value); }
std::string writeValue(const Finish& value) { return kFinishes.write(value); }
Done readValue(std::string_view text, Finish& value) { return kFinishes.read(text, value); }
std::string writeValue(const PrintKind& value) { return kPrints.write(value); }
Done readValue(std::string_view text, PrintKind& value) { return kPrints.read(text, value); }

std::string writeValue(const EdgeKind& value) { return kEdgeKindWords.write(value); }
Done readValue(std::string_view text, EdgeKind& value) { return kEdgeKindWords.read(text, value); }
std::string writeValue(const FasteningKind& value) { return kFastenings.write(value); }
Done readValue(std::string_view text, FasteningKind& value) { return kFastenings.read(text, value); }
std::string writeValue(const Fasten::From& value) { return kFrom.write(value); }
Done readValue(std::string_view text, Fasten::From& value) { return kFrom.read(text, value); }
std::string writeValue(const SewPocket::Kind& value) { return kPockets.write(value); }
Done readValue(std::string_view text, SewPocket::Kind& value) { return kPockets.read(text, value); }
std::string writeValue(const SewWelt::Kind& value) { return kWelts.write(value); }
Done readValue(std::string_view text, SewWelt::Kind& value) { return kWelts.read(text, value); }
std::string writeValue(const Fasten::Holes& value) { return kButtonholes.write(value); }
Done readValue(std::string_view text, Fasten::Holes& value) { return kButtonholes.read(text, value); }
std::string writeValue(const CornerKind& value) { return kCorners.write(value); }
Done readValue(std::string_view text, CornerKind& value) { return kCorners.read(text, value); }

// Without a "#", which begins a comment in scripts; read with or without.
std::string writeValue(const Dye& value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string all;
  for (const std::uint8_t part : {value.red, value.green, value.blue}) all += {kDigits[part >> 4], kDigits[part & 15]};
  return all;
}
Done readValue(std::string_view text, Dye& value) {
  std::string_view digits = text.starts_with('#') ? text.substr(1) : text;
  unsigned number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  if (digits.size() != 6 || read.ec != std::errc() || read.ptr != digits.data() + digits.size())
    return badInput(say("“{0}” is not a colour; write red, green and blue in hexadecimal, like 1f3b6e.", text));
  value = {static_cast<std::uint8_t>(number >> 16), static_cast<std::uint8_t>(number >> 8 & 255),
           static_cast<std::uint8_t>(number & 255)};
  return {};
}

}  // namespace karinui
