#include "svg_path.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kLargest = 1e7;  // user units: beyond that a number is damage
constexpr double kTiny = 1e-7;    // metres: a line this short is none

bool isSeparator(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == ','; }

// Reads path data and lists: numbers may follow each other without anything between.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}
  bool done() {
    skip();
    return at_ >= text_.size();
  }
  std::optional<char> command() {
    skip();
    if (at_ >= text_.size()) return std::nullopt;
    const char c = text_[at_];
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))) return std::nullopt;
    ++at_;
    return c;
  }
  bool numberNext() {
    skip();
    return at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+' || text_[at_] == '.' || isDigit(text_[at_]));
  }
  std::optional<double> number() {
    skip();
    std::size_t from = at_, to = at_;
    if (to < text_.size() && (text_[to] == '-' || text_[to] == '+')) ++to;
    bool dot = false, digits = false;
    for (; to < text_.size() && (isDigit(text_[to]) || (text_[to] == '.' && !dot)); ++to)
      (text_[to] == '.' ? dot : digits) = true;
    if (!digits) return std::nullopt;
    if (to + 1 < text_.size() && (text_[to] == 'e' || text_[to] == 'E')) {
      std::size_t end = to + 1;
      if (text_[end] == '-' || text_[end] == '+') ++end;
      if (end < text_.size() && isDigit(text_[end])) {
        while (end < text_.size() && isDigit(text_[end])) ++end;
        to = end;
      }
    }
    if (text_[from] == '+') ++from;
    double value = 0;
    const auto [stop, problem] = std::from_chars(text_.data() + from, text_.data() + to, value);
    if (problem != std::errc{} || stop != text_.data() + to || !std::isfinite(value) || std::abs(value) > kLargest)
      return std::nullopt;
    at_ = to;
    return value;
  }
  std::optional<bool> flag() {  // "a 5 5 0 01 3 4": a flag is one digit
    skip();
    if (at_ >= text_.size() || (text_[at_] != '0' && text_[at_] != '1')) return std::nullopt;
    return text_[at_++] == '1';
  }

 private:
  static bool isDigit(char c) { return c >= '0' && c <= '9'; }
  void skip() {
    while (at_ < text_.size() && isSeparator(text_[at_])) ++at_;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

struct Arc {
  double rx = 0, ry = 0, turn = 0;
  bool large = false, sweep = false;
};

// Whether circles stay circles.
bool keepsCircles(const SvgMatrix& m) {
  const double size = std::abs(m.a) + std::abs(m.b) + std::abs(m.c) + std::abs(m.d);
  const bool turned = std::abs(m.a - m.d) + std::abs(m.b + m.c) < 1e-9 * size;
  const bool mirrored = std::abs(m.a + m.d) + std::abs(m.b - m.c) < 1e-9 * size;
  return turned || mirrored;
}
double determinant(const SvgMatrix& m) { return m.a * m.d - m.b * m.c; }

// An arc as SVG gives it, by its two ends (SVG 1.1, F.6.5 and F.6.6); ellipses become cubics.
void addArc(std::vector<Curve>& out, const SvgMatrix& to, Flat from, Flat end, Arc arc) {
  arc.rx = std::abs(arc.rx), arc.ry = std::abs(arc.ry);
  if (arc.rx < 1e-9 || arc.ry < 1e-9) {
    out.push_back(Curve::line(to(from), to(end)));
    return;
  }
  if (std::abs(arc.rx - arc.ry) < 1e-9 * arc.rx && keepsCircles(to)) {
    const double half = std::asin(std::min(1.0, distance(from, end) / (2 * arc.rx)));
    const double quarter = arc.large ? std::numbers::pi / 2 - half / 2 : half / 2;
    // A positive sweep turns from x to y; seen with the carried axes that is to the left where they are not mirrored.
    const bool left = arc.sweep == (determinant(to) > 0);
    out.push_back(Curve::arc(to(from), to(end), std::tan(quarter) * (left ? 1 : -1)));
    return;
  }
  const double turn = arc.turn * std::numbers::pi / 180, c = std::cos(turn), s = std::sin(turn);
  const Flat half = (from - end) * 0.5, own{c * half.u + s * half.v, -s * half.u + c * half.v};
  const double over = own.u * own.u / (arc.rx * arc.rx) + own.v * own.v / (arc.ry * arc.ry);
  if (over > 1) arc.rx *= std::sqrt(over), arc.ry *= std::sqrt(over);
  const double rx2 = arc.rx * arc.rx, ry2 = arc.ry * arc.ry;
  const double below = rx2 * own.v * own.v + ry2 * own.u * own.u;
  double root = below > 0 ? std::sqrt(std::max(0.0, (rx2 * ry2 - below) / below)) : 0;
  if (arc.large == arc.sweep) root = -root;
  const Flat centre{root * arc.rx * own.v / arc.ry, -root * arc.ry * own.u / arc.rx};
  const auto angle = [&](Flat p) { return std::atan2((p.v - centre.v) / arc.ry, (p.u - centre.u) / arc.rx); };
  const double first = angle(own);
  double swept = angle(-own) - first;
  if (arc.sweep && swept < 0) swept += 2 * std::numbers::pi;
  if (!arc.sweep && swept > 0) swept -= 2 * std::numbers::pi;
  const Flat middle = (from + end) * 0.5 + Flat{c * centre.u - s * centre.v, s * centre.u + c * centre.v};
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(swept) / (std::numbers::pi / 4) - 1e-9)));
  const auto place = [&](double t) {
    const Flat p{arc.rx * std::cos(t), arc.ry * std::sin(t)};
    return middle + Flat{c * p.u - s * p.v, s * p.u + c * p.v};
  };
  const auto way = [&](double t) {
    const Flat p{-arc.rx * std::sin(t), arc.ry * std::cos(t)};
    return Flat{c * p.u - s * p.v, s * p.u + c * p.v};
  };
  Flat at = from;
  for (int k = 0; k < parts; ++k) {
    const double a = first + swept * k / parts, b = first + swept * (k + 1) / parts;
    const double reach = 4.0 / 3 * std::tan((b - a) / 4);
    const Flat next = k + 1 == parts ? end : place(b);
    out.push_back(Curve::cubic(to(at), to(at + way(a) * reach), to(next - way(b) * reach), to(next)));
    at = next;
  }
}

