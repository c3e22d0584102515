// Patterns drawn by other programs: FreeSewing, Inkscape, Valentina and Seamly2D, and whatever draws closed lines at
// true size. What is a piece, a seam line, a grain line or a notch is told by names and classes where these programs
// give them, else by which line lies within which.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "exchange/names.h"
#include "exchange/sheet.h"
#include "exchange/strict_json.h"
#include "exchange/xml.h"
#include "karinui/base/number.h"
#include "karinui/exchange/drawing.h"
#include "karinui/exchange/formats.h"
#include "karinui/exchange/sheet.h"
#include "karinui/geometry/fit_curve.h"
#include "svg_habits.h"
#include "svg_path.h"

namespace karinui {

namespace {

constexpr std::size_t kMostCurves = 400'000, kMostPieces = 2000, kMostEdges = 2000, kMostMarks = 2000;
constexpr double kSmallest = 4e-4;                 // m2 of a piece
constexpr double kMeet = 5e-4;                     // metres: ends of open lines that are one outline
constexpr double kSlip = 5e-3;                     // wider gaps are no slip of the hand
constexpr double kCorner = std::numbers::pi / 36;  // 5 degrees part two edges
constexpr double kShortest = 5e-5;                 // of an edge: shorter ones belong to the edge before
constexpr double kNotchReach = 0.012;              // a notch farther from the outline is none
constexpr double kAllowance = 0.06;                // a cut line lies no farther outside its seam line

enum class Kind { Unknown, Seam, Cut, Grain, Fold, Notch, Drill, Inside, Nothing };

std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> wordsIn(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : lowered(text)) {
    if (std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80)
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  return words;
}

// What a class, an id or a label says a line is. FreeSewing: "fabric", "fabric sa", "grainline", "fabric help", "note",
// "hidden"; Seamly2D and hand-named layers: seam line, cutting line, grain line, notches, internal.
Kind kindNamed(const std::string& text) {
  const auto words = wordsIn(text);
  const auto has = [&](std::initializer_list<std::string_view> any) {
    return std::any_of(any.begin(), any.end(),
                       [&](std::string_view one) { return std::find(words.begin(), words.end(), one) != words.end(); });
  };
  if (has({"hidden", "clip", "logo", "title", "scalebox", "guide", "help", "note", "text", "contrast", "dotted",
           "teal"}))
    return Kind::Nothing;
  if (has({"grainline", "grain", "fadenlauf"})) return Kind::Grain;
  if (has({"notch", "bnotch", "notches", "passmark", "knips"})) return Kind::Notch;
  if (has({"drill", "button", "buttonhole", "snap", "eyelet"})) return Kind::Drill;
  if (has({"fold", "cutonfold", "foldline"})) return Kind::Fold;
  if (has({"sa", "allowance", "seamallowance", "cut", "cutline", "cutting", "zugabe"})) return Kind::Cut;
  if (has({"internal", "inside", "placement", "dart", "mark", "dashed", "lashed"})) return Kind::Inside;
  if (has({"seam", "seamline", "sewline", "stitchline", "fabric", "lining", "interfacing", "outline", "contour"}))
    return Kind::Seam;
  return Kind::Unknown;
}

// The square by which a print is checked is no piece.
bool isTestSquare(const std::string& name) {
  const auto words = wordsIn(name);
  const auto has = [&](std::string_view one) { return std::find(words.begin(), words.end(), one) != words.end(); };
  return (has("scale") || has("test") || has("calibration")) && (has("square") || has("box"));
}

bool usable(const std::string& name) {  // not made by the program
  const std::string low = lowered(name);
  for (const std::string_view made : {"path", "g", "layer", "svg", "group", "use", "rect", "polygon", "fs", "clone",
                                      "artboard", "ebene", "calque", "レイヤー", "アートボード"}) {
    if (!low.starts_with(made)) continue;
    const std::string rest = low.substr(made.size());
    if (rest.find_first_not_of("0123456789-_ ") == std::string::npos) return false;
  }
  return !low.empty() && low != "fs-container" && low.find_first_not_of("0123456789-_. ") != std::string::npos;
}

// "fs-stack-teagan.front" is "front".
std::string plainName(std::string name) {
  for (const std::string_view lead : {"fs-stack-", "fs-part-"})
    if (name.starts_with(lead)) {
      name.erase(0, lead.size());
      if (const auto dot = name.rfind('.'); dot != std::string::npos && dot + 1 < name.size()) name.erase(0, dot + 1);
    }
  return name;
}

struct Drawn {
  SvgLine line;
  Kind kind = Kind::Unknown;
  bool dashed = false;
  std::size_t group = 0;
  std::string name;
  Ring ring;
  double area = 0;
  bool used = false;
  double gap = 0;  // the widest that was closed
};
struct Place {
  Flat at;
  Kind kind = Kind::Notch;
  std::size_t group = 0;
};
struct Words {
  Flat at;
  std::string text;
};
struct Group {
  std::string name;
  std::size_t parent = 0;
};

class Drawing {
 public:
  // `unit`: metres of a unit of the drawing, where somebody said it.
  Drawing(std::string_view svg, const XmlElement& root, double unit)
      : perInch_(pixelsPerInch(svg, root)), illustrator_(isFromIllustrator(svg, root)), unit_(unit) {}

