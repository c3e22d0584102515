#pragma once
// Small pieces, random outlines, real drafts and pictures for the tests of patterns.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "karinui/pattern/lattice.h"

namespace karinui::test {

inline Outline polygon(const std::vector<Flat>& corners, const std::string& prefix = "e") {
  Outline outline;
  for (std::size_t k = 0; k < corners.size(); ++k)
    outline.edges.push_back({prefix + std::to_string(k), Curve::line(corners[k], corners[(k + 1) % corners.size()])});
  return outline;
}

inline Outline rectangle(double width, double height, Flat low = {}) {
  Outline outline = polygon({low, low + Flat{width, 0}, low + Flat{width, height}, low + Flat{0, height}});
  const char* names[] = {"bottom", "right", "top", "left"};
  for (int k = 0; k < 4; ++k) outline.edges[k].name = names[k];
  return outline;
}

inline Outline circle(double radius, Flat centre = {}, const std::string& prefix = "arc") {
  const double quarter = std::tan(std::numbers::pi / 8);
  const Flat p[4] = {{radius, 0}, {0, radius}, {-radius, 0}, {0, -radius}};
  Outline outline;
  for (int k = 0; k < 4; ++k)
    outline.edges.push_back({prefix + std::to_string(k), Curve::arc(centre + p[k], centre + p[(k + 1) % 4], quarter)});
  return outline;
}

inline Pattern patternOf(const std::vector<Piece>& pieces) {
  Pattern pattern;
  for (const Piece& piece : pieces) pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  return pattern;
}

inline Piece pieceOf(std::uint64_t id, Outline outline, const std::string& name = "piece") {
  Piece piece;
  piece.id = {id};
  piece.name = name;
  piece.outline = std::move(outline);
  return piece;
}

// A star-shaped outline of lines, cubics and arcs, never crossing itself.
inline Outline randomOutline(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(0, 1);
  const int count = 4 + static_cast<int>(unit(random) * 7);
  std::vector<Flat> corner;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.5 * unit(random)) / count,
                 radius = size * (0.55 + 0.45 * unit(random));
    corner.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  Outline outline;
  for (int k = 0; k < count; ++k) {
    const Flat a = corner[k], b = corner[(k + 1) % count];
    const Flat across = leftOf(b - a);
    const int kind = static_cast<int>(unit(random) * 3);
    const double bow = 0.12 * (2 * unit(random) - 1);
    Curve curve = Curve::line(a, b);
    if (kind == 1) curve = Curve::arc(a, b, bow);
    if (kind == 2) curve = Curve::cubic(a, lerp(a, b, 0.3) + across * bow, lerp(a, b, 0.7) - across * (0.5 * bow), b);
    outline.edges.push_back({"e" + std::to_string(k), curve});
  }
  return outline;
}

// Cubics through a smooth run of points, within `miss`.
inline void fit(const std::vector<Flat>& p, std::size_t first, std::size_t last, Flat in, Flat out, double miss,
                std::vector<Curve>& made) {
  if (last - first == 1) {
    made.push_back(Curve::line(p[first], p[last]));
    return;
  }
  std::vector<double> t(last - first + 1, 0);
  for (std::size_t k = first + 1; k <= last; ++k) t[k - first] = t[k - first - 1] + distance(p[k - 1], p[k]);
  for (double& x : t) x /= t.back();
  double c00 = 0, c01 = 0, c11 = 0, x0 = 0, x1 = 0;
  for (std::size_t k = first; k <= last; ++k) {
    const double u = t[k - first], s = 1 - u;
    const Flat a0 = in * (3 * u * s * s), a1 = out * (-3 * u * u * s);
    const Flat rest = p[k] - (p[first] * (s * s * s + 3 * u * s * s) + p[last] * (u * u * u + 3 * u * u * s));
    c00 += dot(a0, a0), c01 += dot(a0, a1), c11 += dot(a1, a1), x0 += dot(rest, a0), x1 += dot(rest, a1);
  }
  const double det = c00 * c11 - c01 * c01, chord = distance(p[first], p[last]);
  double alpha = det > 0 ? (x0 * c11 - x1 * c01) / det : 0, beta = det > 0 ? (c00 * x1 - c01 * x0) / det : 0;
  if (!(alpha > 0.05 * chord) || !(beta > 0.05 * chord)) alpha = beta = chord / 3;
  const Curve curve = Curve::cubic(p[first], p[first] + in * alpha, p[last] - out * beta, p[last]);
  double worst = 0;
  for (std::size_t k = first; k <= last; ++k) {
    double near = 1;
    for (int n = -20; n <= 20; ++n) near = std::min(near, distance(curve.at(t[k - first] + n * 0.003), p[k]));
    worst = std::max(worst, near);
  }
  if (worst < miss) {
    made.push_back(curve);
    return;
  }
  const std::size_t middle = (first + last) / 2;
  const Flat tangent = normalized(p[middle + 1] - p[middle - 1]);
  fit(p, first, middle, in, tangent, miss, made);
  fit(p, middle, last, tangent, out, miss, made);
}

