#include "karinui/design/glossary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/body/lines.h"

namespace karinui {

namespace {

struct Entry {
  Term kind;
  std::string_view identifier;
  Message name;
};
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      // --- Measure
      {Term::Measure, "ankle_girth", say("Ankle girth")},
      {Term::Measure, "ankle_height", say("Ankle height")},
      {Term::Measure, "arm_angle", say("Arm angle")},
      {Term::Measure, "arm_joint_length", say("Arm length from joint to joint")},
      {Term::Measure, "arm_length", say("Arm length")},
      {Term::Measure, "armpit_height", say("Armpit height")},
      {Term::Measure, "back_waist_length", say("Back waist length")},
      {Term::Measure, "bust_girth", say("Bust girth")},
      {Term::Measure, "bust_height", say("Bust height")},
      {Term::Measure, "bust_span", say("Bust point distance")},
      {Term::Measure, "calf_girth", say("Calf girth")},
      {Term::Measure, "calf_height", say("Calf height")},
      {Term::Measure, "crotch_height", say("Inside leg")},
      {Term::Measure, "elbow_girth", say("Elbow girth")},
      {Term::Measure, "forearm_length", say("Forearm length")},
      {Term::Measure, "front_waist_length", say("Front waist length")},
      {Term::Measure, "height", say("Body height")},
      {Term::Measure, "high_hip_girth", say("High hip girth")},
      {Term::Measure, "high_hip_height", say("High hip height")},
      {Term::Measure, "hip_girth", say("Hip girth")},
      {Term::Measure, "hip_height", say("Hip height")},
      {Term::Measure, "knee_girth", say("Knee girth")},
      {Term::Measure, "knee_height", say("Knee height")},
      {Term::Measure, "neck_back_height", say("Back neck point height")},
      {Term::Measure, "neck_base_girth", say("Neck base girth")},
      {Term::Measure, "neck_front_height", say("Front neck point height")},
      {Term::Measure, "neck_girth", say("Neck girth")},
      {Term::Measure, "neck_height", say("Neck height")},
      {Term::Measure, "shoulder_height", say("Shoulder point height")},
      {Term::Measure, "shoulder_joint_width", say("Shoulder joint distance")},
      {Term::Measure, "shoulder_length", say("Shoulder length")},
      {Term::Measure, "shoulder_slope", say("Shoulder slope")},
      {Term::Measure, "shoulder_width", say("Shoulder width")},
      {Term::Measure, "thigh_girth", say("Thigh girth")},
      {Term::Measure, "under_bust_girth", say("Under-bust girth")},
      {Term::Measure, "under_bust_height", say("Under-bust height")},
      {Term::Measure, "upper_arm_girth", say("Upper arm girth")},
      {Term::Measure, "upper_arm_length", say("Upper arm length")},
      {Term::Measure, "waist_girth", say("Waist girth")},
      {Term::Measure, "waist_height", say("Waist height")},
      {Term::Measure, "waist_to_hip_length", say("Waist to hip")},
      {Term::Measure, "wrist_girth", say("Wrist girth")},
      // --- Landmark
      {Term::Landmark, "ankle_left", say("left ankle point")},
      {Term::Landmark, "ankle_right", say("right ankle point")},
      {Term::Landmark, "armpit_left", say("left armpit point")},
      {Term::Landmark, "armpit_right", say("right armpit point")},
      {Term::Landmark, "bust_left", say("left bust point")},
      {Term::Landmark, "bust_right", say("right bust point")},
      {Term::Landmark, "crotch", say("crotch point")},
      {Term::Landmark, "elbow_left", say("left elbow point")},
      {Term::Landmark, "elbow_right", say("right elbow point")},
      {Term::Landmark, "hip_back", say("centre back of the hip")},
      {Term::Landmark, "hip_front", say("centre front of the hip")},
      {Term::Landmark, "hip_left", say("left side of the hip")},
      {Term::Landmark, "hip_right", say("right side of the hip")},
      {Term::Landmark, "knee_left", say("left knee point")},
      {Term::Landmark, "knee_right", say("right knee point")},
      {Term::Landmark, "neck_back", say("back neck point")},
      {Term::Landmark, "neck_front", say("front neck point")},
      {Term::Landmark, "neck_left", say("left side neck point")},
      {Term::Landmark, "neck_right", say("right side neck point")},
      {Term::Landmark, "shoulder_left", say("left shoulder point")},
      {Term::Landmark, "shoulder_right", say("right shoulder point")},
      {Term::Landmark, "under_bust_back", say("centre back of the under-bust")},
      {Term::Landmark, "under_bust_front", say("centre front of the under-bust")},
      {Term::Landmark, "under_bust_left", say("left side of the under-bust")},
      {Term::Landmark, "under_bust_right", say("right side of the under-bust")},
      {Term::Landmark, "waist_back", say("centre back of the waist")},
      {Term::Landmark, "waist_front", say("centre front of the waist")},
      {Term::Landmark, "waist_left", say("left side of the waist")},
      {Term::Landmark, "waist_right", say("right side of the waist")},
      {Term::Landmark, "wrist_left", say("left wrist point")},
      {Term::Landmark, "wrist_right", say("right wrist point")},
      // --- Part
      {Term::Part, "left_arm", say("left arm")},
      {Term::Part, "left_leg", say("left leg")},
      {Term::Part, "right_arm", say("right arm")},
      {Term::Part, "right_leg", say("right leg")},
      {Term::Part, "torso", say("trunk")},
      // --- Level
      {Term::Level, "ankle", say("ankle")},
      {Term::Level, "armpit", say("armpit")},
      {Term::Level, "bust", say("bust")},
      {Term::Level, "chin", say("chin")},
      {Term::Level, "crotch", say("crotch level")},
      {Term::Level, "crown", say("crown of the head")},
      {Term::Level, "elbow", say("elbow")},
      {Term::Level, "fingertip", say("fingertip")},
      {Term::Level, "high_hip", say("high hip")},
      {Term::Level, "hip", say("hip")},
      {Term::Level, "knee", say("knee")},
      {Term::Level, "neck", say("neck")},
      {Term::Level, "neck_base", say("neck base")},
      {Term::Level, "shoulder", say("shoulder")},
      {Term::Level, "sole", say("sole of the foot")},
      {Term::Level, "under_bust", say("under bust")},
      {Term::Level, "waist", say("waist")},
      {Term::Level, "wrist", say("wrist")},
      // --- Fabric
      {Term::Fabric, "chiffon", say("Chiffon")},
      {Term::Fabric, "cotton", say("Cotton")},
      {Term::Fabric, "denim", say("Denim")},
      {Term::Fabric, "interlock", say("Interlock knit")},
      {Term::Fabric, "jersey", say("Jersey")},
      {Term::Fabric, "linen", say("Linen")},
      {Term::Fabric, "silk", say("Silk")},
      {Term::Fabric, "simcloth", say("Historical test cloth")},
      {Term::Fabric, "viscose", say("Viscose")},
      {Term::Fabric, "wool coating", say("Wool coating")},
      {Term::Fabric, "wool suiting", say("Wool suiting")},
      // --- Size
      {Term::Size, "eu38", say("EU 38 (women)")},
      {Term::Size, "eu50", say("EU 50 (men)")},
      {Term::Size, "jis9ar", say("JIS 9AR (women)")},
      // --- Operation
      {Term::OperationName, "body", say("Choose the figure")},
      {Term::OperationName, "cut", say("Cut")},
      {Term::OperationName, "dart", say("Sew a dart")},
      {Term::OperationName, "drape", say("Settle")},
      {Term::OperationName, "draw", say("Draw a piece")},
      {Term::OperationName, "duplicate", say("Duplicate")},
      {Term::OperationName, "erase", say("Erase marks")},
      {Term::OperationName, "fabric", say("Fabric")},
      {Term::OperationName, "flip", say("Turn the seam round")},
      {Term::OperationName, "freeze", say("Freeze")},
      {Term::OperationName, "grain", say("Turn the grain")},
      {Term::OperationName, "join", say("Take a point away")},
      {Term::OperationName, "layer", say("Order of layers")},
      {Term::OperationName, "length", say("Length of an edge")},
      {Term::OperationName, "line", say("Inner line")},
      {Term::OperationName, "mirror", say("Mirror")},
      {Term::OperationName, "move", say("Move")},
      {Term::OperationName, "notch", say("Notch or drill hole")},
      {Term::OperationName, "piece", say("Add a piece")},
      {Term::OperationName, "pin", say("Pin")},
      {Term::OperationName, "place", say("Wrap round the body")},
      {Term::OperationName, "pull", say("Pull")},
      {Term::OperationName, "remove", say("Remove")},
      {Term::OperationName, "rename", say("Rename")},
      {Term::OperationName, "reshape", say("Reshape")},
      {Term::OperationName, "set", say("Settings")},
      {Term::OperationName, "sew", say("Sew")},
      {Term::OperationName, "split", say("Add a point")},
      {Term::OperationName, "unpin", say("Take pins out")},
      {Term::OperationName, "unsew", say("Unpick")},
      // --- Field
      {Term::Field, "a", say("One side")},
      {Term::Field, "about", say("Turn about")},
      {Term::Field, "along", say("Places on paper")},
      {Term::Field, "at", say("Where")},
      {Term::Field, "at.notch", say("Place along the edge")},
      {Term::Field, "b", say("Other side")},
      {Term::Field, "bend_warp", say("Bending, warp")},
      {Term::Field, "bend_weft", say("Bending, weft")},
      {Term::Field, "by", say("How far (left, up, forward)")},
      {Term::Field, "closed", say("Line closes by itself")},
      {Term::Field, "collider", say("Cloth is stopped by")},
      {Term::Field, "compression", say("Resists squeezing")},
      {Term::Field, "ease", say("Ease")},
      {Term::Field, "edge", say("Edge")},
      {Term::Field, "edges", say("Names of the edges")},
      {Term::Field, "fabric", say("Fabric")},
      {Term::Field, "friction_body", say("Friction on skin")},
      {Term::Field, "friction_cloth", say("Friction on cloth")},
      {Term::Field, "frozen", say("Stays as it is")},
      {Term::Field, "grain", say("Grain")},
      {Term::Field, "gravity", say("Gravity")},
      {Term::Field, "holes", say("Holes")},
      {Term::Field, "inside", say("A place inside")},
      {Term::Field, "keep", say("Which end stays")},
      {Term::Field, "law", say("Kind of cloth")},
      {Term::Field, "layer", say("Layer")},
      {Term::Field, "let_go", say("Let go afterwards")},
      {Term::Field, "like", say("Starts from")},
      {Term::Field, "line", say("Line on the body")},
      {Term::Field, "line.cut", say("Line of the cut")},
      {Term::Field, "lines", say("Inner lines")},
      {Term::Field, "live", say("Pieces that drape")},
      {Term::Field, "marks", say("Notches and drill holes")},
      {Term::Field, "mesh", say("Imported body")},
      {Term::Field, "mirror", say("Also the other side")},
      {Term::Field, "name", say("Name")},
      {Term::Field, "neighbours", say("Edges beside it")},
      {Term::Field, "outline", say("Outline")},
      {Term::Field, "patch", say("Held with the fingers (radius)")},
      {Term::Field, "piece", say("Piece")},
      {Term::Field, "point", say("Place on paper")},
      {Term::Field, "pose", say("Where it stands")},
      {Term::Field, "refit", say("Curve fitted anew")},
      {Term::Field, "replace", say("Unpick seams in the way")},
      {Term::Field, "reversed", say("Sewn the other way round")},
      {Term::Field, "seam", say("Seam")},
      {Term::Field, "seconds", say("Takes (seconds)")},
      {Term::Field, "set", say("Measurements")},
      {Term::Field, "sex", say("Shape")},
      {Term::Field, "shear", say("Shear")},
      {Term::Field, "shear_stiffen", say("Stiffening, shear")},
      {Term::Field, "size", say("Size")},
      {Term::Field, "smooth", say("Curve through the places")},
      {Term::Field, "spacing", say("Fineness of the cloth")},
      {Term::Field, "stiffen_warp", say("Stiffening, warp")},
      {Term::Field, "stiffen_weft", say("Stiffening, weft")},
      {Term::Field, "stop", say("Stopped after (solver steps)")},
      {Term::Field, "stretch_warp", say("Stretch, warp")},
      {Term::Field, "stretch_weft", say("Stretch, weft")},
      {Term::Field, "symmetric", say("On both halves")},
      {Term::Field, "symmetric.draw", say("Half of a symmetric piece")},
      {Term::Field, "thickness", say("Thickness")},
      {Term::Field, "tie", say("Ease or gathers")},
      {Term::Field, "tip", say("Tip of the dart")},
      {Term::Field, "to", say("New name")},
      {Term::Field, "to.grain", say("Direction of the grain")},
      {Term::Field, "to.length", say("New length")},
      {Term::Field, "toe", say("Give before it holds")},
      {Term::Field, "toe_warp", say("Give, warp")},
      {Term::Field, "toe_weft", say("Give, weft")},
      {Term::Field, "turn", say("Turn")},
      {Term::Field, "weight", say("Weight")},
      {Term::Field, "width", say("Width of the dart")},
      {Term::Field, "within", say("How near")},
      {Term::Field, "within.reshape", say("Cloth comes along within")},
      // --- Value
      {Term::Value, "1:1", say("Even (1:1)")},
      {Term::Value, "2:1", say("Gathered (2:1)")},
      {Term::Value, "auto", say("Automatic")},
      {Term::Value, "end", say("The end stays")},
      {Term::Value, "female", say("Female")},
      {Term::Value, "field", say("Distance to the skin")},
      {Term::Value, "follow", say("Stretch with it")},
      {Term::Value, "keep", say("Keep their lengths")},
      {Term::Value, "male", say("Male")},
      {Term::Value, "middle", say("Both ends move by half")},
      {Term::Value, "no", say("No")},
      {Term::Value, "planes", say("Merged planes (historical)")},
      {Term::Value, "simcloth", say("Tension only (historical)")},
      {Term::Value, "start", say("The start stays")},
      {Term::Value, "woven", say("Woven or knitted")},
      {Term::Value, "yes", say("Yes")},
      // --- Word
      {Term::Word, "ankle", say("ankle")},
      {Term::Word, "armhole", say("armhole")},
      {Term::Word, "back", say("back")},
      {Term::Word, "belt", say("belt")},
      {Term::Word, "bodice", say("bodice")},
      {Term::Word, "bottom", say("bottom edge")},
      {Term::Word, "btorso", say("back bodice")},
      {Term::Word, "cap", say("sleeve cap")},
      {Term::Word, "center", say("centre")},
      {Term::Word, "centre", say("centre")},
      {Term::Word, "collar", say("collar")},
      {Term::Word, "crotch", say("crotch")},
      {Term::Word, "crown", say("sleeve crown")},
      {Term::Word, "cuff", say("cuff")},
      {Term::Word, "cut", say("cut edge")},
      {Term::Word, "dart", say("dart")},
      {Term::Word, "edge", say("edge")},
      {Term::Word, "elbow", say("elbow")},
      {Term::Word, "facing", say("facing")},
      {Term::Word, "fold", say("fold")},
      {Term::Word, "front", say("front")},
      {Term::Word, "ftorso", say("front bodice")},
      {Term::Word, "gusset", say("gusset")},
      {Term::Word, "hem", say("hem")},
      {Term::Word, "hip", say("hip")},
      {Term::Word, "hood", say("hood")},
      {Term::Word, "inseam", say("inseam")},
      {Term::Word, "knee", say("knee")},
      {Term::Word, "leg", say("trouser leg")},
      {Term::Word, "line", say("line")},
      {Term::Word, "lining", say("lining")},
      {Term::Word, "neck", say("neckline")},
      {Term::Word, "neckline", say("neckline")},
      {Term::Word, "notch", say("notch")},
      {Term::Word, "opening", say("opening")},
      {Term::Word, "outseam", say("outseam")},
      {Term::Word, "panel", say("panel")},
      {Term::Word, "piece", say("piece")},
      {Term::Word, "placket", say("placket")},
      {Term::Word, "pocket", say("pocket")},
      {Term::Word, "rise", say("rise")},
      {Term::Word, "seam", say("seam")},
      {Term::Word, "shoulder", say("shoulder")},
      {Term::Word, "side", say("side")},
      {Term::Word, "skirt", say("skirt")},
      {Term::Word, "sleeve", say("sleeve")},
      {Term::Word, "strap", say("strap")},
      {Term::Word, "top", say("top edge")},
      {Term::Word, "torso", say("bodice")},
      {Term::Word, "under", say("underarm")},
      {Term::Word, "underarm", say("underarm")},
      {Term::Word, "waist", say("waist")},
      {Term::Word, "waistband", say("waistband")},
      {Term::Word, "wrist", say("sleeve opening")},
      {Term::Word, "yoke", say("yoke")},
  };
  return all;
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
  for (const Entry& entry : entries())
    if (entry.kind == kind && entry.identifier == identifier) return entry.name;
  return std::nullopt;
}