class PathReader {
 public:
  PathReader(std::string_view d, const SvgMatrix& to, std::size_t& budget) : scan_(d), to_(to), budget_(budget) {}

  std::optional<std::vector<SvgLine>> read() {
    char command = 0;
    while (!scan_.done()) {
      if (const auto next = scan_.command())
        command = *next;
      else if (command == 'M' || command == 'm')
        command = command == 'M' ? 'L' : 'l';
      else if (command == 0 || command == 'Z' || command == 'z' || !scan_.numberNext())
        return std::nullopt;
      if (lines_.empty() && command != 'M' && command != 'm') return std::nullopt;
      if (!step(command)) return std::nullopt;
    }
    std::erase_if(lines_, [](const SvgLine& line) { return line.curves.empty(); });
    return std::move(lines_);
  }

 private:
  bool step(char command) {
    const bool relative = command >= 'a';
    const Flat origin = relative ? at_ : Flat{};
    bool good = true;
    const auto number = [&] {
      const auto value = scan_.number();
      good &= value.has_value();
      return value.value_or(0);
    };
    const auto place = [&] {
      const double x = number(), y = number();
      return origin + Flat{x, y};
    };
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    Flat control = at_;
    switch (kind) {
      case 'M':
        at_ = begin_ = place();
        lines_.push_back({});
        break;
      case 'Z':
        if (karinui::distance(to_(at_), to_(begin_)) > kTiny) line(begin_);
        lines_.back().closed = true;
        at_ = begin_;
        break;
      case 'L':
        line(place());
        break;
      case 'H':
        line({number() + origin.u, at_.v});
        break;
      case 'V':
        line({at_.u, number() + origin.v});
        break;
      case 'C':
      case 'S': {
        const Flat first = kind == 'C' ? place() : last_ == 'C' || last_ == 'S' ? at_ * 2 - control_ : at_;
        const Flat second = place(), end = place();
        cubic(first, second, end);
        control = second;
        break;
      }
      case 'Q':
      case 'T': {
        const Flat middle = kind == 'Q' ? place() : last_ == 'Q' || last_ == 'T' ? at_ * 2 - control_ : at_;
        const Flat end = place();
        cubic(at_ + (middle - at_) * (2.0 / 3), end + (middle - end) * (2.0 / 3), end);
        control = middle;
        break;
      }
      case 'A': {
        Arc arc;
        arc.rx = number(), arc.ry = number(), arc.turn = number();
        const auto large = scan_.flag(), sweep = scan_.flag();
        if (!large || !sweep) return false;
        arc.large = *large, arc.sweep = *sweep;
        const Flat end = place();
        if (!good) return false;
        if (karinui::distance(to_(at_), to_(end)) > kTiny && open()) addArc(lines_.back().curves, to_, at_, end, arc);
        at_ = end;
        break;
      }
      default:
        return false;
    }
    control_ = control;
    last_ = kind;
    if (budget_ == 0) return false;
    --budget_;
    return good;
  }
  // What is drawn after a closed line without a move begins where that began.
  bool open() {
    if (lines_.back().closed) lines_.push_back({});
    return true;
  }
  void line(Flat end) {
    if (karinui::distance(to_(at_), to_(end)) > kTiny && open())
      lines_.back().curves.push_back(Curve::line(to_(at_), to_(end)));
    at_ = end;
  }
  void cubic(Flat first, Flat second, Flat end) {
    const bool some = karinui::distance(to_(at_), to_(end)) > kTiny || karinui::distance(to_(at_), to_(first)) > kTiny;
    if (some && open()) lines_.back().curves.push_back(Curve::cubic(to_(at_), to_(first), to_(second), to_(end)));
    at_ = end;
  }