  Result<CadPattern> read(const std::vector<XmlElement>& elements) {
    if (auto scaled = units(elements.front()); !scaled) return scaled.error();
    // Symbols of notches and holes are places; their drawing is of no account.
    const WithClones whole = withClones(elements, [](const std::string& to) {
      const Kind kind = kindNamed(to);
      return kind == Kind::Notch || kind == Kind::Drill || kind == Kind::Nothing;
    });
    if (whole.tooMany) return badInput(say("The drawing has more than {0} curves.", kMostCurves));
    for (std::size_t k = 0; k < std::min<std::size_t>(whole.missing.size(), 8); ++k)
      out_.notes.push_back(
          say("A clone of “{0}” was left out: the drawing has nothing of that name.", shown(whole.missing[k])));
    if (auto taken = walk(whole.elements); !taken) return taken.error();
    if (auto made = pieces(); !made) return made.error();
    if (out_.pattern.pieces.empty() && why_)
      return badInput(say("The drawing has no closed line that could be a piece. {0}", *why_));
    if (out_.pattern.pieces.empty())
      return badInput(
          say("The drawing has no closed line that could be a piece. Draw each piece as one closed path, or as paths "
              "whose ends meet, in a group of its own."));
    return std::move(out_);
  }

 private:
  // Millimetres of a user unit, from the drawing's size and its viewBox.
  Done units(const XmlElement& svg) {
    const std::string *width = svg.find("width"), *height = svg.find("height"), *box = svg.find("viewBox");
    const double pixel = 25.4 / perInch_;
    const auto wide = width ? svgMillimetres(*width, pixel) : std::nullopt;
    const auto high = height ? svgMillimetres(*height, pixel) : std::nullopt;
    double scale = pixel;
    const auto untold = [&] {
      if (unit_ > 0) return;
      if (perInch_ == 96) out_.guessedUnit = 0.0254 / perInch_;
      out_.notes.push_back(perInch_ == 96 ? say("The drawing does not tell its size; a unit was read as a pixel, 96 to "
                                                "the inch. Where a length is wrong, say what a unit is (--unit mm).")
                                          : say("The drawing’s size is in pixels, which the program that drew it "
                                                "counts {0} to the inch; so it was read.",
                                                perInch_));
    };
    const auto inPixels = [](const std::string* text) {
      return text &&
             (text->ends_with("px") || (!text->empty() && std::isdigit(static_cast<unsigned char>(text->back())) != 0));
    };
    Flat corner;
    if (box) {
      const auto n = svgNumbers(*box);
      if (!n || n->size() != 4 || !((*n)[2] > 0) || !((*n)[3] > 0))
        return badInput(say("The drawing's viewBox must be four numbers, the last two of them sizes."));
      corner = {(*n)[0], (*n)[1]};
      double x = wide ? *wide / (*n)[2] : 0, y = high ? *high / (*n)[3] : 0;
      if (x > 0 && y > 0)
        scale = std::min(x, y);
      else if (x > 0 || y > 0)
        scale = std::max(x, y);
      else
        untold();
    } else if (!wide && !high) {
      untold();
    }
    if (perInch_ != 96 && (inPixels(width) || inPixels(height))) untold();
    if (unit_ > 0) scale = unit_ * 1000;
    if (!(scale > 1e-6 && scale < 1e5)) return badInput(say("The drawing's width and viewBox give no usable scale."));
    const double metres = scale / 1000;
    page_ = SvgMatrix{metres, 0, 0, -metres, -corner.u * metres, corner.v * metres};
    return {};
  }

