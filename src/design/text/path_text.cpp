// Outlines, internal lines and marks as text: like an SVG path in millimetres, v upwards, one named command an edge.
#include <array>
#include <initializer_list>

#include "design/text/value_text.h"
#include "karinui/base/number.h"
#include "karinui/design/script.h"

namespace karinui {

namespace {

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string all;
  for (const std::string_view part : parts) all.append(part);
  return all;
}

std::string placeText(Flat place) { return joined({millimetreText(place.u), " ", millimetreText(place.v)}); }

std::string curveText(const Curve& curve) {
  const std::string end = placeText(curve.end);
  switch (curve.kind) {
    case Curve::Kind::Line:
      return joined({"L ", end});
    case Curve::Kind::Cubic: {
      std::string all = joined({"C ", placeText(curve.control1), " "});
      for (const Flat place : curve.between) all += joined({placeText(place), " "});
      return all + joined({placeText(curve.control2), " ", end});
    }
    case Curve::Kind::Arc:
      return joined({"A ", shortest(curve.bulge), " ", end});
  }
  return {};
}

std::vector<std::string> wordsOf(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text) {
    if (c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r') {
      if (!word.empty()) words.push_back(std::exchange(word, {}));
    } else {
      word += c;
    }
  }
  if (!word.empty()) words.push_back(std::move(word));
  return words;
}

std::vector<std::string_view> splitAtBars(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find('|');
    if (const auto part = text.substr(0, end); part.find_first_not_of(" \t\r\n") != std::string_view::npos)
      parts.push_back(part);
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// Reads words one after another; remembers that something was wrong.
class WordReader {
 public:
  explicit WordReader(std::vector<std::string> words) : words_(std::move(words)) {}
  bool done() const { return at_ == words_.size(); }
  bool good() const { return good_; }
  std::string next() { return done() ? (good_ = false, std::string()) : words_[at_++]; }
  double number() {
    const auto value = parseNumber(next());
    if (!value) good_ = false;
    return value.value_or(0);
  }
  Flat place() {
    const auto u = parseMillimetres(next()), v = parseMillimetres(next());
    if (!u || !v) good_ = false;
    return {u.value_or(0), v.value_or(0)};
  }
  // A curve from `pen` by the command that comes next; moves the pen.
  std::optional<Curve> curve(Flat& pen, const std::string& command) {
    Curve made;
    if (command == "L") {
      made = Curve::line(pen, place());
    } else if (command == "C") {
      const Flat c1 = place(), c2 = place();
      made = Curve::cubic(pen, c1, c2, place());
      while (good_ && !done() && parseMillimetres(words_[at_])) {  // a chain goes on
        made.between.insert(made.between.end(), {made.control2, made.end, place()});
        made.control2 = place();
        made.end = place();
      }
    } else if (command == "A") {
      const double bulge = number();
      made = Curve::arc(pen, place(), bulge);
    } else {
      good_ = false;
    }
    if (!good_) return std::nullopt;
    pen = made.end;
    return made;
  }

 private:
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  bool good_ = true;
};

}  // namespace

std::string writeValue(const Outline& outline) {
  if (outline.edges.empty()) return {};
  std::string all = joined({"M ", placeText(outline.edges.front().curve.start)});
  for (const Edge& edge : outline.edges) all += joined({"; ", edge.name, " ", curveText(edge.curve)});
  return all;
}

Done readValue(std::string_view text, Outline& outline) {
  outline = Outline();
  Flat pen;
  bool first = true;
  for (const std::string& item : splitList(text, false)) {
    WordReader words(wordsOf(item));
    const std::string name = words.next();
    if (first) {
      if (name != "M") return badInput(say("An outline begins with “M u v” in millimetres, not with “{0}”.", item));
      pen = words.place();
    } else if (auto curve = words.curve(pen, words.next())) {
      outline.edges.push_back({name, *curve});
    }
    if (!words.good() || !words.done()) {
      return badInput(
          say("“{0}” is not an edge of an outline; write “name L u v”, “name C u v u v u v …” or “name A bulge u v” "
              "in millimetres.",
              item));
    }
    first = false;
  }
  return {};
}

