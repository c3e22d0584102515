#pragma once
// Patterns for the tests of exchange: real ones from the shared folder and random ones from a seed.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "karinui/pattern/piece.h"

namespace karinui::test {

inline std::filesystem::path shared(const std::string& path) {
  return std::filesystem::path(KARINUI_SHARED_DIR) / path;
}

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream out;
  out << file.rdbuf();
  return out.str();
}

// A drafted pattern (outline-json-1: millimetres, y down): a polygon cut into named edges at its corners.
inline Pattern drafted(const std::filesystem::path& path) {
  const auto json = nlohmann::json::parse(content(path));
  Pattern out;
  std::uint32_t nth = 0;
  for (const auto& source : json.at("pieces")) {
    std::vector<Flat> points;
    for (const auto& p : source.at("outline"))
      points.push_back({p[0].get<double>() / 1000, -p[1].get<double>() / 1000});
    Piece piece;
    piece.id = madeBy<PieceId>(1, nth++);
    piece.name = source.at("name");
    std::set<std::size_t> corners;
    for (const auto& [name, index] : source.at("corners").items()) corners.insert(index.get<std::size_t>());
    for (std::size_t i = 0; i < points.size(); ++i) {  // chords shorter than a millimetre are no edges of their own
      const Flat a = points[i], b = points[(i + 1) % points.size()];
      piece.outline.edges.push_back({"e" + std::to_string(i), Curve::line(a, b)});
    }
    std::vector<Edge> joined;
    for (const Edge& edge : piece.outline.edges) {
      if (!joined.empty() && edge.curve.length() < 2e-3)
        joined.back().curve.end = edge.curve.end;
      else
        joined.push_back(edge);
    }
    joined.back().curve.end = joined.front().curve.start;
    piece.outline.edges = std::move(joined);
    for (const auto& line : source.at("internal_lines")) {
      InternalLine internal{line.at("name"), {}, {}};
      const auto& p = line.at("points");
      for (std::size_t i = 0; i + 1 < p.size(); ++i)
        internal.curves.push_back(Curve::line({p[i][0].get<double>() / 1000, -p[i][1].get<double>() / 1000},
                                              {p[i + 1][0].get<double>() / 1000, -p[i + 1][1].get<double>() / 1000}));
      piece.lines.push_back(std::move(internal));
    }
    auto good = checked(piece.outline);
    if (!good) continue;
    piece.outline = *good;
    out.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece));
  }
  return out;
}

// Three to five pieces with lines, cubics and arcs, posed anywhere; a tube seam, a seam over two spans, an eased one.
inline Pattern random(unsigned seed) {
  std::mt19937 engine(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  Pattern out;
  const int count = 3 + static_cast<int>(engine() % 3);
  for (int n = 0; n < count; ++n) {
    Piece piece;
    piece.id = madeBy<PieceId>(7, static_cast<std::uint32_t>(n));
    piece.name = "piece " + std::to_string(n);
    const std::size_t corners = 4 + engine() % 4;
    std::vector<Flat> points;
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = 2 * M_PI * (static_cast<double>(k) + uniform(-0.2, 0.2)) / static_cast<double>(corners),
                   radius = uniform(0.15, 0.3);
      points.push_back({radius * std::cos(angle) + uniform(0, 0.01), radius * std::sin(angle)});
    }
    for (std::size_t k = 0; k < corners; ++k) {
      const Flat a = points[k], b = points[(k + 1) % corners], along = b - a;
      Curve curve = Curve::line(a, b);
      if (engine() % 3 == 1)
        curve = Curve::cubic(a, a + along * 0.3 + leftOf(along) * uniform(-0.1, 0.1),
                             a + along * 0.7 + leftOf(along) * uniform(-0.1, 0.1), b);
      else if (engine() % 3 == 1)
        curve = Curve::arc(a, b, uniform(-0.15, 0.15));
      else if (engine() % 2 == 1) {  // a chain, smooth at its joint
        const Flat joint = lerp(a, b, 0.4) + leftOf(along) * uniform(-0.06, 0.06);
        const Curve chain[] = {Curve::cubic(a, lerp(a, joint, 0.4), joint - along * 0.15, joint),
                               Curve::cubic(joint, joint + along * 0.2, lerp(joint, b, 0.7), b)};
        curve = Curve::joined(chain);
      }
      piece.outline.edges.push_back({"side_" + std::to_string(k), curve});
    }
    const Flat hole{0.02, 0.01};
    piece.holes.push_back({{{"hole_a", Curve::arc(hole - Flat{0.01, 0}, hole + Flat{0.01, 0}, 1)},
                            {"hole_b", Curve::arc(hole + Flat{0.01, 0}, hole - Flat{0.01, 0}, 1)}}});
    piece.lines.push_back(
        {"pocket", {Curve::line({-0.05, 0}, {-0.02, 0.03}), Curve::line({-0.02, 0.03}, {-0.02, -0.03})}, {}});
    piece.marks.push_back({"a notch", "side_1", uniform(0.1, 0.9), {}});
    piece.marks.push_back({"a button", "", 0, {uniform(-0.05, 0.05), uniform(-0.05, 0.05)}});
    const double turn = uniform(0, 2 * M_PI);
    piece.grain = {std::cos(turn), std::sin(turn)};
    piece.fabric = n % 2 ? "wool" : "cotton";
    piece.layer = n;
    piece.pose = turnAbout({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}, uniform(-3, 3));
    piece.pose.carry = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    out.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece));
  }
  const auto id = [](std::uint32_t n) { return madeBy<PieceId>(7, n); };
  const auto seam = [&](std::uint32_t n, std::vector<EdgeSpan> a, std::vector<EdgeSpan> b, bool reversed) {
    const SeamId key = madeBy<SeamId>(8, n);
    out.seams[key] = {key, "seam " + std::to_string(n), std::move(a), std::move(b), reversed, Seam::Tie::OneToOne};
  };
  seam(0, {{id(0), "side_0", 0, 1}}, {{id(0), "side_2", 0, 1}}, true);
  seam(1, {{id(0), "side_1", uniform(0.1, 0.3), 1}}, {{id(1), "side_0", 0, 1}, {id(1), "side_1", 0, uniform(0.4, 0.9)}},
       true);
  seam(2, {{id(1), "side_2", 0, 1}, {id(1), "side_3", 0, 1}}, {{id(2), "side_0", 0, 1}}, false);
  return out;
}

// The same pieces (by name) with the same edges, every edge's length within `close` metres.
inline std::string difference(const Pattern& a, const Pattern& b, double close) {
  if (a.pieces.size() != b.pieces.size()) return "other number of pieces";
  std::map<std::string, const Piece*> named;
  for (const auto& [id, piece] : b.pieces) named[piece->name] = piece.get();
  for (const auto& [id, piece] : a.pieces) {
    if (!named.contains(piece->name)) return "no piece " + piece->name;
    const Piece& other = *named[piece->name];
    if (piece->outline.edges.size() != other.outline.edges.size()) return piece->name + ": other number of edges";
    for (std::size_t i = 0; i < piece->outline.edges.size(); ++i) {
      const Edge &x = piece->outline.edges[i], &y = other.outline.edges[i];
      if (x.name != y.name) return piece->name + ": " + x.name + " became " + y.name;
      if (std::abs(x.curve.length() - y.curve.length()) > close) return piece->name + "." + x.name + ": other length";
      if (distance(x.curve.at(0.4), y.curve.at(0.4)) > close) return piece->name + "." + x.name + ": elsewhere";
    }
  }
  return {};
}

}  // namespace karinui::test