  Scanner scan_;
  SvgMatrix to_;
  std::size_t& budget_;
  std::vector<SvgLine> lines_;
  Flat at_, begin_, control_;
  char last_ = 0;
};

}  // namespace

SvgMatrix operator*(const SvgMatrix& o, const SvgMatrix& i) {
  return {o.a * i.a + o.c * i.b, o.b * i.a + o.d * i.b,       o.a * i.c + o.c * i.d,
          o.b * i.c + o.d * i.d, o.a * i.e + o.c * i.f + o.e, o.b * i.e + o.d * i.f + o.f};
}

std::optional<std::vector<double>> svgNumbers(std::string_view text) {
  std::vector<double> out;
  Scanner scan(text);
  while (!scan.done()) {
    const auto value = scan.number();
    if (!value || out.size() >= 200'000) return std::nullopt;
    out.push_back(*value);
  }
  return out;
}

std::optional<SvgMatrix> svgTransform(std::string_view text) {
  SvgMatrix all;
  for (int count = 0; count < 100; ++count) {
    while (!text.empty() && isSeparator(text.front())) text.remove_prefix(1);
    if (text.empty()) return all;
    const std::size_t open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
    std::string_view name = text.substr(0, open);
    while (!name.empty() && isSeparator(name.back())) name.remove_suffix(1);
    const auto n = svgNumbers(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
    if (!n) return std::nullopt;
    SvgMatrix one;
    if (name == "matrix" && n->size() == 6) {
      one = {(*n)[0], (*n)[1], (*n)[2], (*n)[3], (*n)[4], (*n)[5]};
    } else if (name == "translate" && (n->size() == 1 || n->size() == 2)) {
      one.e = (*n)[0], one.f = n->size() == 2 ? (*n)[1] : 0;
    } else if (name == "scale" && (n->size() == 1 || n->size() == 2)) {
      one.a = (*n)[0], one.d = n->size() == 2 ? (*n)[1] : (*n)[0];
    } else if (name == "rotate" && (n->size() == 1 || n->size() == 3)) {
      const double c = std::cos((*n)[0] * kDegree), s = std::sin((*n)[0] * kDegree);
      one = {c, s, -s, c, 0, 0};
      if (n->size() == 3)
        one = SvgMatrix{1, 0, 0, 1, (*n)[1], (*n)[2]} * one * SvgMatrix{1, 0, 0, 1, -(*n)[1], -(*n)[2]};
    } else if (name == "skewX" && n->size() == 1) {
      one.c = std::tan((*n)[0] * kDegree);
    } else if (name == "skewY" && n->size() == 1) {
      one.b = std::tan((*n)[0] * kDegree);
    } else {
      return std::nullopt;
    }
    all = all * one;
  }
  return std::nullopt;
}

std::optional<double> svgMillimetres(std::string_view text, double pixel) {
  while (!text.empty() && isSeparator(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSeparator(text.back())) text.remove_suffix(1);
  double unit = pixel;
  for (const auto& [name, mm] : {std::pair<std::string_view, double>{"mm", 1},
                                 {"cm", 10},
                                 {"in", 25.4},
                                 {"px", pixel},
                                 {"pt", 25.4 / 72},
                                 {"pc", 25.4 / 6},
                                 {"Q", 0.25},
                                 {"m", 1000}})
    if (text.size() > name.size() && text.ends_with(name)) {
      unit = mm;
      text.remove_suffix(name.size());
      break;
    }
  const auto n = svgNumbers(text);
  if (!n || n->size() != 1) return std::nullopt;
  return n->front() * unit;
}

std::optional<std::vector<SvgLine>> svgLines(const XmlElement& element, const SvgMatrix& to, std::size_t& budget) {
  const auto value = [&](const char* key) -> double {
    const std::string* text = element.find(key);
    const auto n = text ? svgNumbers(std::string_view(*text).substr(0, text->find_first_of("pmci%"))) : std::nullopt;
    return n && n->size() == 1 ? n->front() : 0;
  };
  if (element.name == "path") {
    const std::string* d = element.find("d");
    return d ? PathReader(*d, to, budget).read() : std::nullopt;
  }
  SvgLine line;
  const auto points = [&](const std::vector<Flat>& p, bool closed) {
    for (std::size_t k = 0; k + (closed ? 0 : 1) < p.size(); ++k) {
      const Flat a = to(p[k]), b = to(p[(k + 1) % p.size()]);
      if (distance(a, b) > kTiny) line.curves.push_back(Curve::line(a, b));
    }
    line.closed = closed;
  };
  if (element.name == "line") {
    points({{value("x1"), value("y1")}, {value("x2"), value("y2")}}, false);
  } else if (element.name == "polyline" || element.name == "polygon") {
    const std::string* list = element.find("points");
    const auto n = list ? svgNumbers(*list) : std::nullopt;
    if (!n || n->size() < 4) return std::nullopt;
    std::vector<Flat> p;
    for (std::size_t k = 0; k + 1 < n->size(); k += 2) p.push_back({(*n)[k], (*n)[k + 1]});
    points(p, element.name == "polygon");
  } else if (element.name == "rect") {
    const double x = value("x"), y = value("y"), w = value("width"), h = value("height");
    if (!(w > 0 && h > 0)) return std::nullopt;
    points({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, true);
  } else if (element.name == "circle" || element.name == "ellipse") {
    Arc arc;
    arc.rx = element.name == "circle" ? value("r") : value("rx");
    arc.ry = element.name == "circle" ? value("r") : value("ry");
    arc.sweep = true;
    if (!(arc.rx > 0 && arc.ry > 0)) return std::nullopt;
    const Flat middle{value("cx"), value("cy")}, reach{arc.rx, 0};
    addArc(line.curves, to, middle - reach, middle + reach, arc);
    addArc(line.curves, to, middle + reach, middle - reach, arc);
    line.closed = true;
  } else {
    return std::nullopt;
  }
  if (line.curves.empty() || budget < line.curves.size()) return std::nullopt;
  budget -= line.curves.size();
  return std::vector{std::move(line)};
}

}  // namespace karinui
