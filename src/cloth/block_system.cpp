#include "cloth/block_system.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr std::size_t kBlock = 256;  // unknowns a worker takes at once

struct Wanted {
  std::uint32_t row, column, pair;
  float weight;
  bool constant;
};

float sum3(const Lane& a) { return a.v[0] + a.v[1] + a.v[2]; }
Lane lane(Vec3 a, double s) {
  return {Lane::Float4{static_cast<float>(a.x * s), static_cast<float>(a.y * s), static_cast<float>(a.z * s), 0}};
}

template <class Columns>
void addTo(Columns& to, const Block3& b, float w) {
  to.x.v += Lane::Float4{b[0] * w, b[3] * w, b[6] * w, 0};
  to.y.v += Lane::Float4{b[1] * w, b[4] * w, b[7] * w, 0};
  to.z.v += Lane::Float4{b[2] * w, b[5] * w, b[8] * w, 0};
}

template <class Columns>
Lane::Float4 times(const Columns& m, const Lane& p) {
  return m.x.v * p.v[0] + m.y.v * p.v[1] + m.z.v * p.v[2];
}

}  // namespace

BlockSystem::BlockSystem(const TieMap& ties, std::span<const NodePair> changing, std::span<const NodePair> constant,
                         std::span<const Block3> constantBlocks) {
  const std::size_t rows = ties.unknowns();
  std::vector<std::vector<Wanted>> wanted(rows);
  const auto want = [&](std::span<const NodePair> pairs, bool isConstant) {
    for (std::uint32_t s = 0; s < pairs.size(); ++s)
      for (const TieMap::Part& a : ties.parts(pairs[s].row))
        for (const TieMap::Part& b : ties.parts(pairs[s].column))
          wanted[a.unknown].push_back({a.unknown, b.unknown, s, static_cast<float>(a.weight * b.weight), isConstant});
  };
  want(changing, false);
  want(constant, true);
  rowStart_.assign(1, 0);
  sourceStart_.assign(1, 0);
  diagonal_.resize(rows);
  for (std::uint32_t row = 0; row < rows; ++row) {
    auto& list = wanted[row];
    list.push_back({row, row, 0, 0, true});  // the diagonal is always there
    std::stable_sort(list.begin(), list.end(), [](const Wanted& a, const Wanted& b) { return a.column < b.column; });
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k == 0 || list[k].column != list[k - 1].column) {
        if (k > 0) sourceStart_.push_back(static_cast<std::uint32_t>(source_.size()));
        if (list[k].column == row) diagonal_[row] = static_cast<std::uint32_t>(column_.size());
        column_.push_back(list[k].column);
        constant_.emplace_back();
      }
      if (!list[k].constant)
        source_.push_back({list[k].pair, list[k].weight});
      else if (list[k].weight != 0)
        addTo(constant_.back(), constantBlocks[list[k].pair], list[k].weight);
    }
    sourceStart_.push_back(static_cast<std::uint32_t>(source_.size()));
    rowStart_.push_back(static_cast<std::uint32_t>(column_.size()));
    std::vector<Wanted>().swap(list);
  }
  value_.resize(column_.size());
  inverse_.resize(rows);
  for (std::vector<Lane>* v : {&r_, &z_, &p_, &q_, &d_}) v->resize(rows);
}

void BlockSystem::gather(std::span<const Block3> changingBlocks, Workers& workers) {
  couplings_.clear();
  workers.forBlocks(value_.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      Columns sum = constant_[slot];
      for (std::uint32_t s = sourceStart_[slot]; s < sourceStart_[slot + 1]; ++s)
        addTo(sum, changingBlocks[source_[s].pair], source_[s].weight);
      value_[slot] = sum;
    }
  });
}

void BlockSystem::addDiagonal(std::uint32_t unknown, const Block3& block) {
  addTo(value_[diagonal_[unknown]], block, 1);
}