  struct Open {
    SvgMatrix to;
    std::size_t depth, group;
    Kind kind;
    bool hidden, dashed;
  };

  Done walk(const std::vector<XmlElement>& elements) {
    groups_.push_back({});
    const SvgStyles styles(elements);
    std::vector<Open> open{{page_, 0, 0, Kind::Unknown, false, false}};
    std::size_t budget = kMostCurves;
    for (std::size_t i = 1; i < elements.size(); ++i) {
      const XmlElement& element = elements[i];
      while (open.size() > 1 && open.back().depth >= element.depth) open.pop_back();
      Open here = open.back();
      here.depth = element.depth;
      const std::string name =
          element.name.substr(element.name.find(':') == std::string::npos ? 0 : element.name.find(':') + 1);
      if (name == "defs" || name == "symbol" || name == "clipPath" || name == "mask" || name == "pattern" ||
          name == "marker" || name == "style" || name == "metadata" || name == "script" || name == "foreignObject")
        here.hidden = true;
      if (styles.of(element, "display") == "none" || styles.of(element, "visibility") == "hidden") here.hidden = true;
      if (const std::string* transform = element.find("transform")) {
        const auto own = svgTransform(*transform);
        if (!own) return badInput(say("The drawing has a transform that cannot be read: \"{0}\".", shown(*transform)));
        here.to = here.to * *own;
      }
      const std::string dashes = styles.of(element, "stroke-dasharray");
      if (!dashes.empty()) here.dashed = dashes != "none" && dashes != "0";
      const std::string* label = element.find("inkscape:label");
      for (const char* other : {"data-name", "serif:id"})  // of Illustrator and of Affinity Designer
        if (!label) label = element.find(other);
      const std::string *id = element.find("id"), *css = element.find("class");
      const std::string plain = illustrator_ && id ? illustratorName(*id) : "";
      if (!plain.empty()) id = &plain;
      if ((id && isTestSquare(*id)) || (label && isTestSquare(*label))) here.hidden = true;
      const auto learn = [&](const std::string* text) {
        if (!text) return;
        if (const Kind kind = kindNamed(*text); kind != Kind::Unknown) here.kind = kind;
      };
      if (name != "g") learn(id), learn(label);
      learn(css);
      if (name == "g" || name == "a" || name == "svg") {
        if (!css) learn(label);
        std::string called = label ? *label : id ? *id : "";
        groups_.push_back({usable(called) && kindNamed(called) == Kind::Unknown ? plainName(called) : "", here.group});
        here.group = groups_.size() - 1;
        open.push_back(here);
        continue;
      }
      open.push_back(here);
      if (here.hidden) continue;
      if (name == "text" || name == "tspan" || name == "textPath") {
        const std::string *x = element.find("x"), *y = element.find("y");
        const auto u = x ? svgNumbers(*x) : std::nullopt, v = y ? svgNumbers(*y) : std::nullopt;
        const Flat at{u && !u->empty() ? u->front() : 0, v && !v->empty() ? v->front() : 0};
        std::string text = cleanText(element.text);
        while (!text.empty() && text.back() == ' ') text.pop_back();
        while (!text.empty() && text.front() == ' ') text.erase(0, 1);
        if (!text.empty() && words_.size() < kMostPieces) words_.push_back({here.to(at), std::move(text)});
        continue;
      }
      if (name == "use") {
        const std::string* to = element.find("xlink:href");
        if (!to) to = element.find("href");
        const Kind kind = to ? kindNamed(*to) : Kind::Unknown;
        if (kind != Kind::Notch && kind != Kind::Drill) continue;
        const std::string *x = element.find("x"), *y = element.find("y");
        const auto u = x ? svgNumbers(*x) : std::nullopt, v = y ? svgNumbers(*y) : std::nullopt;
        if (places_.size() < kMostMarks)
          places_.push_back(
              {here.to({u && !u->empty() ? u->front() : 0, v && !v->empty() ? v->front() : 0}), kind, here.group});
        continue;
      }
      if (here.kind == Kind::Nothing) continue;
      XmlElement shape = element;
      shape.name = name;
      if (name != "path" && name != "rect" && name != "circle" && name != "ellipse" && name != "line" &&
          name != "polyline" && name != "polygon")
        continue;
      auto lines = svgLines(shape, here.to, budget);
      if (!lines) {
        if (budget == 0) return badInput(say("The drawing has more than {0} curves.", kMostCurves));
        why_ = say("A line of the drawing cannot be read and was left out: {0}.", shown(id ? *id : name));
        out_.notes.push_back(*why_);
        if (out_.notes.size() > 100) return badInput(say("Too many lines of the drawing cannot be read."));
        continue;
      }
      for (SvgLine& line : *lines) take(std::move(line), here, label ? *label : id ? *id : "");
    }
    return {};
  }

