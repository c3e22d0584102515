#pragma once
// Small solids and a seeded stream of numbers for the tests.
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>

#include "karinui/geometry/mesh.h"

namespace karinui::test {

inline TriangleMesh box(Vec3 low, Vec3 high) {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.points.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  m.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
             {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

// A sphere by splitting an octahedron: all corners exactly on the sphere (to rounding).
inline TriangleMesh ball(Vec3 centre, double radius, int splits) {
  TriangleMesh m;
  m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int s = 0; s < splits; ++s) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, m.points.size());
      if (fresh) m.points.push_back(normalized(m.points[a] + m.points[b]));
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : m.faces) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    m.faces = std::move(finer);
  }
  for (Vec3& p : m.points) p = centre + p * radius;
  return m;
}

inline void append(TriangleMesh& to, const TriangleMesh& more) {
  const auto base = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), more.points.begin(), more.points.end());
  for (const Triangle& f : more.faces) to.faces.push_back({f[0] + base, f[1] + base, f[2] + base});
}

class Numbers {
 public:
  explicit Numbers(unsigned seed) : engine_(seed) {}
  // Uniform in [low, high), the same on every machine (unlike std::uniform_real_distribution).
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  Vec3 point(double reach) {
    const double x = between(-reach, reach), y = between(-reach, reach), z = between(-reach, reach);
    return {x, y, z};
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_()) % n; }

 private:
  std::mt19937 engine_;
};

// Only for the bodies handed to the tests: v and f lines, corners split as a fan.
inline TriangleMesh readPlainObj(const std::string& path) {
  TriangleMesh m;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec3 p;
      words >> p.x >> p.y >> p.z;
      m.points.push_back(p);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) corners.push_back(static_cast<std::uint32_t>(std::stoul(word)) - 1);
      for (std::size_t i = 2; i < corners.size(); ++i) m.faces.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return m;
}

}  // namespace karinui::test
