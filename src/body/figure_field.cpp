#include "body/figure_field.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "body/tube.h"

namespace karinui {

namespace {

constexpr float kFar = 0.08f;
constexpr double kPad = 0.04;

using Values = std::vector<float>;

// A box of grid corners that may reach across the middle: x runs over … -2 -1 | 0 1 …, -1 being the mirror of 0.
struct Block {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0, z0 = 0, z1 = 0;  // half open
  Values value;
  int ny() const { return y1 - y0; }
  int nz() const { return z1 - z0; }
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(x - x0) * ny() + (y - y0)) * nz() + (z - z0);
  }
  bool has(int x, int y, int z) const { return x >= x0 && x < x1 && y >= y0 && y < y1 && z >= z0 && z < z1; }
  float at(int x, int y, int z) const { return has(x, y, z) ? value[index(x, y, z)] : kFar; }
};

Vec3 placeOf(const FieldGrid& g, int x, int y, int z) {
  return {(x + 0.5) * g.cell, g.lowY + y * g.cell, g.lowZ + z * g.cell};
}

Block blockFor(const FieldGrid& g, Vec3 low, Vec3 high) {
  const auto down = [&](double p, double origin) { return static_cast<int>(std::floor((p - kPad - origin) / g.cell)); };
  const auto up = [&](double p, double origin) {
    return static_cast<int>(std::ceil((p + kPad - origin) / g.cell)) + 1;
  };
  Block b;
  const int nx = static_cast<int>(g.nx), ny = static_cast<int>(g.ny), nz = static_cast<int>(g.nz);
  b.x0 = std::clamp(down(low.x, 0.5 * g.cell), -nx, nx);
  b.x1 = std::clamp(up(high.x, 0.5 * g.cell), -nx, nx);
  b.y0 = std::clamp(down(low.y, g.lowY), 0, ny);
  b.y1 = std::clamp(up(high.y, g.lowY), 0, ny);
  b.z0 = std::clamp(down(low.z, g.lowZ), 0, nz);
  b.z1 = std::clamp(up(high.z, g.lowZ), 0, nz);
  b.value.assign(static_cast<std::size_t>(b.x1 - b.x0) * b.ny() * b.nz(), kFar);
  return b;
}

void fill(Block& b, const FieldGrid& g, Workers& workers, const std::function<float(Vec3)>& of) {
  workers.forBlocks(static_cast<std::size_t>(b.x1 - b.x0), 1, [&](std::size_t begin, std::size_t end) {
    for (int x = b.x0 + static_cast<int>(begin); x < b.x0 + static_cast<int>(end); ++x)
      for (int y = b.y0; y < b.y1; ++y)
        for (int z = b.z0; z < b.z1; ++z) b.value[b.index(x, y, z)] = of(placeOf(g, x, y, z));
  });
}