  void take(SvgLine line, const Open& here, const std::string& called) {
    if (line.curves.empty()) return;
    const Flat first = line.curves.front().start, last = line.curves.back().end;
    for (const Curve& curve : line.curves)
      for (const Flat p : {curve.start, curve.end, curve.control1, curve.control2})
        if (!finite(p) || std::abs(p.u) > 90 || std::abs(p.v) > 90) return;
    if (distance(first, last) < kMeet && line.curves.size() > 1) {
      line.closed = true;
      line.curves.back().end = first;
    }
    Drawn drawn{std::move(line),
                here.kind,
                here.dashed,
                here.group,
                usable(called) && kindNamed(called) == Kind::Unknown ? plainName(called) : "",
                {},
                0,
                false,
                0};
    measure(drawn);
    lines_.push_back(std::move(drawn));
  }
  static void measure(Drawn& drawn) {
    drawn.ring.clear();
    for (const Curve& curve : drawn.line.curves) {
      const auto points = curve.flattened(2e-4);
      drawn.ring.insert(drawn.ring.end(), points.begin(), points.end() - 1);
    }
    drawn.area = drawn.line.closed ? std::abs(signedArea(drawn.ring)) : 0;
  }

  static double gapOf(const Drawn& one) { return distance(one.line.curves.back().end, one.line.curves.front().start); }
  bool maybeOutline(const Drawn& one) const {
    return !one.line.closed && !one.used &&
           (one.kind == Kind::Unknown || one.kind == Kind::Seam || one.kind == Kind::Cut);
  }
  // The area within an open line and the straight one from its end to its start.
  static double areaIfClosed(const Drawn& one) {
    Ring ring = one.ring;
    ring.push_back(one.line.curves.back().end);
    return std::abs(signedArea(ring));
  }
  static std::string millimetres(double metres) { return fixed(1000 * metres, 1); }
  // The end of one run and the start of the next (or of the same) are brought together: where a hand left a gap between
  // straight lines, or drew them past each other, in the corner that they make; else by a straight line.
  static void meetAt(std::vector<Curve>& run, std::vector<Curve>& next) {
    Curve &in = run.back(), &out = next.front();
    const double gap = distance(in.end, out.start);
    if (gap <= kMeet) {
      if (&run == &next)
        in.end = out.start;
      else
        out.start = in.end;
      return;
    }
    const Flat a = in.end - in.start, b = out.end - out.start, between = out.start - in.end;
    const double turned = a.u * b.v - a.v * b.u;
    if (in.kind == Curve::Kind::Line && out.kind == Curve::Kind::Line &&
        std::abs(turned) > 0.2 * length(a) * length(b)) {
      const Flat corner = in.end + a * ((between.u * b.v - between.v * b.u) / turned);
      if (distance(corner, in.end) < 0.5 * length(a) && distance(corner, out.start) < 0.5 * length(b) &&
          distance(corner, in.end) <= 2 * gap) {
        in.end = out.start = corner;
        return;
      }
    }
    run.push_back(Curve::line(in.end, out.start));
  }
  // A single line whose ends nearly meet is closed.
  void closeGaps() {
    for (Drawn& one : lines_) {
      const double gap = gapOf(one);
      if (!maybeOutline(one) || gap > kSlip || one.line.curves.size() < 2 || areaIfClosed(one) < kSmallest) continue;
      meetAt(one.line.curves, one.line.curves);
      one.line.closed = true;
      measure(one);
      one.gap = gap;
    }
  }
  // Lines that were perhaps meant to be pieces and are open.
  void tellOpen(const std::vector<std::size_t>& chosen) {
    std::string all;
    std::size_t count = 0;
    const Drawn* first = nullptr;
    for (const Drawn& one : lines_) {
      if (!maybeOutline(one) || areaIfClosed(one) < 25 * kSmallest) continue;
      if (std::any_of(chosen.begin(), chosen.end(), [&](std::size_t k) {
            return contains(lines_[k].ring, one.ring[one.ring.size() / 2]) ||
                   (one.group != 0 && one.group == lines_[k].group);
          }))
        continue;
      if (!first) first = &one;
      if (++count <= 8) all += (count == 1 ? "“" : ", “") + nameFor(one) + "”";
    }
    if (count == 0) return;
    if (count > 8) all += ", …";
    out_.notes.push_back(*(why_ = say("{0} open {0|line is|lines are} no {0|piece|pieces}, since {0|its|their} ends "
                                      "do not meet: {1} (the first by {2} mm). Join them where a piece is meant.",
                                      count, all, millimetres(gapOf(*first)))));
  }

