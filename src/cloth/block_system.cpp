#include "cloth/block_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

// What a slot of a panel, a loose one and an entry of its row weigh in an iteration.
constexpr double kPanelSlot = 35, kLooseSlot = 12, kEntry = 20;
constexpr int kLast = 10;                     // iterations by which is judged what is left,
constexpr int kLastCoarse = 4;                // with a coarse space, which
constexpr int kQuicker = 4;                   // needs so much less of them,
constexpr std::size_t kLeastForCoarse = 200;  // and is not worth its while for fewer unknowns
constexpr int kOld = 20;                      // solves with one matrix of the coarse space
constexpr double kDear = 1.4;                 // times as many iterations as when it was new,
constexpr int kFew = 10;                      // unless they are few anyway

struct Axes {
  float *x, *y, *z;
};
Axes axes(Lanes3& v) { return {v[0].data(), v[1].data(), v[2].data()}; }
struct Blocks {
  const float *a, *b, *c, *d, *e, *f;
};

KARINUI_WIDE void less(std::size_t begin, std::size_t end, float alpha, const float* __restrict q,
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

KARINUI_WIDE void turn(std::size_t begin, std::size_t end, float beta, const float* __restrict z, float* __restrict p) {
  for (std::size_t s = begin; s < end; ++s) p[s] = z[s] + beta * p[s];
}

}  // namespace

BlockSystem::BlockSystem(const Cloth& cloth, const PanelPlan& plan, PanelBending bending,
                         std::span<const NodePair> pairs, std::span<const NodeWeight> weights)
    : plan_(plan), bending_(std::move(bending)), sparse_(plan.slotOf, pairs, weights), coarse_(cloth, plan) {
  for (auto* blocks : {&own_, &inverse_})
    for (auto& array : *blocks) array.assign(plan.slots, 0);
  for (auto* lanes : {&d_, &r_, &z_, &p_, &q_})
    for (auto& axis : *lanes) axis.assign(plan.slots, 0);
  // The coarse space's answer goes before the parts and takes none from the caller's share.
  load_.assign(2, 0);
  for (const SlotPart& part : plan.parts)
    load_.push_back(load_.back() +
                    (part.loose() ? kLooseSlot : kPanelSlot) * static_cast<double>(part.end - part.begin) +
                    kEntry * static_cast<double>(sparse_.entries(part.begin, part.end)));
  sums_.assign(plan.parts.size() + 1, 0);
}

void BlockSystem::setTies(const TieMap& ties) {
  home_.assign(ties.unknowns(), kNoNode);
  guests_.clear();
  for (NodeIndex node = 0; node < plan_.slotOf.size(); ++node) {
    const auto parts = ties.parts(node);
    if (parts.size() == 1 && parts[0].weight == 1 && home_[parts[0].unknown] == kNoNode)
      home_[parts[0].unknown] = plan_.slotOf[node];
  }
  for (NodeIndex node = 0; node < plan_.slotOf.size(); ++node) {
    const std::uint32_t slot = plan_.slotOf[node];
    for (const TieMap::Part& part : ties.parts(node))
      if (home_[part.unknown] != slot) guests_.push_back({slot, home_[part.unknown], static_cast<float>(part.weight)});
  }
  free_.assign(plan_.slots, 0);
  for (std::uint32_t s : home_) free_[s] = 1;
  coarse_.setTies(home_, guests_);
}

void BlockSystem::gather(std::span<const Block3> blocks, Workers& workers) {
  couplings_.clear();
  for (auto& array : own_) std::fill(array.begin(), array.end(), 0.0f);
  sparse_.gather(blocks, own_, workers);
}

void BlockSystem::addDiagonal(std::uint32_t unknown, const Block3& block) {
  const std::uint32_t s = home_[unknown];
  constexpr std::size_t kFrom[] = {0, 1, 2, 4, 5, 8};
  for (std::size_t e = 0; e < 6; ++e) own_[e][s] += block[kFrom[e]];
}