struct Draft {
  Pattern pattern;
  std::map<std::string, double> areaMm2, perimeterMm;
};

// A draft of shared/patterns: edges run between corners (named ones, and where the outline turns by more than 20
// degrees).
inline Draft draft(const std::string& path) {
  const auto json = nlohmann::json::parse(std::ifstream(path));
  Draft made;
  std::map<std::string, std::uint64_t> idOf;
  struct Vertex {
    std::size_t edge;
    double fraction;
  };
  std::map<std::string, std::map<std::size_t, std::size_t>>
      edgeAt;  // piece, vertex (counter-clockwise) -> edge from there
  std::map<std::string, std::map<std::string, std::size_t>> cornerAt;
  for (const auto& item : json["pieces"]) {
    const std::string name = item["name"];
    std::vector<Flat> points;
    for (const auto& p : item["outline"]) points.push_back({p[0].get<double>() / 1e3, -p[1].get<double>() / 1e3});
    const std::size_t count = points.size();
    const bool turned = signedArea(points) < 0;
    if (turned) std::reverse(points.begin(), points.end());
    std::set<std::size_t> corners;
    for (const auto& [corner, index] : item["corners"].items()) {
      const std::size_t k = turned ? count - 1 - index.get<std::size_t>() : index.get<std::size_t>();
      corners.insert(k);
      cornerAt[name][corner] = k;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Flat in = points[k] - points[(k + count - 1) % count], out = points[(k + 1) % count] - points[k];
      if (std::abs(std::atan2(cross(in, out), dot(in, out))) > 0.35) corners.insert(k);
    }
    Outline outline;
    for (auto c = corners.begin(); c != corners.end(); ++c) {
      const std::size_t from = *c, to = std::next(c) == corners.end() ? *corners.begin() + count : *std::next(c);
      std::vector<Flat> run;
      for (std::size_t k = from; k <= to; ++k) run.push_back(points[k % count]);
      std::vector<Curve> curves;
      double bow = 0;
      for (Flat p : run) bow = std::max(bow, distanceToSegment(run.front(), run.back(), p));
      if (bow < 1e-5)
        curves.push_back(Curve::line(run.front(), run.back()));
      else
        fit(run, 0, run.size() - 1, normalized(run[1] - run[0]), normalized(run.back() - run[run.size() - 2]), 1e-4,
            curves);
      edgeAt[name][from] = outline.edges.size();
      for (const Curve& curve : curves) outline.edges.push_back({"e" + std::to_string(outline.edges.size()), curve});
    }
    Piece piece = pieceOf(made.pattern.pieces.size() + 1, outline, name);
    if (item["grainline"].is_array()) {
      const auto& g = item["grainline"];
      piece.grain = normalized(
          Flat{g[1][0].get<double>() - g[0][0].get<double>(), -(g[1][1].get<double>() - g[0][1].get<double>())});
    }
    idOf[name] = piece.id.value;
    made.areaMm2[name] = item["area_mm2"];
    made.perimeterMm[name] = item["perimeter_mm"];
    made.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  }
  const auto spans = [&](const nlohmann::json& range) {
    std::vector<EdgeSpan> run;
    const std::string name = range[0];
    if (!idOf.contains(name)) return run;
    const Piece& piece = *made.pattern.pieces.at({idOf[name]});
    const auto& edges = piece.outline.edges;
    std::size_t from = edgeAt[name].at(cornerAt[name].at(range[1])), to = edgeAt[name].at(cornerAt[name].at(range[2]));
    // Whichever way round is shorter is the side that is meant.
    double forward = 0, backward = 0;
    for (std::size_t k = from; k != to; k = (k + 1) % edges.size()) forward += edges[k].curve.length();
    for (std::size_t k = to; k != from; k = (k + 1) % edges.size()) backward += edges[k].curve.length();
    if (backward < forward) std::swap(from, to);
    for (std::size_t k = from; k != to; k = (k + 1) % edges.size()) run.push_back({piece.id, edges[k].name, 0, 1});
    return run;
  };
  for (const auto& item : json["seams"]) {
    Seam seam;
    seam.id = {made.pattern.seams.size() + 1};
    seam.name = item["name"];
    const auto side = [&](const nlohmann::json& s) {
      if (s[0].is_string()) return spans(s);
      std::vector<EdgeSpan> run;
      for (const auto& r : s) {
        const auto more = spans(r);
        run.insert(run.end(), more.begin(), more.end());
      }
      return run;
    };
    seam.a = side(item["a"]);
    seam.b = side(item["b"]);
    if (!seam.a.empty() && !seam.b.empty()) made.pattern.seams[seam.id] = seam;
  }
  return made;
}

