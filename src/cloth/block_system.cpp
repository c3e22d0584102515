#include "cloth/block_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

// The work of an iteration on a slot of a grid block, on another one, and on an entry of its row; any unit.
constexpr double kGridSlot = 35, kOtherSlot = 12, kEntry = 20;
constexpr std::size_t kUnknownBlock = 1024;   // unknowns that a thread copies at a time
constexpr int kWindow = 10;                   // iterations whose decrease of energy estimates the error left,
constexpr int kCoarseWindow = 4;              // the same with a coarse space,
constexpr int kCoarseSpeedup = 4;             // which needs so many times fewer of them
constexpr std::size_t kLeastForCoarse = 200;  // and does not pay for fewer unknowns
constexpr int kMostSolves = 20;               // with one coarse matrix
constexpr double kMostGrowth = 1.4;           // times as many iterations as when it was new: then it is assembled anew,
constexpr int kNewSolves = 3;                 // new for the solves of a whole Newton's method, which differ,
constexpr int kFewIterations = 10;            // unless they are few anyway

struct Axes {
  float *x, *y, *z;
};
Axes axes(SlotVectors& v) { return {v[0].data(), v[1].data(), v[2].data()}; }
struct Blocks {
  const float *a, *b, *c, *d, *e, *f;
};

KARINUI_WIDE void subtractScaled(std::size_t begin, std::size_t end, float alpha, const float* __restrict q,
                                 float* __restrict r) {
  for (std::size_t s = begin; s < end; ++s) r[s] -= alpha * q[s];
}

// d += alpha p, z = M r, and r . z lane by lane.
KARINUI_WIDE void advance(std::size_t begin, std::size_t end, float alpha, const Axes p, const Axes r, const Blocks m,
                          const Axes d, const Axes z, float* __restrict sum) {
  for (std::size_t k = begin; k < end; k += kLanes) {
    KARINUI_APART
    for (std::size_t l = 0; l < kLanes; ++l) {
      const std::size_t s = k + l;
      d.x[s] += alpha * p.x[s];
      d.y[s] += alpha * p.y[s];
      d.z[s] += alpha * p.z[s];
      const float x = r.x[s], y = r.y[s], w = r.z[s];
      const float zx = m.a[s] * x + m.b[s] * y + m.c[s] * w, zy = m.b[s] * x + m.d[s] * y + m.e[s] * w,
                  zz = m.c[s] * x + m.e[s] * y + m.f[s] * w;
      z.x[s] = zx;
      z.y[s] = zy;
      z.z[s] = zz;
      sum[l] += x * zx + y * zy + w * zz;
    }
  }
}

KARINUI_WIDE void updateDirection(std::size_t begin, std::size_t end, float beta, const float* __restrict z,
                                  float* __restrict p) {
  for (std::size_t s = begin; s < end; ++s) p[s] = z[s] + beta * p[s];
}

}  // namespace

BlockSystem::BlockSystem(const Cloth& cloth, const GridLayout& layout, GridBending bending,
                         std::span<const NodePair> pairs, std::span<const NodeWeight> weights)
    : layout_(layout), bending_(std::move(bending)), sparse_(layout.slotOf, pairs, weights), coarse_(cloth, layout) {
  for (auto* blocks : {&diagonal_, &inverse_})
    for (auto& array : *blocks) array.assign(layout.slots, 0);
  for (auto* lanes : {&d_, &r_, &z_, &p_, &q_})
    for (auto& axis : *lanes) axis.assign(layout.slots, 0);
  // The coarse solve comes first and counts nothing, so that the caller's thread gets its full share of the ranges.
  load_.assign(2, 0);
  for (const SlotRange& range : layout.ranges)
    load_.push_back(load_.back() +
                    (range.unstructured() ? kOtherSlot : kGridSlot) * static_cast<double>(range.end - range.begin) +
                    kEntry * static_cast<double>(sparse_.entries(range.begin, range.end)));
  sums_.assign(layout.ranges.size() + 1, 0);
}

void BlockSystem::setTies(const TieMap& ties) {
  slotOf_.assign(ties.unknowns(), kNoNode);
  dependents_.clear();
  for (NodeIndex node = 0; node < layout_.slotOf.size(); ++node) {
    const auto terms = ties.terms(node);
    if (terms.size() == 1 && terms[0].weight == 1 && slotOf_[terms[0].unknown] == kNoNode)
      slotOf_[terms[0].unknown] = layout_.slotOf[node];
  }
  for (NodeIndex node = 0; node < layout_.slotOf.size(); ++node) {
    const std::uint32_t slot = layout_.slotOf[node];
    for (const TieMap::Term& term : ties.terms(node))
      if (slotOf_[term.unknown] != slot)
        dependents_.push_back({slot, slotOf_[term.unknown], static_cast<float>(term.weight)});
  }
  free_.assign(layout_.slots, 0);
  for (std::uint32_t s : slotOf_) free_[s] = 1;
  coarse_.setTies(slotOf_, dependents_);
}