std::string writeValue(const std::vector<Outline>& outlines) {
  std::string all;
  for (const Outline& outline : outlines) all += joined({all.empty() ? "" : " | ", writeValue(outline)});
  return all;
}
Done readValue(std::string_view text, std::vector<Outline>& outlines) {
  outlines.clear();
  for (const std::string_view part : splitAtBars(text))
    if (Done done = readValue(part, outlines.emplace_back()); !done) return done;
  return {};
}

std::string writeValue(const std::vector<InternalLine>& lines) {
  std::string all;
  for (const InternalLine& line : lines) {
    all += joined({all.empty() ? "" : " | ", line.name});
    if (line.crease) all += joined({" fold ", shortest(line.crease->angle), " ", shortest(line.crease->hold)});
    std::optional<Flat> pen;
    for (const Curve& curve : line.curves) {
      if (pen != curve.start) all += joined({" M ", placeText(curve.start)});
      all += joined({" ", curveText(curve)});
      pen = curve.end;
    }
  }
  return all;
}
Done readValue(std::string_view text, std::vector<InternalLine>& lines) {
  lines.clear();
  for (const std::string_view part : splitAtBars(text)) {
    WordReader words(wordsOf(part));
    InternalLine& line = lines.emplace_back();
    line.name = words.next();
    std::optional<Flat> pen;
    while (words.good() && !words.done()) {
      const std::string command = words.next();
      if (command == "M") {
        pen = words.place();
      } else if (command == "fold") {  // radians, and how well it is pressed
        line.crease = Crease{words.number(), words.number()};
        if (!line.crease->sound())
          return badInput(
              say("The internal line “{0}” cannot be folded so: “fold angle hold” has radians up to 2.96 and "
                  "a share of 0.1 to 0.99.",
                  line.name));
      } else if (!pen) {
        return badInput(say("The internal line “{0}” begins with “M u v” after its name.", line.name));
      } else if (const auto curve = words.curve(*pen, command)) {
        line.curves.push_back(*curve);
      }
    }
    if (!words.good())
      return badInput(say("“{0}” is not an internal line; write “name M u v L u v” in millimetres.", part));
  }
  return {};
}

std::string writeValue(const std::vector<Mark>& marks) {
  std::string all;
  for (const Mark& mark : marks) {
    all += joined({all.empty() ? "" : "; ", mark.name.empty() ? std::string_view("-") : mark.name, " "});
    all += mark.edge.empty() ? writeValue(mark.place) : joined({mark.edge, " ", shortest(mark.fraction)});
  }
  return all;
}
Done readValue(std::string_view text, std::vector<Mark>& marks) {
  marks.clear();
  for (const std::string& item : splitList(text, false)) {
    Mark& mark = marks.emplace_back();
    const auto words = splitList(item);
    const auto wrong = [&] {
      return badInput(
          say("“{0}” is not a mark; write “name edge 0.5” for a notch or “name u,v” for a drill hole.", item));
    };
    if (words.size() != 2 && words.size() != 3) return wrong();
    if (words[0] != "-") mark.name = words[0];
    if (words.size() == 2) {
      if (!readValue(words[1], mark.place)) return wrong();
    } else {
      mark.edge = words[1];
      if (!readValue(words[2], mark.fraction)) return wrong();
    }
  }
  return {};
}

std::string writeValue(const GradePoints& points) {
  std::string all;
  for (const GradePoint& point : points) {
    all += joined({all.empty() ? "" : "; ", point.edge, " ", shortest(point.at)});
    for (const Flat by : point.by) all += joined({" ", placeText(by)});
  }
  return all;
}
Done readValue(std::string_view text, GradePoints& points) {
  points.clear();
  for (const std::string& item : splitList(text, false)) {
    WordReader words(wordsOf(item));
    GradePoint& point = points.emplace_back();
    point.edge = words.next();
    point.at = words.number();
    while (words.good() && !words.done()) point.by.push_back(words.place());
    if (!words.good() || point.by.empty())
      return badInput(say(
          "“{0}” is not a graded place; write “edge 0 u v u v …”: two numbers in millimetres for each size.", item));
  }
  return {};
}

std::string text(const Outline& outline) { return writeValue(outline); }
Result<Outline> parseOutline(std::string_view text) {
  Outline outline;
  if (Done done = readValue(text, outline); !done) return done.error();
  return outline;
}

}  // namespace karinui