Block tubeBlock(const FieldGrid& g, const Tube& tube, Workers& workers) {
  Vec3 low, high;
  tube.bounds(low, high);
  Block across = blockFor(g, low, high), out = across;
  std::vector<float> cap(across.value.size());
  workers.forBlocks(static_cast<std::size_t>(across.x1 - across.x0), 1, [&](std::size_t begin, std::size_t end) {
    Tube::Column column;
    for (int x = across.x0 + static_cast<int>(begin); x < across.x0 + static_cast<int>(end); ++x)
      for (int y = across.y0; y < across.y1; ++y) {
        const Vec3 foot = placeOf(g, x, y, 0);
        tube.narrow(foot.x, foot.y, column);
        for (int z = across.z0; z < across.z1; ++z) {
          const Tube::Value v = tube.at(placeOf(g, x, y, z), column);
          across.value[across.index(x, y, z)] = static_cast<float>(v.across);
          cap[across.index(x, y, z)] = static_cast<float>(v.cap);
        }
      }
  });
  // The value is a distance seen along the radius; its slope tells by how much that is too long.
  workers.forBlocks(static_cast<std::size_t>(out.x1 - out.x0), 1, [&](std::size_t begin, std::size_t end) {
    for (int x = out.x0 + static_cast<int>(begin); x < out.x0 + static_cast<int>(end); ++x)
      for (int y = out.y0; y < out.y1; ++y)
        for (int z = out.z0; z < out.z1; ++z) {
          const auto slope = [&](int dx, int dy, int dz) {
            const bool after = across.has(x + dx, y + dy, z + dz), before = across.has(x - dx, y - dy, z - dz);
            const float a = after ? across.at(x + dx, y + dy, z + dz) : across.at(x, y, z);
            const float b = before ? across.at(x - dx, y - dy, z - dz) : across.at(x, y, z);
            return (a - b) / (static_cast<float>(g.cell) * static_cast<float>(after + before));
          };
          const float sx = slope(1, 0, 0), sy = slope(0, 1, 0), sz = slope(0, 0, 1);
          const float steep = std::clamp(std::sqrt(sx * sx + sy * sy + sz * sz), 1.0f, 6.0f);
          const std::size_t i = out.index(x, y, z);
          float d = across.value[i] / steep;
          if (cap[i] > -0.02f) d = std::max(d, cap[i]);
          out.value[i] = std::clamp(d, -kFar, kFar);
        }
  });
  return out;
}

// A capsule whose radius runs from r0 to r1.
Block capsuleBlock(const FieldGrid& g, Vec3 p, Vec3 q, double r0, double r1, Workers& workers) {
  const double r = std::max(r0, r1);
  const Vec3 low{std::min(p.x, q.x) - r, std::min(p.y, q.y) - r, std::min(p.z, q.z) - r};
  const Vec3 high{std::max(p.x, q.x) + r, std::max(p.y, q.y) + r, std::max(p.z, q.z) + r};
  Block b = blockFor(g, low, high);
  fill(b, g, workers, [&](Vec3 at) {
    const double t = std::clamp(dot(at - p, q - p) / squaredLength(q - p), 0.0, 1.0);
    return std::clamp(static_cast<float>(distance(at, lerp(p, q, t)) - std::lerp(r0, r1, t)), -kFar, kFar);
  });
  return b;
}

// Joins `b` into the grid-like lookup `a` over the corners [x0, x1): a fillet of radius k where the surfaces cross,
// none where they are tangent (a shoulder does not bulge) or face each other (thighs, an arm along the ribs: no web
// between). `bFar` tells of a row (x, y) along which b is far off and without slope.
template <class A, class B, class Far, class Put>
void smoothUnion(int x0, int x1, int y0, int y1, int z0, int z1, double cell, double k, const A& a, const B& b,
                 const Far& bFar, const Put& put, Workers& workers) {
  const auto fillet = [](float va, float vb, double reach) {
    const double h = std::max(reach - std::abs(double{va} - double{vb}), 0.0) / reach;
    return static_cast<float>(h * h * reach / 4);
  };
  workers.forBlocks(static_cast<std::size_t>(std::max(0, x1 - x0)), 1, [&](std::size_t begin, std::size_t end) {
    for (int x = x0 + static_cast<int>(begin); x < x0 + static_cast<int>(end); ++x)
      for (int y = y0; y < y1; ++y) {
        const bool far = bFar(x, y);
        for (int z = z0; z < z1; ++z) {
          const float va = a(x, y, z), vb = far ? kFar : b(x, y, z);
          float joined = std::min(va, vb);
          if (std::abs(va - vb) < 2.4 * k) {
            double reach = k;
            if (!far) {
              const auto slope = [&](const auto& f) {
                return Vec3{f(x + 1, y, z) - f(x - 1, y, z), f(x, y + 1, z) - f(x, y - 1, z),
                            f(x, y, z + 1) - f(x, y, z - 1)};
              };
              const Vec3 ga = slope(a), gb = slope(b);
              const double size = std::sqrt(squaredLength(ga) * squaredLength(gb));
              const double cosine = dot(ga, gb) / std::max(size, 1e-6 * cell * cell);
              reach = std::max(k * (1 - std::min(cosine * cosine, 1.0)), 1e-5);
            }
            joined -= fillet(va, vb, reach);
          }
          put(x, y, z, joined);
        }
      }
  });
}

