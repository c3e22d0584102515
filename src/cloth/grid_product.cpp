#include "cloth/grid_product.h"

#include <numeric>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

struct Axes {
  const float *x, *y, *z;
};
struct Out {
  float *x, *y, *z;
};
Axes axes(const SlotVectors& v) { return {v[0].data(), v[1].data(), v[2].data()}; }

struct Ends {  // three axes of the force on each of the four threads at a node, by what happens at its right angles
  float *weftForth[3], *weftBack[3], *warpForth[3], *warpBack[3];
};

// The shear and the stress at the four right angles at each node, as forces on its four threads.
KARINUI_WIDE void rightAngles(std::size_t begin, std::size_t end, std::size_t stride, const Axes p, const Axes u,
                              const Axes v, const float* __restrict corner, const float* const* coupling,
                              std::size_t base, const Ends out) {
  const float* __restrict kff = coupling[0];
  const float* __restrict kfb = coupling[1];
  const float* __restrict kbf = coupling[2];
  const float* __restrict kbb = coupling[3];
  float* __restrict rfx = out.weftForth[0];
  float* __restrict rfy = out.weftForth[1];
  float* __restrict rfz = out.weftForth[2];
  float* __restrict rbx = out.weftBack[0];
  float* __restrict rby = out.weftBack[1];
  float* __restrict rbz = out.weftBack[2];
  float* __restrict pfx = out.warpForth[0];
  float* __restrict pfy = out.warpForth[1];
  float* __restrict pfz = out.warpForth[2];
  float* __restrict pbx = out.warpBack[0];
  float* __restrict pby = out.warpBack[1];
  float* __restrict pbz = out.warpBack[2];
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const std::size_t l = s - 1, d = s - stride, o = s - base;
    const float x = p.x[s], y = p.y[s], z = p.z[s];
    const float rx = p.x[s + 1] - x, ry = p.y[s + 1] - y, rz = p.z[s + 1] - z;
    const float lx = x - p.x[l], ly = y - p.y[l], lz = z - p.z[l];
    const float ax = p.x[s + stride] - x, ay = p.y[s + stride] - y, az = p.z[s + stride] - z;
    const float bx = x - p.x[d], by = y - p.y[d], bz = z - p.z[d];
    const float ux = u.x[s], uy = u.y[s], uz = u.z[s], wx = u.x[l], wy = u.y[l], wz = u.z[l];
    const float vx = v.x[s], vy = v.y[s], vz = v.z[s], tx = v.x[d], ty = v.y[d], tz = v.z[d];
    const float c = corner[s];
    const float ff = c * ((rx * vx + ry * vy + rz * vz) + (ux * ax + uy * ay + uz * az));
    const float fb = c * ((rx * tx + ry * ty + rz * tz) + (ux * bx + uy * by + uz * bz));
    const float bf = c * ((lx * vx + ly * vy + lz * vz) + (wx * ax + wy * ay + wz * az));
    const float bb = c * ((lx * tx + ly * ty + lz * tz) + (wx * bx + wy * by + wz * bz));
    const float tff = kff[s], tfb = kfb[s], tbf = kbf[s], tbb = kbb[s];
    rfx[o] = (ff * vx + fb * tx) + (tff * ax + tfb * bx);
    rfy[o] = (ff * vy + fb * ty) + (tff * ay + tfb * by);
    rfz[o] = (ff * vz + fb * tz) + (tff * az + tfb * bz);
    rbx[o] = (bf * vx + bb * tx) + (tbf * ax + tbb * bx);
    rby[o] = (bf * vy + bb * ty) + (tbf * ay + tbb * by);
    rbz[o] = (bf * vz + bb * tz) + (tbf * az + tbb * bz);
    pfx[o] = (ff * ux + bf * wx) + (tff * rx + tbf * lx);
    pfy[o] = (ff * uy + bf * wy) + (tff * ry + tbf * ly);
    pfz[o] = (ff * uz + bf * wz) + (tff * rz + tbf * lz);
    pbx[o] = (fb * ux + bb * wx) + (tfb * rx + tbb * lx);
    pby[o] = (fb * uy + bb * wy) + (tfb * ry + tbb * ly);
    pbz[o] = (fb * uz + bb * wz) + (tfb * rz + tbb * lz);
  }
}

struct Thread {
  const float *across, *ex, *ey, *ez;
};

