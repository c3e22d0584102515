#include "cloth/panel_product.h"

#include "cloth/wide.h"

namespace karinui {
namespace {

constexpr std::size_t kRows = 8;  // of a panel a worker takes at once: what it works out on the way stays in its cache
constexpr std::size_t kTail = 1024;

struct Axes {
  const float *x, *y, *z;
};
struct Out {
  float *x, *y, *z;
};
Axes axes(const Lanes3& v) { return {v[0].data(), v[1].data(), v[2].data()}; }

struct Corners {  // of the shear between weft forth, back and warp forth, back
  float *ff, *fb, *bf, *bb;
};

// The shear of the four right angles at each node, as a force per way of the other thread.
KARINUI_WIDE void shear(std::size_t begin, std::size_t end, std::size_t stride, const Axes p, const Axes u,
                        const Axes v, const float* __restrict corner, std::size_t base, const Corners out) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const std::size_t l = s - 1, d = s - stride;
    const float x = p.x[s], y = p.y[s], z = p.z[s];
    const float rx = p.x[s + 1] - x, ry = p.y[s + 1] - y, rz = p.z[s + 1] - z;
    const float lx = x - p.x[l], ly = y - p.y[l], lz = z - p.z[l];
    const float ax = p.x[s + stride] - x, ay = p.y[s + stride] - y, az = p.z[s + stride] - z;
    const float bx = x - p.x[d], by = y - p.y[d], bz = z - p.z[d];
    const float ux = u.x[s], uy = u.y[s], uz = u.z[s], wx = u.x[l], wy = u.y[l], wz = u.z[l];
    const float vx = v.x[s], vy = v.y[s], vz = v.z[s], tx = v.x[d], ty = v.y[d], tz = v.z[d];
    const float c = corner[s];
    out.ff[s - base] = c * ((rx * vx + ry * vy + rz * vz) + (ux * ax + uy * ay + uz * az));
    out.fb[s - base] = c * ((rx * tx + ry * ty + rz * tz) + (ux * bx + uy * by + uz * bz));
    out.bf[s - base] = c * ((lx * vx + ly * vy + lz * vz) + (wx * ax + wy * ay + wz * az));
    out.bb[s - base] = c * ((lx * tx + ly * ty + lz * tz) + (wx * bx + wy * by + wz * bz));
  }
}

struct Thread {
  const float *across, *ex, *ey, *ez;
};
struct AtEnds {  // shear with the other threads at this end and at the next: with those forth and back there
  const float *forth, *back, *nextForth, *nextBack;
};

// The force each thread passes on, from slot s to s + next: its own and the shear at both its ends. `other`: from row
// to row of the threads across.
KARINUI_WIDE void threads(std::size_t begin, std::size_t end, std::size_t next, std::size_t other, const Axes p,
                          const Thread k, const Axes way, std::size_t base, const AtEnds shear, float* __restrict fx,
                          float* __restrict fy, float* __restrict fz) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const float x = p.x[s + next] - p.x[s], y = p.y[s + next] - p.y[s], z = p.z[s + next] - p.z[s];
    const float along = k.ex[s] * x + k.ey[s] * y + k.ez[s] * z;
    const std::size_t n = s + next, b = s - other, nb = n - other;
    const float f = shear.forth[s - base], g = shear.back[s - base], h = shear.nextForth[n - base],
                i = shear.nextBack[n - base];
    fx[s - base] = k.across[s] * x + along * k.ex[s] + ((f * way.x[s] + g * way.x[b]) + (h * way.x[n] + i * way.x[nb]));
    fy[s - base] = k.across[s] * y + along * k.ey[s] + ((f * way.y[s] + g * way.y[b]) + (h * way.y[n] + i * way.y[nb]));
    fz[s - base] = k.across[s] * z + along * k.ez[s] + ((f * way.z[s] + g * way.z[b]) + (h * way.z[n] + i * way.z[nb]));
  }
}