class FieldMaker {
 public:
  FieldMaker(FieldGrid& grid, Workers& workers) : g_(grid), workers_(workers) {}

  float at(const Values& v, int x, int y, int z) const {
    if (x < 0) x = -x - 1;
    x = std::min(x, static_cast<int>(g_.nx) - 1);
    y = std::clamp(y, 0, static_cast<int>(g_.ny) - 1);
    z = std::clamp(z, 0, static_cast<int>(g_.nz) - 1);
    return v[g_.index(x, y, z)];
  }

  // The block, then its mirror image.
  void join(const Block& b, double k) {
    joinOne([&](int x, int y, int z) { return b.at(x, y, z); }, b.x0, b.x1, b, k);
    joinOne([&](int x, int y, int z) { return b.at(-x - 1, y, z); }, -b.x1, -b.x0, b, k);
  }

  // Softens the levels from lowY to highY, each place by its share.
  void smooth(double sigma, double lowY, double highY, const std::function<float(Vec3)>& share) {
    const auto row = [&](double y) { return static_cast<int>(std::floor((y - g_.lowY) / g_.cell)); };
    const int y0 = std::clamp(row(lowY), 0, static_cast<int>(g_.ny)),
              y1 = std::clamp(row(highY) + 1, y0, static_cast<int>(g_.ny));
    const Values soft = blurred(sigma, y0, y1);
    workers_.forBlocks(g_.nx, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t x = begin; x < end; ++x)
        for (int y = y0; y < y1; ++y)
          for (std::size_t z = 0; z < g_.nz; ++z) {
            const std::size_t i = g_.index(x, static_cast<std::size_t>(y), z);
            g_.value[i] += share(g_.place(x, static_cast<std::size_t>(y), z)) * (soft[i] - g_.value[i]);
          }
    });
  }

 private:
  template <class B>
  void joinOne(const B& b, int x0, int x1, const Block& box, double k) {
    const Values before = g_.value;
    smoothUnion(
        std::max(0, x0), std::min(x1, static_cast<int>(g_.nx)), box.y0, box.y1, box.z0, box.z1, g_.cell, k,
        [&](int x, int y, int z) { return at(before, x, y, z); }, b, [](int, int) { return false; },
        [&](int x, int y, int z, float v) { g_.value[g_.index(x, y, z)] = v; }, workers_);
  }

  // A Gaussian along one axis after the other, in the levels [y0, y1).
  Values blurred(double sigma, int y0, int y1) const {
    const double s = sigma / g_.cell;
    const int reach = static_cast<int>(std::ceil(3.5 * s));
    std::vector<float> weight(reach + 1);
    double total = 0;
    for (int i = 0; i <= reach; ++i) total += (i ? 2 : 1) * std::exp(-0.5 * i * i / (s * s));
    for (int i = 0; i <= reach; ++i) weight[i] = static_cast<float>(std::exp(-0.5 * i * i / (s * s)) / total);
    const int nx = static_cast<int>(g_.nx), ny = static_cast<int>(g_.ny), nz = static_cast<int>(g_.nz);
    Values from = g_.value, to = g_.value;
    // y first, so that levels outside the range are read as they were.
    for (const int axis : {1, 0, 2}) {
      workers_.forBlocks(g_.nx, 1, [&](std::size_t begin, std::size_t end) {
        for (int x = static_cast<int>(begin); x < static_cast<int>(end); ++x)
          for (int y = y0; y < y1; ++y) {
            float* out = &to[g_.index(x, y, 0)];
            const float* here = &from[g_.index(x, y, 0)];
            for (int z = 0; z < nz; ++z) out[z] = weight[0] * here[z];
            for (int i = 1; i <= reach; ++i) {
              if (axis == 2) {
                for (int z = 0; z < nz; ++z)
                  out[z] += weight[i] * (here[std::min(z + i, nz - 1)] + here[std::max(z - i, 0)]);
                continue;
              }
              const auto row = [&](int by) {
                int rx = axis == 0 ? x + by : x;
                if (rx < 0) rx = -rx - 1;
                return &from[g_.index(std::min(rx, nx - 1), std::clamp(axis == 1 ? y + by : y, 0, ny - 1), 0)];
              };
              const float *after = row(i), *before = row(-i);
              for (int z = 0; z < nz; ++z) out[z] += weight[i] * (after[z] + before[z]);
            }
          }
      });
      std::swap(from, to);
    }
    return from;
  }

  FieldGrid& g_;
  Workers& workers_;
};