Message fieldSaid(std::string_view operation, std::string_view field) {
  if (const auto own = termSaid(Term::Field, std::string(field) + "." + std::string(operation))) return *own;
  return termSaid(Term::Field, field).value_or(say("{0}", field));
}

Message placeSaid(const BodyPoint& place) {
  if (place.part == BodyPoint::Part::Landmark)
    return termSaid(Term::Landmark, place.landmark).value_or(say("{0}", place.landmark));
  if (place.part == BodyPoint::Part::Line) return bodyLineSaid(place.landmark);
  const auto levels = chartLevels(place.part);
  if (levels.empty()) return say("a place on the skin");
  constexpr double kOn = 0.2;  // of the way from a level to the next: still at the level
  const double top = static_cast<double>(levels.size() - 1), along = std::clamp(place.along, 0.0, top);
  const auto level = [&](double which) { return *termSaid(Term::Level, levels[static_cast<std::size_t>(which)]); };
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
  return say("{0}, {1}", *termSaid(Term::Part, kParts[static_cast<std::size_t>(place.part)]), said);
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
    for (const Entry& entry : entries()) {
      if (entry.kind != kind) continue;
      if (isSaid(entry.name)) return std::string(entry.identifier);
      if (kind != Term::Word) continue;
      for (const char* side : {"_left", "_right", "_front", "_back"})
        if (const std::string name = std::string(entry.identifier) + side; isSaid(nameSaid(name))) return name;
    }
  return std::nullopt;
}

Message listSaid(const std::vector<Message>& all) {
  Message said;
  for (const Message& one : all) said = said.empty() ? one : say("{0}, {1}", said, one);
  return said;
}

}  // namespace karinui