// One axis of bending: weighted second differences and twists.
KARINUI_WIDE void bends(std::size_t begin, std::size_t end, std::size_t stride, const float* __restrict p,
                        const float* __restrict weft, const float* __restrict warp, const float* __restrict twist,
                        std::size_t base, float* __restrict u, float* __restrict v, float* __restrict w) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const float twice = p[s] + p[s];
    u[s - base] = weft[s] * (p[s - 1] + p[s + 1] - twice);
    v[s - base] = warp[s] * (p[s - stride] + p[s + stride] - twice);
    w[s - base] = twist[s] * (p[s] - p[s + 1] - p[s + stride] + p[s + stride + 1]);
  }
}

struct Gathered {
  const float *fu, *fv, *u, *v, *w;  // of one axis
};

KARINUI_WIDE void gather(std::size_t begin, std::size_t end, std::size_t stride, std::size_t base, const Gathered g,
                         const float* __restrict a, const float* __restrict b, const float* __restrict c, const Axes p,
                         float* __restrict q) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const std::size_t k = s - base;
    const float own = a[s] * p.x[s] + b[s] * p.y[s] + c[s] * p.z[s];
    const float stretch = g.fu[k - 1] - g.fu[k] + g.fv[k - stride] - g.fv[k];
    const float bend = g.u[k - 1] + g.u[k + 1] + g.v[k - stride] + g.v[k + stride] - 2 * (g.u[k] + g.v[k]);
    const float twist = g.w[k] - g.w[k - 1] - g.w[k - stride] + g.w[k - stride - 1];
    q[s] = own + stretch + (bend + twist);
  }
}

KARINUI_WIDE void ownOnly(std::size_t begin, std::size_t end, const float* __restrict a, const float* __restrict b,
                          const float* __restrict c, const Axes p, float* __restrict q) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) q[s] = a[s] * p.x[s] + b[s] * p.y[s] + c[s] * p.z[s];
}

KARINUI_WIDE void dotLanes(std::size_t begin, std::size_t end, const Axes p, const Axes q, float* __restrict sum) {
  for (std::size_t s = begin; s < end; s += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l)
      sum[l] += p.x[s + l] * q.x[s + l] + p.y[s + l] * q.y[s + l] + p.z[s + l] * q.z[s + l];
}
double dotOf(std::size_t begin, std::size_t end, const Lanes3& p, const Lanes3& q) {
  float sum[kLanes] = {};
  dotLanes(begin, end, axes(p), axes(q), sum);
  double total = 0;
  for (float part : sum) total += part;
  return total;
}

constexpr std::size_t kOwn[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

// What rows pass to each other, for a band of rows and one above and below it.
struct Band {
  std::vector<float> data;
  std::size_t size = 0;
  float* at(std::size_t array) { return data.data() + array * size; }
  void fit(std::size_t slots) {
    size = slots;
    if (data.size() < 19 * size) data.assign(19 * size, 0);
  }
};

}  // namespace

double multiplyPanels(const PanelPlan& plan, const PanelStiffness& k, const PanelBending& bending, const OwnBlocks& own,
                      const Lanes3& p, Lanes3& q, Workers& workers) {
  double product = 0;
  const Axes from = axes(p);
  std::size_t tail = 0;
  for (const Panel& panel : plan.panels) {
    const std::size_t stride = panel.stride;
    tail = panel.first + panel.rows * stride;
    product += workers.sum(panel.rows, kRows, [&](std::size_t begin, std::size_t end) {
      thread_local Band band;
      const std::size_t first = panel.first + begin * stride, last = panel.first + end * stride;
      const std::size_t base = first - stride - kLanes;  // one row above, and room for the slot before it
      band.fit(last + stride + kLanes - base);
      const Corners corners{band.at(0), band.at(1), band.at(2), band.at(3)};
      shear(first - stride, last + stride, stride, from, axes(k.weftWay), axes(k.warpWay), k.corner.data(), base,
            corners);
      float *fu[] = {band.at(4), band.at(5), band.at(6)}, *fv[] = {band.at(7), band.at(8), band.at(9)};
      threads(first, last, 1, stride, from,
              {k.weftAcross.data(), k.weftAlong[0].data(), k.weftAlong[1].data(), k.weftAlong[2].data()},
              axes(k.warpWay), base, {corners.ff, corners.fb, corners.bf, corners.bb}, fu[0], fu[1], fu[2]);
      threads(first - stride, last, stride, 1, from,
              {k.warpAcross.data(), k.warpAlong[0].data(), k.warpAlong[1].data(), k.warpAlong[2].data()},
              axes(k.weftWay), base, {corners.ff, corners.bf, corners.fb, corners.bb}, fv[0], fv[1], fv[2]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float *u = band.at(10 + 3 * axis), *v = band.at(11 + 3 * axis), *w = band.at(12 + 3 * axis);
        bends(first - stride, last + stride, stride, p[axis].data(), bending.weft.data(), bending.warp.data(),
              bending.twist.data(), base, u, v, w);
        fu[axis][first - 1 - base] = 0;  // before the first column: no thread, no cell
        w[first - stride - 1 - base] = 0;
        gather(first, last, stride, base, {fu[axis], fv[axis], u, v, w}, own[kOwn[axis][0]].data(),
               own[kOwn[axis][1]].data(), own[kOwn[axis][2]].data(), from, q[axis].data());
      }
      return dotOf(first, last, p, q);
    });
  }
  // What is no panel: all slots after the last one's rows (those between panels hold nothing).
  tail = tail / kLanes * kLanes;
  const std::size_t rest = plan.slots - kLanes - tail;
  product += workers.sum(rest, kTail, [&](std::size_t begin, std::size_t end) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      ownOnly(tail + begin, tail + end, own[kOwn[axis][0]].data(), own[kOwn[axis][1]].data(), own[kOwn[axis][2]].data(),
              from, q[axis].data());
    return dotOf(tail + begin, tail + end, p, q);
  });
  return product;
}