void BlockSystem::invertDiagonal(Workers& workers) {
  OwnBlocks& sum = inverse_;
  workers.forParts(parts(), [&](std::size_t k) {
    const SlotPart& part = plan_.parts[k];
    for (std::size_t e = 0; e < 6; ++e)
      std::copy(own_[e].data() + part.begin, own_[e].data() + part.end, sum[e].data() + part.begin);
    addDiagonals(plan_, part, panels_, bending_, sum);
  });
  for (const Guest& guest : guests_)
    for (std::size_t e = 0; e < 6; ++e) sum[e][guest.home] += guest.weight * guest.weight * sum[e][guest.slot];
  for (const Coupling& c : couplings_)
    for (const TieMap::Part& part : c.parts) {
      Block3 block{};
      addStretch(block, part.weight * part.weight * c.across, part.weight * part.weight * (c.along - c.across),
                 c.normal);
      constexpr std::size_t kFrom[] = {0, 1, 2, 4, 5, 8};
      for (std::size_t e = 0; e < 6; ++e) sum[e][home_[part.unknown]] += block[kFrom[e]];
    }
  workers.forParts(parts(), [&](std::size_t k) {
    for (std::size_t s = plan_.parts[k].begin; s < plan_.parts[k].end; ++s) {
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

double BlockSystem::multiply(std::span<const Coupling> couplings, Workers& workers) {
  for (const Guest& guest : guests_)
    for (auto& axis : p_) axis[guest.slot] = 0;
  for (const Guest& guest : guests_)
    for (auto& axis : p_) axis[guest.slot] += guest.weight * axis[guest.home];
  for (const Guest& guest : guests_) sparse_.takeUp(p_, guest.slot, guest.slot + 1);
  workers.forParts(parts(), [&](std::size_t k) {
    const SlotPart& part = plan_.parts[k];
    multiplyPart(plan_, part, panels_, bending_, own_, p_, q_);
    sparse_.multiply(part.begin, part.end, q_);
    sums_[k + 1] = dotOf(part, p_, q_);
  });
  double product = std::accumulate(sums_.begin() + 1, sums_.end(), 0.0);
  for (const Coupling& c : couplings) {  // few; in order
    float move[3] = {};
    for (const TieMap::Part& part : c.parts)
      for (std::size_t axis = 0; axis < 3; ++axis)
        move[axis] += p_[axis][home_[part.unknown]] * static_cast<float>(part.weight);
    const float n[3] = {static_cast<float>(c.normal.x), static_cast<float>(c.normal.y), static_cast<float>(c.normal.z)};
    const float across = static_cast<float>(c.across);
    const float normal = static_cast<float>(c.along - c.across) * (move[0] * n[0] + move[1] * n[1] + move[2] * n[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float force = move[axis] * across + n[axis] * normal;
      product += force * move[axis];
      for (const TieMap::Part& part : c.parts) q_[axis][home_[part.unknown]] += force * static_cast<float>(part.weight);
    }
  }
  for (const Guest& guest : guests_)
    for (auto& axis : q_) axis[guest.home] += guest.weight * axis[guest.slot];
  return product;
}

// The matrix changes little from step to step; it is taken up anew when it is old or has grown dear.
bool BlockSystem::coarseReady(Workers& workers) {
  if (unknowns() < kLeastForCoarse) return false;
  const bool dear = age_ > 2 && iterations_ > kDear * iterationsWhenNew_;
  if (coarse_.ready() && age_ < kOld && !dear) return true;
  age_ = 0;
  for (auto& axis : z_) std::fill(axis.begin(), axis.end(), 0.0f);
  return coarse_.refresh([&] {
    turn(0, true, workers);
    multiply({}, workers);
    workers.forParts(parts(), [&](std::size_t k) { coarse_.feel(plan_.parts[k], q_); });
  });
}

void BlockSystem::shorten(float alpha, bool coarse, Workers& workers) {
  workers.forParts(parts(), [&](std::size_t k) {
    const SlotPart& part = plan_.parts[k];
    for (std::size_t axis = 0; axis < 3; ++axis) less(part.begin, part.end, alpha, q_[axis].data(), r_[axis].data());
    if (coarse) coarse_.feel(part, r_);
  });
}

// The coarse space's answer is one thread's work; the others go on meanwhile.
double BlockSystem::precondition(float alpha, bool coarse, Workers& workers) {
  workers.forParts(load_, [&](std::size_t k) {
    if (k == 0) {
      sums_[0] = coarse ? coarse_.answer() : 0;
      return;
    }
    const SlotPart& part = plan_.parts[k - 1];
    float lanes[kLanes] = {};
    advance(part.begin, part.end, alpha, axes(p_), axes(r_),
            {inverse_[0].data(), inverse_[1].data(), inverse_[2].data(), inverse_[3].data(), inverse_[4].data(),
             inverse_[5].data()},
            axes(d_), axes(z_), lanes);
    sums_[k] = std::accumulate(std::begin(lanes), std::end(lanes), 0.0);
  });
  return std::accumulate(sums_.begin(), sums_.end(), 0.0);
}

void BlockSystem::turn(float beta, bool coarse, Workers& workers) {
  workers.forParts(parts(), [&](std::size_t k) {
    const SlotPart& part = plan_.parts[k];
    if (coarse) {
      coarse_.turn(part, z_, beta, p_);
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis)
        karinui::turn(part.begin, part.end, beta, z_[axis].data(), p_[axis].data());
    }
    sparse_.takeUp(p_, part.begin, part.end);
  });
}

int BlockSystem::solve(std::span<const Vec3> force, const Stop& stop, const Token& token, Workers& workers,
                       std::vector<Vec3>& move) {
  const std::size_t count = unknowns();
  move.assign(count, {});
  double largest = 0;
  for (Vec3 f : force)
    largest = std::fmax(largest, std::fmax(std::fabs(f.x), std::fmax(std::fabs(f.y), std::fabs(f.z))));
  if (!(largest > 0)) return 0;
  invertDiagonal(workers);
  const bool coarse = coarseReady(workers);
  for (auto* lanes : {&d_, &r_, &p_, &q_})
    for (auto& axis : *lanes) std::fill(axis.begin(), axis.end(), 0.0f);
  for (std::size_t k = 0; k < count; ++k) {  // scaled to one, so small forces do not drown in float
    r_[0][home_[k]] = static_cast<float>(force[k].x / largest);
    r_[1][home_[k]] = static_cast<float>(force[k].y / largest);
    r_[2][home_[k]] = static_cast<float>(force[k].z / largest);
  }
  shorten(0, coarse, workers);
  double rz = precondition(0, coarse, workers);
  const double first = rz;
  turn(0, coarse, workers);
  int iteration = 0;
  // Twice the energy that each iteration still found: what is left is about what the last ones brought. The residual
  // alone would be content long before slow waves have run through the cloth.
  const int last = coarse ? kLastCoarse : kLast, least = coarse ? stop.least / kQuicker : stop.least;
  double energy = 0, lately[kLast] = {};
  const auto content = [&] {
    const double brought = std::accumulate(lately, lately + last, 0.0);
    return brought < stop.tolerance * stop.tolerance * energy;
  };
  while (iteration < stop.most && rz > 1e-12 * first && (iteration < least || !content())) {
    if (token.cancelled()) break;
    const double pq = multiply(couplings_, workers);
    if (!(pq > 0)) break;
    lately[iteration % last] = rz / pq * rz;
    energy += lately[iteration % last];
    const auto alpha = static_cast<float>(rz / pq);
    shorten(alpha, coarse, workers);
    const double next = precondition(alpha, coarse, workers);
    turn(static_cast<float>(next / rz), coarse, workers);
    rz = next;
    ++iteration;
  }
  iterations_ = iteration;
  if (age_++ == 0) iterationsWhenNew_ = std::max(iteration, kFew);
  for (std::size_t k = 0; k < count; ++k) move[k] = Vec3{d_[0][home_[k]], d_[1][home_[k]], d_[2][home_[k]]} * largest;
  return iteration;
}

std::vector<Vec3> BlockSystem::times(std::span<const Vec3> unknown, Workers& workers) {
  for (auto& axis : p_) std::fill(axis.begin(), axis.end(), 0.0f);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    p_[0][home_[k]] = static_cast<float>(unknown[k].x);
    p_[1][home_[k]] = static_cast<float>(unknown[k].y);
    p_[2][home_[k]] = static_cast<float>(unknown[k].z);
  }
  sparse_.takeUp(p_, 0, plan_.slots);
  multiply(couplings_, workers);
  std::vector<Vec3> product(unknown.size());
  for (std::size_t k = 0; k < unknown.size(); ++k) product[k] = {q_[0][home_[k]], q_[1][home_[k]], q_[2][home_[k]]};
  return product;
}

}  // namespace karinui
