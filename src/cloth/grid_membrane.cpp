#include "cloth/grid_membrane.h"

#include <cmath>

#include "cloth/membrane_stress.h"
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

// Each thread's vector, its force per length of that vector, and its stiffness along itself.
KARINUI_WIDE void evaluateThreads(const ThreadLoop loop, const double* __restrict x, const double* __restrict y,
                                  const double* __restrict z, const double* __restrict area, double* __restrict dx,
                                  double* __restrict dy, double* __restrict dz, double* __restrict t,
                                  double* __restrict stiffness, const Floats way) {
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
    dx[s] = a;
    dy[s] = b;
    dz[s] = c;
    t[s] = perThread * force * perLength;
    stiffness[s] = perThread * perStep * tangent;
    way.x[s] = static_cast<float>(a);
    way.y[s] = static_cast<float>(b);
    way.z[s] = static_cast<float>(c);
  }
}

struct Ways {  // of threads, three axes
  const double *x, *y, *z;
};
struct FourCorners {  // at each node: between weft forth, back and warp forth, back
  double *ff, *fb, *bf, *bb;
};
struct FourFloats {
  float *ff, *fb, *bf, *bb;
};
// The shear at each node of four right angles: its slopes, and its stiffness.
KARINUI_WIDE void evaluateShear(std::size_t begin, std::size_t end, std::size_t stride, double scale, ShearCurve curve,
                                const double* __restrict area, const Ways u, const Ways v, const FourCorners slope,
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
    slope.ff[s] = k * (a + cubic * a * a * a);
    slope.fb[s] = k * (b + cubic * b * b * b);
    slope.bf[s] = k * (c + cubic * c * c * c);
    slope.bb[s] = k * (e + cubic * e * e * e);
    corner[s] = static_cast<float>(k * scale * (1 + square * (a * a + b * b + c * c + e * e)));
  }
}

struct Held {  // positive stress at the right angles of a node, summed for each of its four threads
  double *weftForth, *weftBack, *warpForth, *warpBack;
};
// The positive part of the stress at each right angle. A thread's pull is shared by the right angles beside it, each by
// its area.
KARINUI_WIDE void projectStress(std::size_t begin, std::size_t end, std::size_t stride, const double* __restrict area,
                                const double* __restrict weftArea, const double* __restrict warpArea,
                                const double* __restrict tu, const double* __restrict tv, const FourCorners slope,
                                const Held held, const FourFloats coupling) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    const std::size_t l = s - 1, d = s - stride;
    const double own = area[s];
    const double uf = weftArea[s] > 0 ? tu[s] * own / weftArea[s] : 0;
    const double ub = weftArea[l] > 0 ? tu[l] * own / weftArea[l] : 0;
    const double vf = warpArea[s] > 0 ? tv[s] * own / warpArea[s] : 0;
    const double vb = warpArea[d] > 0 ? tv[d] * own / warpArea[d] : 0;
    const MembraneStress ff = positivePart({uf, slope.ff[s], vf}), fb = positivePart({uf, slope.fb[s], vb});
    const MembraneStress bf = positivePart({ub, slope.bf[s], vf}), bb = positivePart({ub, slope.bb[s], vb});
    held.weftForth[s] = ff.weft + fb.weft;
    held.weftBack[s] = bf.weft + bb.weft;
    held.warpForth[s] = ff.warp + bf.warp;
    held.warpBack[s] = fb.warp + bb.warp;
    coupling.ff[s] = static_cast<float>(ff.shear);
    coupling.fb[s] = static_cast<float>(fb.shear);
    coupling.bf[s] = static_cast<float>(bf.shear);
    coupling.bb[s] = static_cast<float>(bb.shear);
  }
}