// A union of tubes that only belong together as one part (leg and foot, arm and thumb), on their common block.
Block joined(const FieldGrid& g, const Block& a, const Block& b, double k, Workers& workers) {
  Block out;
  out.x0 = std::min(a.x0, b.x0), out.x1 = std::max(a.x1, b.x1);
  out.y0 = std::min(a.y0, b.y0), out.y1 = std::max(a.y1, b.y1);
  out.z0 = std::min(a.z0, b.z0), out.z1 = std::max(a.z1, b.z1);
  out.value.assign(static_cast<std::size_t>(out.x1 - out.x0) * out.ny() * out.nz(), kFar);
  smoothUnion(
      out.x0, out.x1, out.y0, out.y1, out.z0, out.z1, g.cell, k, [&](int x, int y, int z) { return a.at(x, y, z); },
      [&](int x, int y, int z) { return b.at(x, y, z); },
      [&](int x, int y) { return x < b.x0 - 1 || x > b.x1 || y < b.y0 - 1 || y > b.y1; },
      [&](int x, int y, int z, float v) { out.value[out.index(x, y, z)] = v; }, workers);
  return out;
}

Section moved(Section s, Vec3 by, double scale) {
  s.centre += by;
  for (double& c : s.shape) c *= scale;
  return s;
}

// Stations beyond the drawn ones, so that the parts reach into each other.
std::vector<Section> torsoWithOverlap(const Figure& figure) {
  auto row = torsoSections(figure);
  row.insert(row.begin(), moved(row.front(), {0, -0.012, 0}, 0.985));
  return row;
}

std::vector<Section> legWithOverlap(const Figure& figure) {
  auto row = legSections(figure);
  const Section first = row.front();
  // Wide hips would overhang the legs: the tops move out until their outer edges agree.
  const double half = radius(figure.torso.station[0].shape, figure.torso.harmonics, 0, 1);
  const double out = std::clamp(half - (first.centre.x + radius(first.shape, figure.leg.harmonics, 0, 1)), -0.04, 0.05);
  for (Section& s : row)
    s.centre.x += out * std::clamp((s.centre.y - figure.at.knee.y) / (figure.at.crotch - figure.at.knee.y), 0.0, 1.0);
  const Section top = row.front();
  const Vec3 inward = Vec3{figure.at.hip.x, 0, figure.at.hip.z} - Vec3{top.centre.x, 0, top.centre.z};
  const double tall = figure.at.crown / 1.7;
  row.insert(row.begin(), moved(top, Vec3{0, 0.045 * tall, 0} + inward * 0.08, 0.92));
  row.insert(row.begin(), moved(top, Vec3{0, 0.10 * tall, 0} + inward * 0.3, 0.70));
  row.push_back(moved(row.back(), {0, -0.018, 0}, 0.8));
  return row;
}

std::vector<Section> armWithOverlap(const Figure& figure) {
  auto row = armSections(figure);
  const Section first = row.front();
  row.insert(row.begin(), moved(first, first.normal * -0.02, 0.965));
  row.insert(row.begin(), moved(first, first.normal * -0.05, 0.82));
  return row;
}

}  // namespace