void BlockSystem::invertDiagonal(Workers& workers) {
  std::vector<Block3> extra(couplings_.empty() ? 0 : unknowns());
  for (const Coupling& c : couplings_)
    for (const TieMap::Part& part : c.parts)
      addStretch(extra[part.unknown], part.weight * part.weight * c.across,
                 part.weight * part.weight * (c.along - c.across), c.normal);
  workers.forBlocks(unknowns(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      Columns sum = value_[diagonal_[row]];
      if (!extra.empty()) addTo(sum, extra[row], 1);
      const double a = sum.x.v[0], b = sum.x.v[1], c = sum.x.v[2], d = sum.y.v[1], e = sum.y.v[2], f = sum.z.v[2];
      const double A = d * f - e * e, B = c * e - b * f, C = b * e - c * d;
      const double det = a * A + b * B + c * C;
      const double s = det > 1e-300 ? 1 / det : 0;
      const auto at = [&](double v) { return static_cast<float>(v * s); };
      inverse_[row].x.v = Lane::Float4{at(A), at(B), at(C), 0};
      inverse_[row].y.v = Lane::Float4{at(B), at(a * f - c * c), at(b * c - a * e), 0};
      inverse_[row].z.v = Lane::Float4{at(C), at(b * c - a * e), at(a * d - b * b), 0};
    }
  });
}

double BlockSystem::multiply(const std::vector<Lane>& p, std::vector<Lane>& q, Workers& workers) const {
  const auto rows = [&](std::size_t begin, std::size_t end) {
    double total = 0;
    for (std::size_t row = begin; row < end; ++row) {
      Lane::Float4 sum{};
      for (std::uint32_t s = rowStart_[row]; s < rowStart_[row + 1]; ++s) sum += times(value_[s], p[column_[s]]);
      q[row].v = sum;
      total += sum3({sum * p[row].v});
    }
    return total;
  };
  double product = workers.sum(unknowns(), kBlock, rows);
  for (const Coupling& c : couplings_) {  // few; in order
    Lane::Float4 move{};
    for (const TieMap::Part& part : c.parts) move += p[part.unknown].v * static_cast<float>(part.weight);
    const Lane n = lane(c.normal, 1);
    const float across = static_cast<float>(c.across);
    const float normal = static_cast<float>(c.along - c.across) * sum3({move * n.v});
    const Lane::Float4 force = move * across + n.v * normal;
    product += sum3({force * move});
    for (const TieMap::Part& part : c.parts) q[part.unknown].v += force * static_cast<float>(part.weight);
  }
  return product;
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
  const auto precondition = [&](std::size_t begin, std::size_t end) {
    double total = 0;
    for (std::size_t k = begin; k < end; ++k) {
      z_[k].v = times(inverse_[k], r_[k]);
      total += sum3({r_[k].v * z_[k].v});
    }
    return total;
  };
  for (std::size_t k = 0; k < count; ++k) {  // scaled to one, so small forces do not drown in float
    r_[k] = lane(force[k], 1 / largest);
    d_[k] = {};
  }
  double rz = workers.sum(count, kBlock, precondition);
  const double first = rz;
  p_ = z_;
  int iteration = 0;
  while (iteration < stop.most && rz > 0 &&
         (iteration < stop.least ? rz > 1e-12 * first : rz > stop.tolerance * stop.tolerance * first)) {
    if (token.cancelled()) break;
    const double pq = multiply(p_, q_, workers);
    if (!(pq > 0)) break;
    const auto alpha = static_cast<float>(rz / pq);
    const double next = workers.sum(count, kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        d_[k].v += p_[k].v * alpha;
        r_[k].v -= q_[k].v * alpha;
      }
      return precondition(begin, end);
    });
    const auto beta = static_cast<float>(next / rz);
    rz = next;
    workers.forBlocks(count, kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) p_[k].v = z_[k].v + p_[k].v * beta;
    });
    ++iteration;
  }
  for (std::size_t k = 0; k < count; ++k) move[k] = Vec3{d_[k].v[0], d_[k].v[1], d_[k].v[2]} * largest;
  return iteration;
}

}  // namespace karinui