  // Open lines of one group whose ends meet become one closed line.
  void chain(double meet) {
    std::map<std::size_t, std::vector<std::size_t>> open;
    std::set<std::size_t> closed, cut;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Drawn& one = lines_[i];
      // A cut line in one piece may have its seam line drawn edge by edge within.
      if (one.line.closed && one.area > kSmallest) (one.kind == Kind::Cut ? cut : closed).insert(one.group);
      if (!one.line.closed && (one.kind == Kind::Unknown || one.kind == Kind::Seam)) open[one.group].push_back(i);
    }
    for (auto& [group, members] : open) {
      if (closed.contains(group) || members.size() > 400) continue;
      if (cut.contains(group)) std::erase_if(members, [&](std::size_t k) { return lines_[k].kind != Kind::Seam; });
      std::set<std::size_t> left(members.begin(), members.end());
      while (!left.empty()) {
        Drawn whole = lines_[*left.begin()];
        std::vector<std::size_t> taken{*left.begin()};
        left.erase(left.begin());
        for (bool more = true; more;) {
          more = false;
          const Flat end = whole.line.curves.back().end;
          const auto reach = [&](std::size_t k) {
            const auto& next = lines_[k].line.curves;
            return std::min(distance(end, next.front().start), distance(end, next.back().end));
          };
          const auto nearest = std::min_element(left.begin(), left.end(),
                                                [&](std::size_t a, std::size_t b) { return reach(a) < reach(b); });
          if (nearest == left.end() || reach(*nearest) > meet) break;
          const double gap = reach(*nearest);
          auto next = lines_[*nearest].line.curves;
          if (distance(end, next.front().start) > gap) {
            std::reverse(next.begin(), next.end());
            for (Curve& curve : next) curve = curve.reversed();
          }
          whole.gap = std::max(whole.gap, gap > kMeet ? gap : 0);
          meetAt(whole.line.curves, next);
          whole.line.curves.insert(whole.line.curves.end(), next.begin(), next.end());
          taken.push_back(*nearest), left.erase(nearest);
          more = true;
        }
        if (gapOf(whole) > meet || whole.line.curves.size() < 2) continue;
        whole.gap = std::max(whole.gap, gapOf(whole) > kMeet ? gapOf(whole) : 0);
        meetAt(whole.line.curves, whole.line.curves);
        whole.line.closed = true;
        measure(whole);
        if (whole.area < kSmallest) continue;
        for (const std::size_t k : taken) lines_[k].used = true;
        lines_.push_back(std::move(whole));
      }
    }
  }