void BlockSystem::assemble(std::span<const Block3> blocks, Workers& workers) {
  setCouplings({});
  for (auto& array : diagonal_) std::fill(array.begin(), array.end(), 0.0f);
  sparse_.assemble(blocks, diagonal_, workers);
}

void BlockSystem::addDiagonal(std::uint32_t unknown, const Block3& block) {
  const std::uint32_t s = slotOf_[unknown];
  constexpr std::size_t kFrom[] = {0, 1, 2, 4, 5, 8};
  for (std::size_t e = 0; e < 6; ++e) diagonal_[e][s] += block[kFrom[e]];
}

void BlockSystem::invertDiagonal(Workers& workers) {
  DiagonalBlocks& sum = inverse_;
  workers.forParts(rangeLoads(), [&](std::size_t k) {
    const SlotRange& range = layout_.ranges[k];
    for (std::size_t e = 0; e < 6; ++e)
      std::copy(diagonal_[e].data() + range.begin, diagonal_[e].data() + range.end, sum[e].data() + range.begin);
    addDiagonals(layout_, range, stiffness_, bending_, sum);
  });
  for (const DependentSlot& dependent : dependents_)
    for (std::size_t e = 0; e < 6; ++e)
      sum[e][dependent.independent] += dependent.weight * dependent.weight * sum[e][dependent.slot];
  couplings_.addDiagonal(sum);
  workers.forParts(rangeLoads(), [&](std::size_t k) {
    for (std::size_t s = layout_.ranges[k].begin; s < layout_.ranges[k].end; ++s) {
      const double a = sum[0][s], b = sum[1][s], c = sum[2][s], d = sum[3][s], e = sum[4][s], f = sum[5][s];
      const double A = d * f - e * e, B = c * e - b * f, C = b * e - c * d;
      const double det = a * A + b * B + c * C;
      const double scale = free_[s] && det > 1e-300 ? 1 / det : 0;
      const auto at = [&](double v) { return static_cast<float>(v * scale); };
      inverse_[0][s] = at(A);
      inverse_[1][s] = at(B);
      inverse_[2][s] = at(C);
      inverse_[3][s] = at(a * f - c * c);
      inverse_[4][s] = at(b * c - a * e);
      inverse_[5][s] = at(a * d - b * b);
    }
  });
}

void BlockSystem::setCouplings(std::span<const Coupling> couplings) {
  couplings_.set(couplings, slotOf_, layout_.slots);
}

double BlockSystem::multiply(Workers& workers) {
  for (const DependentSlot& dependent : dependents_)
    for (auto& axis : p_) axis[dependent.slot] = 0;
  for (const DependentSlot& dependent : dependents_)
    for (auto& axis : p_) axis[dependent.slot] += dependent.weight * axis[dependent.independent];
  for (const DependentSlot& dependent : dependents_) sparse_.load(p_, dependent.slot, dependent.slot + 1);
  workers.forParts(rangeLoads(), [&](std::size_t k) {
    const SlotRange& range = layout_.ranges[k];
    multiplyRange(layout_, range, stiffness_, bending_, diagonal_, p_, q_);
    sparse_.multiply(range.begin, range.end, q_);
    sums_[k + 1] = dotOf(range, p_, q_);
  });
  double product = std::accumulate(sums_.begin() + 1, sums_.end(), 0.0);
  product += couplings_.addProduct(p_, q_);
  for (const DependentSlot& dependent : dependents_)
    for (auto& axis : q_) axis[dependent.independent] += dependent.weight * axis[dependent.slot];
  return product;
}

// The matrix changes little from step to step. It is assembled anew when it is old or costs too many iterations.
bool BlockSystem::coarseMatrixReady(Workers& workers) {
  if (unknowns() < kLeastForCoarse) return false;
  const bool dear = age_ >= kNewSolves && iterations_ > kMostGrowth * iterationsWhenNew_;
  if (coarse_.ready() && age_ < kMostSolves && !dear) return true;
  age_ = 0;
  return coarse_.assemble(stepMatrix(), workers);
}

void BlockSystem::updateResidual(float alpha, bool coarse, Workers& workers) {
  workers.forParts(rangeLoads(), [&](std::size_t k) {
    const SlotRange& range = layout_.ranges[k];
    for (std::size_t axis = 0; axis < 3; ++axis)
      subtractScaled(range.begin, range.end, alpha, q_[axis].data(), r_[axis].data());
    if (coarse) coarse_.restrictResidual(range, r_);
  });
}