FieldGrid fieldOf(const Figure& figure, double cell, double shift, Workers& workers) {
  const Joints& at = figure.at;
  const Tube torso(torsoWithOverlap(figure), figure.torso.harmonics), leg(legWithOverlap(figure), figure.leg.harmonics),
      arm(armWithOverlap(figure), figure.arm.harmonics), foot(footSections(figure), figure.foot.harmonics);
  Vec3 low{0, -0.03, 0}, high{0, at.crown + 0.03, 0};
  for (const Tube* tube : {&torso, &leg, &arm, &foot}) {
    Vec3 a, b;
    tube->bounds(a, b);
    high = {std::max(high.x, b.x + 0.03), std::max(high.y, b.y + 0.03), std::max(high.z, b.z + 0.03)};
    low = {0, std::min(low.y, a.y - 0.03), std::min(low.z, a.z - 0.03)};
  }
  for (const Vec3& joint : at.thumb) high.z = std::max(high.z, joint.z + 0.05);
  FieldGrid g;
  g.cell = cell;
  g.lowY = low.y + shift * cell;
  g.lowZ = low.z + shift * 0.7 * cell;
  g.nx = static_cast<std::size_t>(std::ceil(high.x / cell)) + 2;
  g.ny = static_cast<std::size_t>(std::ceil((high.y - low.y) / cell)) + 3;
  g.nz = static_cast<std::size_t>(std::ceil((high.z - low.z) / cell)) + 3;
  g.value.assign(g.nx * g.ny * g.nz, kFar);

  Block wholeLeg = joined(g, tubeBlock(g, leg, workers), tubeBlock(g, foot, workers), 0.03, workers);
  Block wholeArm = tubeBlock(g, arm, workers);
  const std::array<double, 2> thick{std::max(1.25 * figure.thumbRadius[0], 0.0125),
                                    std::max(1.25 * figure.thumbRadius[1], 0.0125)};
  const Vec3 base = at.thumb[0] * 0.6 + at.wrist * 0.4;
  const Vec3 tip = at.thumb[3] - normalized(at.thumb[3] - at.thumb[2]) * 0.010;
  wholeArm =
      joined(g, wholeArm, capsuleBlock(g, base, at.thumb[1], thick[0] * 1.25, thick[0] * 1.1, workers), 0.012, workers);
  wholeArm = joined(g, wholeArm, capsuleBlock(g, at.thumb[1], at.thumb[2], thick[0] * 1.05, thick[1], workers), 0.012,
                    workers);
  wholeArm = joined(g, wholeArm, capsuleBlock(g, at.thumb[2], tip, thick[1], thick[1] * 0.9, workers), 0.012, workers);

  FieldMaker maker(g, workers);
  const Block trunk = tubeBlock(g, torso, workers);
  workers.forBlocks(g.nx, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t x = begin; x < end; ++x)
      for (std::size_t y = 0; y < g.ny; ++y)
        for (std::size_t z = 0; z < g.nz; ++z)
          g.value[g.index(x, y, z)] = trunk.at(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
  });
  maker.join(wholeArm, 0.035);
  maker.join(wholeLeg, 0.030);
  maker.smooth(0.006, low.y, high.y, [](Vec3) { return 1.0f; });
  maker.smooth(0.013, at.crotch - 0.07, at.crotch + 0.07, [&](Vec3 p) {
    const double off = (p.y - at.crotch - 0.002) / 0.028;
    return static_cast<float>(0.9 * std::exp(-off * off));
  });
  const Armscye cut = armscye(at);
  maker.smooth(0.013, cut.through.y, at.shoulder.y + 0.12, [&](Vec3 p) {
    const double off = dot(Vec3{p.x, p.y, 0} - cut.through, cut.outward) / 0.03;
    return static_cast<float>(0.85 * std::exp(-off * off) * std::clamp((p.y - cut.through.y - 0.01) / 0.03, 0.0, 1.0));
  });
  return g;
}

}  // namespace karinui
