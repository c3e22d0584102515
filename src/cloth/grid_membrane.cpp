#include "cloth/grid_membrane.h"

#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr double kTiny = 1e-40;  // squared metres: a thread of no length has no direction

struct ThreadLoop {
  std::size_t begin, end, next;  // slots, and how far the next one along the thread is
  double step, squeeze, rise, toe, perToe, halfPerToe, firmer, firming;
};
ThreadLoop threadLoop(std::size_t begin, std::size_t end, std::size_t next, double step, const ThreadCurve& c) {
  return {begin,
          end,
          next,
          step,
          c.squeeze,
          c.stiffness - c.squeeze,
          c.toe,
          c.toe > 0 ? 1 / c.toe : 1e300,
          c.toe > 0 ? 0.5 / c.toe : 0,
          c.stiffening * c.stiffness,
          c.firming()};
}

struct Floats {
  float *x, *y, *z;
};

// Each thread's vector, its force per length of that vector, and its stiffness.
KARINUI_WIDE void evaluateThreads(const ThreadLoop loop, const double* __restrict x, const double* __restrict y,
                                  const double* __restrict z, const double* __restrict area, double* __restrict dx,
                                  double* __restrict dy, double* __restrict dz, double* __restrict t,
                                  float* __restrict across, const Floats along, const Floats way) {
  const double perStep = 1 / loop.step;
  KARINUI_APART
  for (std::size_t s = loop.begin; s < loop.end; ++s) {
    const double a = x[s + loop.next] - x[s], b = y[s + loop.next] - y[s], c = z[s + loop.next] - z[s];
    const double squared = a * a + b * b + c * c;
    const double perLength = 1 / std::sqrt(squared > kTiny ? squared : kTiny);
    const double l = squared * perLength;
    const double e = l * perStep - 1, over = e > 0 ? e : 0;
    const double bent = over < loop.toe ? over : loop.toe, straight = over - bent;
    const double firmed = straight < loop.firming ? straight : loop.firming;
    const double force = loop.squeeze * e + loop.rise * (bent * bent * loop.halfPerToe + straight) +
                         loop.firmer * firmed * (straight - 0.5 * firmed);
    const double risen = over * loop.perToe;
    const double tangent = loop.squeeze + loop.rise * (risen < 1 ? risen : 1) + loop.firmer * firmed;
    const double perThread = area[s] * perStep;
    const double pull = perThread * force * perLength;
    const double held = pull > 0 ? pull : 0;
    const double more = perThread * perStep * tangent - held;
    const double root = std::sqrt(more > 0 ? more : 0) * perLength;
    dx[s] = a;
    dy[s] = b;
    dz[s] = c;
    t[s] = pull;
    across[s] = static_cast<float>(held);
    along.x[s] = static_cast<float>(root * a);
    along.y[s] = static_cast<float>(root * b);
    along.z[s] = static_cast<float>(root * c);
    way.x[s] = static_cast<float>(a);
    way.y[s] = static_cast<float>(b);
    way.z[s] = static_cast<float>(c);
  }
}

struct Ways {  // of threads, three axes
  const double *x, *y, *z;
};
// The shear at each node of four right angles: its slopes, and its stiffness.
KARINUI_WIDE void evaluateShear(std::size_t begin, std::size_t end, std::size_t stride, double scale, ShearCurve curve,
                                const double* __restrict area, const Ways u, const Ways v, double* __restrict pp,
                                double* __restrict pm, double* __restrict mp, double* __restrict mm,
                                float* __restrict corner) {
  const double modulus = curve.modulus, cubic = curve.cubic(), square = 0.75 * curve.cubic();
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const std::size_t l = s - 1, d = s - stride;
    const double a = (u.x[s] * v.x[s] + u.y[s] * v.y[s] + u.z[s] * v.z[s]) * scale;
    const double b = (u.x[s] * v.x[d] + u.y[s] * v.y[d] + u.z[s] * v.z[d]) * scale;
    const double c = (u.x[l] * v.x[s] + u.y[l] * v.y[s] + u.z[l] * v.z[s]) * scale;
    const double e = (u.x[l] * v.x[d] + u.y[l] * v.y[d] + u.z[l] * v.z[d]) * scale;
    const double k = area[s] * modulus * scale;
    pp[s] = k * (a + cubic * a * a * a);
    pm[s] = k * (b + cubic * b * b * b);
    mp[s] = k * (c + cubic * c * c * c);
    mm[s] = k * (e + cubic * e * e * e);
    corner[s] = static_cast<float>(k * scale * (1 + square * (a * a + b * b + c * c + e * e)));
  }
}