void addDiagonals(const PanelPlan& plan, const PanelStiffness& k, const PanelBending& bending, OwnBlocks& own,
                  Workers& workers) {
  for (const Panel& panel : plan.panels)
    workers.forBlocks(panel.rows * panel.stride, kTail, [&](std::size_t begin, std::size_t end) {
      const std::size_t stride = panel.stride;
      for (std::size_t s = panel.first + begin; s < panel.first + end; ++s) {
        float block[6] = {};
        const auto across = [&](float a) {
          block[0] += a;
          block[3] += a;
          block[5] += a;
        };
        const auto along = [&](float scale, float x, float y, float z) {
          block[0] += scale * x * x;
          block[1] += scale * x * y;
          block[2] += scale * x * z;
          block[3] += scale * y * y;
          block[4] += scale * y * z;
          block[5] += scale * z * z;
        };
        for (const std::size_t t : {s - 1, s}) {
          across(k.weftAcross[t]);
          along(1, k.weftAlong[0][t], k.weftAlong[1][t], k.weftAlong[2][t]);
        }
        for (const std::size_t t : {s - stride, s}) {
          across(k.warpAcross[t]);
          along(1, k.warpAlong[0][t], k.warpAlong[1][t], k.warpAlong[2][t]);
        }
        const auto by = [&](float scale, const Lanes3& way, std::size_t t) {
          along(scale, way[0][t], way[1][t], way[2][t]);
        };
        for (const std::size_t u : {s - 1, s})  // its own four right angles, in which both threads move,
          for (const std::size_t v : {s - stride, s}) {
            const float sign = (u == s) == (v == s) ? 1.0f : -1.0f;
            along(k.corner[s], k.warpWay[0][v] + sign * k.weftWay[0][u], k.warpWay[1][v] + sign * k.weftWay[1][u],
                  k.warpWay[2][v] + sign * k.weftWay[2][u]);
          }
        for (const std::size_t t : {s - 1, s + 1})  // and two of each neighbour's
          for (const std::size_t v : {t - stride, t}) by(k.corner[t], k.warpWay, v);
        for (const std::size_t t : {s - stride, s + stride})
          for (const std::size_t u : {t - 1, t}) by(k.corner[t], k.weftWay, u);
        across(4 * bending.weft[s] + bending.weft[s - 1] + bending.weft[s + 1] + 4 * bending.warp[s] +
               bending.warp[s - stride] + bending.warp[s + stride] + bending.twist[s] + bending.twist[s - 1] +
               bending.twist[s - stride] + bending.twist[s - stride - 1]);
        for (std::size_t e = 0; e < 6; ++e) own[e][s] += block[e];
      }
    });
}

}  // namespace karinui