// The force of each thread from slot s to s + next: its tension and what happens at both its ends.
KARINUI_WIDE void threads(std::size_t begin, std::size_t end, std::size_t next, const Axes p, const Thread k,
                          std::size_t base, float* const* forth, float* const* back, float* __restrict fx,
                          float* __restrict fy, float* __restrict fz) {
  const float* __restrict gx = forth[0];
  const float* __restrict gy = forth[1];
  const float* __restrict gz = forth[2];
  const float* __restrict hx = back[0];
  const float* __restrict hy = back[1];
  const float* __restrict hz = back[2];
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const float x = p.x[s + next] - p.x[s], y = p.y[s + next] - p.y[s], z = p.z[s + next] - p.z[s];
    const float along = k.ex[s] * x + k.ey[s] * y + k.ez[s] * z;
    const std::size_t o = s - base, n = o + next;
    fx[o] = k.across[s] * x + along * k.ex[s] + (gx[o] + hx[n]);
    fy[o] = k.across[s] * y + along * k.ey[s] + (gy[o] + hy[n]);
    fz[o] = k.across[s] * z + along * k.ez[s] + (gz[o] + hz[n]);
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

// Six sums: xx, xy, xz, yy, yz, zz.
struct Own {
  float a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
  inline void across(float k) { a += k, d += k, f += k; }
  inline void along(float k, float x, float y, float z) {
    a += k * x * x;
    b += k * x * y;
    c += k * x * z;
    d += k * y * y;
    e += k * y * z;
    f += k * z * z;
  }
  inline void along(float k, const Axes& way, std::size_t t) { along(k, way.x[t], way.y[t], way.z[t]); }
};
struct Threads {  // what a grid block's matrix is made of
  const float *weftAcross, *warpAcross;
  Axes weftAlong, warpAlong, weftWay, warpWay;
  const float *corner, *bendWeft, *bendWarp, *twist;
  const float *forthForth, *forthBack, *backForth, *backBack;  // coupling of the right angles
};

// The diagonal: the force on each node by its own move.
KARINUI_WIDE void diagonals(std::size_t begin, std::size_t end, std::size_t stride, const Threads k,
                            float* const* own) {
  float* __restrict oa = own[0], * __restrict ob = own[1], * __restrict oc = own[2], * __restrict od = own[3], * __restrict oe = own[4], * __restrict of = own[5];
  const Axes u = k.weftWay, v = k.warpWay;
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const std::size_t l = s - 1, r = s + 1, d = s - stride, a = s + stride;
    Own sum;
    sum.across(k.weftAcross[l]);
    sum.along(1, k.weftAlong, l);
    sum.across(k.weftAcross[s]);
    sum.along(1, k.weftAlong, s);
    sum.across(k.warpAcross[d]);
    sum.along(1, k.warpAlong, d);
    sum.across(k.warpAcross[s]);
    sum.along(1, k.warpAlong, s);
    // Its own four right angles, in which both threads move,
    const float c = k.corner[s];
    sum.along(c, v.x[d] + u.x[l], v.y[d] + u.y[l], v.z[d] + u.z[l]);
    sum.along(c, v.x[s] - u.x[l], v.y[s] - u.y[l], v.z[s] - u.z[l]);
    sum.along(c, v.x[d] - u.x[s], v.y[d] - u.y[s], v.z[d] - u.z[s]);
    sum.along(c, v.x[s] + u.x[s], v.y[s] + u.y[s], v.z[s] + u.z[s]);
    sum.across(2 * (k.forthForth[s] - k.forthBack[s] - k.backForth[s] + k.backBack[s]));
    // and two of each neighbour's.
    sum.along(k.corner[l], v, l - stride);
    sum.along(k.corner[l], v, l);
    sum.along(k.corner[r], v, r - stride);
    sum.along(k.corner[r], v, r);
    sum.along(k.corner[d], u, d - 1);
    sum.along(k.corner[d], u, d);
    sum.along(k.corner[a], u, a - 1);
    sum.along(k.corner[a], u, a);
    sum.across(4 * k.bendWeft[s] + k.bendWeft[l] + k.bendWeft[r] + 4 * k.bendWarp[s] + k.bendWarp[d] + k.bendWarp[a] +
               k.twist[s] + k.twist[l] + k.twist[d] + k.twist[d - 1]);
    oa[s] += sum.a;
    ob[s] += sum.b;
    oc[s] += sum.c;
    od[s] += sum.d;
    oe[s] += sum.e;
    of[s] += sum.f;
  }
}