// One axis of the gradient: what the four threads at a node pull.
KARINUI_WIDE void gatherForces(std::size_t begin, std::size_t end, std::size_t stride, const double* __restrict u,
                               const double* __restrict v, const double* __restrict tu, const double* __restrict tv,
                               const double* __restrict pp, const double* __restrict pm, const double* __restrict mp,
                               const double* __restrict mm, double* __restrict g) {
  // The force of the thread that starts at a slot: its tension, and the shear at its two ends.
  const auto weft = [&](std::size_t s) {
    return tu[s] * u[s] + pp[s] * v[s] + pm[s] * v[s - stride] + mp[s + 1] * v[s + 1] + mm[s + 1] * v[s + 1 - stride];
  };
  const auto warp = [&](std::size_t s) {
    return tv[s] * v[s] + pp[s] * u[s] + mp[s] * u[s - 1] + pm[s + stride] * u[s + stride] +
           mm[s + stride] * u[s + stride - 1];
  };
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) g[s] = weft(s - 1) - weft(s) + warp(s - stride) - warp(s);
}

Floats floats(std::array<std::vector<float>, 3>& v) { return {v[0].data(), v[1].data(), v[2].data()}; }

constexpr std::size_t kRows = 8;  // of a grid block, in one piece of work

}  // namespace

GridMembrane::GridMembrane(const Cloth& cloth, const GridLayout& layout) : layout_(layout) {
  for (const GridBlock& block : layout.blocks) {
    const ClothPiece& piece = cloth.pieces[block.piece];
    const Fabric& f = piece.fabric;
    threads_.push_back({f.weftCurve(), f.warpCurve(), {f.shear, f.shearStiffen}});
    std::vector<NodeIndex> nodes;
    for (const std::uint32_t k : piece.lattice->grid)
      if (k != kNoNode) nodes.push_back(piece.firstNode + k);
    node_.push_back(std::move(nodes));
  }
  for (auto* axes : {&x_, &du_, &dv_})
    for (auto& axis : *axes) axis.assign(layout.slots, 0);
  for (auto* array : {&tu_, &tv_, &slope_[0], &slope_[1], &slope_[2], &slope_[3]}) array->assign(layout.slots, 0);
}

void GridMembrane::evaluate(std::span<const Vec3> x, std::span<Vec3> gradient, GridStiffness& k, Workers& workers) {
  for (auto* axes : {&k.weftAlong, &k.warpAlong, &k.weftWay, &k.warpWay})
    for (auto& axis : *axes) axis.resize(layout_.slots, 0);
  for (auto* array : {&k.weftAcross, &k.warpAcross, &k.corner}) array->resize(layout_.slots, 0);
  for (std::size_t p = 0; p < layout_.blocks.size(); ++p) {
    const GridBlock& block = layout_.blocks[p];
    const Threads& t = threads_[p];
    const auto& nodes = node_[p];
    workers.forBlocks(nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const std::uint32_t s = layout_.slotOf[nodes[n]];
        x_[0][s] = x[nodes[n]].x;
        x_[1][s] = x[nodes[n]].y;
        x_[2][s] = x[nodes[n]].z;
      }
    });
    const auto slots = [&](std::size_t row) { return block.first + row * block.stride; };
    workers.forBlocks(block.rows, kRows, [&](std::size_t begin, std::size_t end) {
      evaluateThreads(threadLoop(slots(begin), slots(end), 1, block.weftStep, t.weft), x_[0].data(), x_[1].data(),
                      x_[2].data(), layout_.weftArea.data(), du_[0].data(), du_[1].data(), du_[2].data(), tu_.data(),
                      k.weftAcross.data(), floats(k.weftAlong), floats(k.weftWay));
      evaluateThreads(threadLoop(slots(begin), slots(end), block.stride, block.warpStep, t.warp), x_[0].data(),
                      x_[1].data(), x_[2].data(), layout_.warpArea.data(), dv_[0].data(), dv_[1].data(), dv_[2].data(),
                      tv_.data(), k.warpAcross.data(), floats(k.warpAlong), floats(k.warpWay));
    });
    workers.forBlocks(block.rows, kRows, [&](std::size_t begin, std::size_t end) {
      evaluateShear(slots(begin), slots(end), block.stride, 1 / (block.weftStep * block.warpStep), t.shear,
                    layout_.cornerArea.data(), {du_[0].data(), du_[1].data(), du_[2].data()},
                    {dv_[0].data(), dv_[1].data(), dv_[2].data()}, slope_[0].data(), slope_[1].data(), slope_[2].data(),
                    slope_[3].data(), k.corner.data());
    });
    workers.forBlocks(block.rows, kRows, [&](std::size_t begin, std::size_t end) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        gatherForces(slots(begin), slots(end), block.stride, du_[axis].data(), dv_[axis].data(), tu_.data(), tv_.data(),
                     slope_[0].data(), slope_[1].data(), slope_[2].data(), slope_[3].data(), x_[axis].data());
    });
    workers.forBlocks(nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const std::uint32_t s = layout_.slotOf[nodes[n]];
        gradient[nodes[n]] += Vec3{x_[0][s], x_[1][s], x_[2][s]};
      }
    });
  }
}

}  // namespace karinui