// The stiffness of each thread across and along itself.
KARINUI_WIDE void finishThreads(std::size_t begin, std::size_t end, std::size_t next, const double* __restrict area,
                                const double* __restrict cornerArea, const Ways way, const double* __restrict t,
                                const double* __restrict stiffness, const double* __restrict forth,
                                const double* __restrict back, float* __restrict across, const Floats along) {
  KARINUI_APART
  for (std::size_t s = begin; s < end; ++s) {
    // Where no right angle is beside it, only its own pull is known.
    const double rest = area[s] - 2 * (cornerArea[s] + cornerArea[s + next]);
    const double alone = area[s] > 0 && rest > 1e-6 * area[s] && t[s] > 0 ? t[s] * rest / area[s] : 0;
    const double held = alone + forth[s] + back[s + next];
    const double squared = way.x[s] * way.x[s] + way.y[s] * way.y[s] + way.z[s] * way.z[s];
    const double more = stiffness[s] - held;
    const double root = std::sqrt((more > 0 ? more : 0) / (squared > kTiny ? squared : kTiny));
    across[s] = static_cast<float>(held);
    along.x[s] = static_cast<float>(root * way.x[s]);
    along.y[s] = static_cast<float>(root * way.y[s]);
    along.z[s] = static_cast<float>(root * way.z[s]);
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

constexpr std::size_t kRowBlock = 8;  // of a grid block, in one piece of work

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
  for (auto* array : {&tu_, &tv_, &ku_, &kv_}) array->assign(layout.slots, 0);
  for (auto* arrays : {&slope_, &held_})
    for (auto& array : *arrays) array.assign(layout.slots, 0);
}

void GridMembrane::evaluate(std::span<const Vec3> x, std::span<Vec3> gradient, GridStiffness& k, Workers& workers) {
  for (auto* axes : {&k.weftAlong, &k.warpAlong, &k.weftWay, &k.warpWay})
    for (auto& axis : *axes) axis.resize(layout_.slots, 0);
  for (auto* array : {&k.weftAcross, &k.warpAcross, &k.corner}) array->resize(layout_.slots, 0);
  for (auto& array : k.coupling) array.resize(layout_.slots, 0);
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
    const Ways u{du_[0].data(), du_[1].data(), du_[2].data()}, v{dv_[0].data(), dv_[1].data(), dv_[2].data()};
    const FourCorners slope{slope_[0].data(), slope_[1].data(), slope_[2].data(), slope_[3].data()};
    const Held held{held_[0].data(), held_[1].data(), held_[2].data(), held_[3].data()};
    const FourFloats coupling{k.coupling[0].data(), k.coupling[1].data(), k.coupling[2].data(), k.coupling[3].data()};
    workers.forBlocks(block.rows, kRowBlock, [&](std::size_t begin, std::size_t end) {
      evaluateThreads(threadLoop(slots(begin), slots(end), 1, block.weftStep, t.weft), x_[0].data(), x_[1].data(),
                      x_[2].data(), layout_.weftArea.data(), du_[0].data(), du_[1].data(), du_[2].data(), tu_.data(),
                      ku_.data(), floats(k.weftWay));
      evaluateThreads(threadLoop(slots(begin), slots(end), block.stride, block.warpStep, t.warp), x_[0].data(),
                      x_[1].data(), x_[2].data(), layout_.warpArea.data(), dv_[0].data(), dv_[1].data(), dv_[2].data(),
                      tv_.data(), kv_.data(), floats(k.warpWay));
    });
    workers.forBlocks(block.rows, kRowBlock, [&](std::size_t begin, std::size_t end) {
      evaluateShear(slots(begin), slots(end), block.stride, 1 / (block.weftStep * block.warpStep), t.shear,
                    layout_.cornerArea.data(), u, v, slope, k.corner.data());
      projectStress(slots(begin), slots(end), block.stride, layout_.cornerArea.data(), layout_.weftArea.data(),
                    layout_.warpArea.data(), tu_.data(), tv_.data(), slope, held, coupling);
    });
    workers.forBlocks(block.rows, kRowBlock, [&](std::size_t begin, std::size_t end) {
      finishThreads(slots(begin), slots(end), 1, layout_.weftArea.data(), layout_.cornerArea.data(), u, tu_.data(),
                    ku_.data(), held.weftForth, held.weftBack, k.weftAcross.data(), floats(k.weftAlong));
      finishThreads(slots(begin), slots(end), block.stride, layout_.warpArea.data(), layout_.cornerArea.data(), v,
                    tv_.data(), kv_.data(), held.warpForth, held.warpBack, k.warpAcross.data(), floats(k.warpAlong));
    });
    workers.forBlocks(block.rows, kRowBlock, [&](std::size_t begin, std::size_t end) {
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