  bool holds(const Drawn& outer, const Drawn& inner) const {
    if (inner.area >= outer.area) return false;
    std::size_t in = 0, all = 0;
    for (std::size_t k = 0; k < inner.ring.size(); k += std::max<std::size_t>(1, inner.ring.size() / 40))
      ++all, in += contains(outer.ring, inner.ring[k]);
    return in * 10 >= all * 9;
  }
  // Whether the inner line runs along the outer one, as a seam line along its cut line.
  bool runsAlong(const Drawn& outer, const Drawn& inner) const {
    if (inner.area < 0.4 * outer.area) return false;
    for (std::size_t k = 0; k < outer.ring.size(); k += std::max<std::size_t>(1, outer.ring.size() / 60))
      if (distanceToRing(inner.ring, outer.ring[k]) > 1.6 * kAllowance) return false;
    return true;
  }

  std::string nameFor(const Drawn& drawn) {
    if (!drawn.name.empty()) return drawn.name;
    for (std::size_t g = drawn.group; g != 0; g = groups_[g].parent)
      if (!groups_[g].name.empty()) return groups_[g].name;
    for (const Words& words : words_)
      if (usable(words.text) && contains(drawn.ring, words.at)) return words.text;
    return "piece";
  }
  bool within(std::size_t group, std::size_t of) const {
    for (; group != 0; group = groups_[group].parent)
      if (group == of) return true;
    return of == 0;
  }