// A picture to look at: SVG, one unit a millimetre.
inline void draw(const std::string& path, const std::vector<std::shared_ptr<const Lattice>>& lattices) {
  std::ofstream out(path);
  double x = 0, height = 0;
  std::string body;
  for (const auto& lattice : lattices) {
    Flat low{1e9, 1e9}, high{-1e9, -1e9};
    for (Flat p : lattice->nodes) {
      low = {std::min(low.u, p.u), std::min(low.v, p.v)};
      high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    const auto at = [&](std::uint32_t n) {
      return std::to_string(x + 10 + (lattice->nodes[n].u - low.u) * 1e3) + "," +
             std::to_string(10 + (high.v - lattice->nodes[n].v) * 1e3);
    };
    for (const Triangle& f : lattice->faces)
      body += "<polygon points='" + at(f[0]) + " " + at(f[1]) + " " + at(f[2]) +
              "' fill='#eef' stroke='#557' stroke-width='0.6'/>\n";
    body += "<polygon fill='none' stroke='#c00' stroke-width='1.2' points='";
    for (auto n : lattice->border) body += at(n) + " ";
    body += "'/>\n";
    for (auto n : lattice->border)
      body += "<circle r='1.6' fill='#c00' cx='" + at(n).substr(0, at(n).find(',')) + "' cy='" +
              at(n).substr(at(n).find(',') + 1) + "'/>\n";
    x += (high.u - low.u) * 1e3 + 20;
    height = std::max(height, (high.v - low.v) * 1e3 + 20);
  }
  out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << x << " " << height << "' width='" << x
      << "' height='" << height << "'><rect width='100%' height='100%' fill='white'/>\n"
      << body << "</svg>\n";
}

inline double smallestAngle(const Lattice& l, const Triangle& f) {
  const auto angle = [&](int k) {
    const Flat p = l.nodes[f[k]], q = l.nodes[f[(k + 1) % 3]], r = l.nodes[f[(k + 2) % 3]];
    return std::atan2(std::abs(cross(q - p, r - p)), dot(q - p, r - p)) * 180 / std::numbers::pi;
  };
  return std::min({angle(0), angle(1), angle(2)});
}

}  // namespace karinui::test