constexpr std::size_t kOwn[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

// Scratch: intermediate forces of a range of rows and one above and below it.
struct Band {
  std::vector<float> data;
  std::size_t size = 0;
  float* at(std::size_t array) { return data.data() + array * size; }
  void fit(std::size_t slots) {
    size = slots;
    if (data.size() < 27 * size) data.assign(27 * size, 0);
  }
};

}  // namespace

void multiplyRange(const GridLayout& layout, const SlotRange& range, const GridStiffness& k, const GridBending& bending,
                   const DiagonalBlocks& own, const SlotVectors& p, SlotVectors& q) {
  const Axes from = axes(p);
  const std::size_t first = range.begin, last = range.end;
  if (range.unstructured()) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      ownOnly(first, last, own[kOwn[axis][0]].data(), own[kOwn[axis][1]].data(), own[kOwn[axis][2]].data(), from,
              q[axis].data());
    return;
  }
  thread_local Band band;
  const std::size_t stride = layout.blocks[range.block].stride;
  const std::size_t base = first - stride - kLanes;  // one row above, and room for the slot before it
  band.fit(last + stride + kLanes - base);
  const Ends ends{{band.at(0), band.at(1), band.at(2)},
                  {band.at(3), band.at(4), band.at(5)},
                  {band.at(6), band.at(7), band.at(8)},
                  {band.at(9), band.at(10), band.at(11)}};
  const float* const coupling[4] = {k.coupling[0].data(), k.coupling[1].data(), k.coupling[2].data(),
                                    k.coupling[3].data()};
  rightAngles(first - stride, last + stride, stride, from, axes(k.weftWay), axes(k.warpWay), k.corner.data(), coupling,
              base, ends);
  float *fu[] = {band.at(12), band.at(13), band.at(14)}, *fv[] = {band.at(15), band.at(16), band.at(17)};
  threads(first, last, 1, from,
          {k.weftAcross.data(), k.weftAlong[0].data(), k.weftAlong[1].data(), k.weftAlong[2].data()}, base,
          ends.weftForth, ends.weftBack, fu[0], fu[1], fu[2]);
  threads(first - stride, last, stride, from,
          {k.warpAcross.data(), k.warpAlong[0].data(), k.warpAlong[1].data(), k.warpAlong[2].data()}, base,
          ends.warpForth, ends.warpBack, fv[0], fv[1], fv[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float *u = band.at(18 + 3 * axis), *v = band.at(19 + 3 * axis), *w = band.at(20 + 3 * axis);
    bends(first - stride, last + stride, stride, p[axis].data(), bending.weft.data(), bending.warp.data(),
          bending.twist.data(), base, u, v, w);
    fu[axis][first - 1 - base] = 0;  // before the first column: no thread, no cell
    w[first - stride - 1 - base] = 0;
    gather(first, last, stride, base, {fu[axis], fv[axis], u, v, w}, own[kOwn[axis][0]].data(),
           own[kOwn[axis][1]].data(), own[kOwn[axis][2]].data(), from, q[axis].data());
  }
}

double dotOf(const SlotRange& range, const SlotVectors& p, const SlotVectors& q) {
  float sum[kLanes] = {};
  dotLanes(range.begin, range.end, axes(p), axes(q), sum);
  return std::accumulate(std::begin(sum), std::end(sum), 0.0);
}

void addDiagonals(const GridLayout& layout, const SlotRange& range, const GridStiffness& k, const GridBending& bending,
                  DiagonalBlocks& own) {
  if (range.unstructured()) return;
  const Threads all{k.weftAcross.data(),  k.warpAcross.data(),  axes(k.weftAlong),    axes(k.warpAlong),
                    axes(k.weftWay),      axes(k.warpWay),      k.corner.data(),      bending.weft.data(),
                    bending.warp.data(),  bending.twist.data(), k.coupling[0].data(), k.coupling[1].data(),
                    k.coupling[2].data(), k.coupling[3].data()};
  float* const out[6] = {own[0].data(), own[1].data(), own[2].data(), own[3].data(), own[4].data(), own[5].data()};
  diagonals(range.begin, range.end, layout.blocks[range.block].stride, all, out);
}

}  // namespace karinui