  Done pieces() {
    chain(kMeet);
    chain(kSlip);
    closeGaps();
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].line.closed && lines_[i].area > kSmallest && !lines_[i].used &&
          (lines_[i].kind == Kind::Unknown || lines_[i].kind == Kind::Seam || lines_[i].kind == Kind::Cut))
        order.push_back(i);
    if (order.size() > kMostPieces) return badInput(say("The drawing has more than {0} closed lines.", kMostPieces));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return lines_[a].area > lines_[b].area; });
    // A frame round everything is no piece.
    if (order.size() > 2) {
      const std::size_t frame = order.front();
      if (lines_[frame].line.curves.size() == 4 &&
          std::all_of(order.begin() + 1, order.end(), [&](std::size_t k) { return holds(lines_[frame], lines_[k]); }) &&
          !runsAlong(lines_[frame], lines_[order[1]]))
        order.erase(order.begin());
    }
    std::vector<std::size_t> chosen;
    std::vector<std::string> seamless;  // pieces with a cut line only
    for (const std::size_t i : order) {
      if (lines_[i].used) continue;
      std::size_t best = i;
      std::vector<std::size_t> inside;
      for (const std::size_t k : order)
        if (k != i && !lines_[k].used && holds(lines_[i], lines_[k])) inside.push_back(k);
      if (lines_[i].kind != Kind::Seam)
        for (const std::size_t k : inside)
          if (lines_[k].kind != Kind::Cut && runsAlong(lines_[i], lines_[k]) &&
              (lines_[k].kind == Kind::Seam || lines_[i].kind == Kind::Cut || lines_[k].dashed != lines_[i].dashed ||
               best == i)) {
            best = k;
            break;
          }
      lines_[i].used = lines_[best].used = true;
      if (best == i && lines_[i].kind == Kind::Cut) seamless.push_back(nameFor(lines_[i]));
      for (const std::size_t k : inside)
        if (k != best) lines_[k].used = true, lines_[k].kind = Kind::Inside;
      chosen.push_back(best);
    }
    tellSeamless(std::move(seamless));
    std::size_t gaps = 0;
    double widest = 0;
    for (const std::size_t k : chosen)
      if (lines_[k].gap > 0) ++gaps, widest = std::max(widest, lines_[k].gap);
    if (gaps > 0)
      out_.notes.push_back(say("{0} {0|outline was|outlines were} open by up to {1} mm and {0|was|were} closed.", gaps,
                               millimetres(widest)));
    tellOpen(chosen);
    DistinctNames names;
    std::optional<Error> trouble;
    for (const std::size_t k : chosen) {
      auto piece = pieceOf(lines_[k]);
      if (!piece) {
        const Message what = say("“{0}”: {1}", nameFor(lines_[k]), piece.error().what);
        if (!trouble) trouble = badInput(what);
        out_.notes.push_back(what);
        continue;
      }
      piece->id = {out_.pattern.pieces.size() + 1};
      piece->name = names.give(oneWord(nameFor(lines_[k]), "piece"));
      out_.pattern.pieces[piece->id] = std::make_shared<const Piece>(*std::move(piece));
    }
    if (out_.pattern.pieces.empty() && trouble) return *trouble;
    return {};
  }

  void tellSeamless(std::vector<std::string> names) {
    if (names.empty()) return;
    std::sort(names.begin(), names.end());
    constexpr std::size_t kNamed = 8;
    std::string all;
    for (std::size_t k = 0; k < std::min(names.size(), kNamed); ++k) all += (k == 0 ? "“" : ", “") + names[k] + "”";
    if (names.size() > kNamed) all += ", …";
    out_.notes.push_back(say(
        "{0} {0|piece has|pieces have} no seam line, and the cut line was read as one: {1}. Where that holds a seam "
        "allowance, the garment comes out larger by it.",
        names.size(), all));
  }

  static double cornerBetween(const Curve& in, const Curve& out) {
    const Flat a = in.tangent(1), b = out.tangent(0);
    if (length(a) < 1e-12 || length(b) < 1e-12) return 0;
    return std::abs(angleFrom(a, b));
  }

  // Curves that go on smoothly are one edge; a chain of short lines between corners becomes a few curves.
  static Result<Outline> outlineOf(std::vector<Curve> curves) {
    const std::size_t n = curves.size();
    std::size_t first = 0;
    double sharpest = -1;
    std::vector<char> corner(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Curve &before = curves[(k + n - 1) % n], &here = curves[k];
      const double turned = cornerBetween(before, here);
      const auto isLong = [](const Curve& c) { return c.kind != Curve::Kind::Line || c.length() > 0.012; };
      // Between chords of a curve that was drawn as a polygon only a sharp turn is a corner.
      corner[k] = turned > (isLong(before) || isLong(here) ? kCorner : 6 * kCorner);
      if (turned > sharpest) sharpest = turned, first = k;
    }
    corner[first] = 1;
    if (std::count(corner.begin(), corner.end(), 1) < 2) corner[(first + n / 2) % n] = 1;
    Outline outline;
    std::vector<Curve> run;
    const auto close = [&] {
      if (run.empty()) return;
      const bool straight =
          std::all_of(run.begin(), run.end(), [](const Curve& c) { return c.kind == Curve::Kind::Line; });
      Curve whole;
      if (straight) {
        std::vector<Flat> points{run.front().start};
        for (const Curve& c : run) points.push_back(c.end);
        if (bow(points) < 2e-5) {
          whole = Curve::line(points.front(), points.back());
        } else if (points.size() > 3) {
          FitSettings settings;
          settings.straight = settings.tolerance = 5e-5;
          whole = Curve::joined(fitEdge(points, settings).curves);
        } else {
          whole = Curve::joined(run);
        }
      } else {
        whole = Curve::joined(run);
      }
      if (!outline.edges.empty() && whole.length() < kShortest) {
        const Curve both[] = {outline.edges.back().curve, whole};
        outline.edges.back().curve = Curve::joined(both);
      } else {
        outline.edges.push_back({"e" + std::to_string(outline.edges.size() + 1), std::move(whole)});
      }
      run.clear();
    };
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t at = (first + k) % n;
      if (corner[at]) close();
      run.push_back(curves[at]);
    }
    close();
    if (outline.edges.size() > kMostEdges) return badInput(say("An outline has more than {0} edges.", kMostEdges));
    return checked(std::move(outline));
  }
  Result<Piece> pieceOf(const Drawn& drawn) {
    Piece piece;
    auto outline = outlineOf(drawn.line.curves);
    if (!outline) return outline.error();
    piece.outline = *std::move(outline);
    std::size_t notches = 0, drills = 0;
    const auto notch = [&](Flat at) {
      std::string edge;
      double best = kNotchReach, share = 0;
      for (const Edge& one : piece.outline.edges) {
        const auto line = one.curve.flattened(1e-4);
        double before = 0, own = 0, near = 1e9;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
          const Flat way = line[i + 1] - line[i];
          const double size = length(way),
                       t = size > 0 ? std::clamp(dot(at - line[i], way) / (size * size), 0.0, 1.0) : 0;
          if (const double d = distance(at, line[i] + way * t); d < near) near = d, own = before + t * size;
          before += size;
        }
        if (near < best && before > 0) best = near, edge = one.name, share = own / before;
      }
      if (!edge.empty())
        piece.marks.push_back({"notch" + std::to_string(++notches), edge, std::clamp(share, 0.0, 1.0), {}});
    };
    const auto drill = [&](Flat at) { piece.marks.push_back({"drill" + std::to_string(++drills), "", 0, at}); };
    for (const Place& place : places_) {
      if (place.kind == Kind::Notch && within(place.group, drawn.group)) notch(place.at);
      if (place.kind == Kind::Drill && contains(drawn.ring, place.at)) drill(place.at);
    }
    for (Drawn& other : lines_) {
      if (&other == &drawn || piece.marks.size() > kMostMarks) continue;
      const Flat first = other.line.curves.front().start, last = other.line.curves.back().end;
      const Flat middle = other.ring.empty() ? first : other.ring[other.ring.size() / 2];
      const bool mine = contains(drawn.ring, middle) || within(other.group, drawn.group);
      if (!mine) continue;
      if (other.kind == Kind::Grain && distance(first, last) > 0.01 && contains(drawn.ring, lerp(first, last, 0.5))) {
        piece.grain = normalized(last - first);
        if (piece.grain.v < -1e-9 || (std::abs(piece.grain.v) <= 1e-9 && piece.grain.u < 0)) piece.grain = -piece.grain;
      } else if (other.kind == Kind::Notch) {
        notch(other.line.closed ? centreOf(other.ring) : nearestEnd(drawn.ring, first, last));
      } else if (other.kind == Kind::Drill) {
        if (contains(drawn.ring, centreOf(other.ring))) drill(centreOf(other.ring));
      } else if ((other.kind == Kind::Inside || (other.kind == Kind::Unknown && !other.used)) &&
                 contains(drawn.ring, middle) && piece.lines.size() < kMostMarks) {
        if (other.line.closed && other.area > 0 && other.area < 5e-5) {
          drill(centreOf(other.ring));
        } else {
          piece.lines.push_back({"line" + std::to_string(piece.lines.size() + 1), other.line.curves, {}});
        }
      }
    }
    return piece;
  }
  static Flat centreOf(const Ring& ring) {
    Flat sum;
    for (const Flat p : ring) sum += p * (1.0 / static_cast<double>(ring.size()));
    return sum;
  }
  static Flat nearestEnd(const Ring& ring, Flat a, Flat b) {
    return distanceToRing(ring, a) < distanceToRing(ring, b) ? a : b;
  }

  int perInch_;
  bool illustrator_;
  double unit_;
  std::optional<Message> why_;  // what was said of lines that are no pieces
  CadPattern out_;
  SvgMatrix page_;
  std::vector<Group> groups_;
  std::vector<Drawn> lines_;
  std::vector<Place> places_;
  std::vector<Words> words_;
};

}  // namespace

Result<CadPattern> readDrawing(std::string_view svg, std::string_view size, double unit) {
  if (!size.empty()) return badInput(say("Such a file holds one size only."));
  const auto elements = parseXml(svg);
  if (!elements) return elements.error();
  const std::string* format = elements->front().find("data-format");
  if (elements->front().name != "svg" && elements->front().name != "svg:svg")
    return badInput(say("This file is no SVG drawing."));
  if (format && *format == "karinui-sheet-1") {
    if (unit > 0) return badInput(unitIsTold());
    CadPattern whole;
    auto own = readSvg(svg, &whole.cutting.allowances, &whole.fabrics);
    if (!own) return own.error();
    whole.pattern = *std::move(own);
    leaveOutHoles(whole);
    return whole;
  }
  return Drawing(svg, elements->front(), unit).read(*elements);
}

}  // namespace karinui