// The coarse solve is one thread's work; the others go on with the diagonal meanwhile.
double BlockSystem::applyPreconditioner(float alpha, bool coarse, Workers& workers) {
  workers.forParts(load_, [&](std::size_t k) {
    if (k == 0) {
      sums_[0] = coarse ? coarse_.coarseSolve() : 0;
      return;
    }
    const SlotRange& range = layout_.ranges[k - 1];
    float lanes[kLanes] = {};
    advance(range.begin, range.end, alpha, axes(p_), axes(r_),
            {inverse_[0].data(), inverse_[1].data(), inverse_[2].data(), inverse_[3].data(), inverse_[4].data(),
             inverse_[5].data()},
            axes(d_), axes(z_), lanes);
    sums_[k] = std::accumulate(std::begin(lanes), std::end(lanes), 0.0);
  });
  return std::accumulate(sums_.begin(), sums_.end(), 0.0);
}

void BlockSystem::updateDirection(float beta, bool coarse, Workers& workers) {
  workers.forParts(rangeLoads(), [&](std::size_t k) {
    const SlotRange& range = layout_.ranges[k];
    if (coarse) {
      coarse_.updateDirection(range, z_, beta, p_);
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis)
        karinui::updateDirection(range.begin, range.end, beta, z_[axis].data(), p_[axis].data());
    }
    sparse_.load(p_, range.begin, range.end);
  });
}

int BlockSystem::solve(std::span<const Vec3> force, const StoppingRule& rule, const Token& token, Workers& workers,
                       std::vector<Vec3>& move) {
  const std::size_t count = unknowns();
  move.assign(count, {});
  double largest = 0;
  for (Vec3 f : force)
    largest = std::fmax(largest, std::fmax(std::fabs(f.x), std::fmax(std::fabs(f.y), std::fabs(f.z))));
  if (!(largest > 0)) return 0;
  invertDiagonal(workers);
  const bool coarse = coarseMatrixReady(workers);
  for (auto* lanes : {&d_, &r_, &p_, &q_})
    for (auto& axis : *lanes) std::fill(axis.begin(), axis.end(), 0.0f);
  workers.forBlocks(count, kUnknownBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {  // scaled to one, so that small forces keep their digits in float
      r_[0][slotOf_[k]] = static_cast<float>(force[k].x / largest);
      r_[1][slotOf_[k]] = static_cast<float>(force[k].y / largest);
      r_[2][slotOf_[k]] = static_cast<float>(force[k].z / largest);
    }
  });
  updateResidual(0, coarse, workers);
  double rz = applyPreconditioner(0, coarse, workers);
  const double first = rz;
  updateDirection(0, coarse, workers);
  int iteration = 0;
  // Each iteration lowers the energy by alpha r.z / 2. The error left is estimated by what the last ones found
  // (Hestenes and Stiefel's formula with a delay). A rule on the residual would be met long before long waves are
  // resolved.
  const int last = coarse ? kCoarseWindow : kWindow, least = coarse ? rule.least / kCoarseSpeedup : rule.least;
  double energy = 0, recent[kWindow] = {};
  const auto converged = [&] {
    const double found = std::accumulate(recent, recent + last, 0.0);
    return found < rule.tolerance * rule.tolerance * energy;
  };
  while (iteration < rule.most && rz > 1e-12 * first && (iteration < least || !converged())) {
    if (token.cancelled()) break;
    const double pq = multiply(workers);
    if (!(pq > 0)) break;
    recent[iteration % last] = rz / pq * rz;
    if (iteration >= rule.uncounted) energy += recent[iteration % last];
    const auto alpha = static_cast<float>(rz / pq);
    updateResidual(alpha, coarse, workers);
    const double next = applyPreconditioner(alpha, coarse, workers);
    updateDirection(static_cast<float>(next / rz), coarse, workers);
    rz = next;
    ++iteration;
  }
  iterations_ = iteration;
  if (age_++ == 0) iterationsWhenNew_ = kFewIterations;
  if (age_ <= kNewSolves) iterationsWhenNew_ = std::max(iteration, iterationsWhenNew_);
  workers.forBlocks(count, kUnknownBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      move[k] = Vec3{d_[0][slotOf_[k]], d_[1][slotOf_[k]], d_[2][slotOf_[k]]} * largest;
  });
  return iteration;
}

std::vector<Vec3> BlockSystem::times(std::span<const Vec3> unknown, Workers& workers) {
  for (auto& axis : p_) std::fill(axis.begin(), axis.end(), 0.0f);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    p_[0][slotOf_[k]] = static_cast<float>(unknown[k].x);
    p_[1][slotOf_[k]] = static_cast<float>(unknown[k].y);
    p_[2][slotOf_[k]] = static_cast<float>(unknown[k].z);
  }
  sparse_.load(p_, 0, layout_.slots);
  multiply(workers);
  std::vector<Vec3> product(unknown.size());
  for (std::size_t k = 0; k < unknown.size(); ++k)
    product[k] = {q_[0][slotOf_[k]], q_[1][slotOf_[k]], q_[2][slotOf_[k]]};
  return product;
}

}  // namespace karinui
