#include "cloth/coarse_space.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr double kEach = 8;   // fine lines from one coarse line to the next, about; but of very fine cloth
constexpr double kMost = 22;  // so many that a square has this many coarse cells a side: more of them serve worse
constexpr double kLeastSupport = 0.05;  // fine nodes: a coarse one that moves less is left out
constexpr std::uint32_t kRows = 16;     // a worker takes at once,
constexpr std::uint32_t kCoarseRows = 2;
constexpr std::size_t kTail = 2048;  // slots a worker takes at once

KARINUI_WIDE void addScaled(std::size_t count, float scale, const float* __restrict from, const float* __restrict free,
                            float* __restrict to) {
  for (std::size_t k = 0; k < count; ++k) to[k] += scale * free[k] * from[k];
}

struct Blend {  // of two coarse rows
  const float *one, *other;
  float here, next;
};
KARINUI_WIDE void turnRow(std::size_t count, float beta, const Blend rows, const float* __restrict free,
                          const float* __restrict z, float* __restrict p) {
  for (std::size_t k = 0; k < count; ++k)
    p[k] = z[k] + beta * p[k] + free[k] * (rows.here * rows.one[k] + rows.next * rows.other[k]);
}

KARINUI_WIDE void turnTail(std::size_t begin, std::size_t end, float beta, const float* __restrict z,
                           float* __restrict p) {
  for (std::size_t s = begin; s < end; ++s) p[s] = z[s] + beta * p[s];
}

void sortOnce(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

CoarseSpace::Lines::Lines(std::uint32_t fine, double each) {
  const double last = std::max(2u, fine) - 1.0, cells = std::fmax(1.0, std::round(last / each));
  for (double k = 0; k <= cells; ++k) at.push_back(static_cast<std::uint32_t>(std::lround(k * last / cells)));
  for (std::uint32_t i = 0; i < fine; ++i) {
    const auto [before, way] = place(i);
    cell.push_back(before);
    next.push_back(static_cast<float>(way));
  }
}

std::pair<std::uint32_t, double> CoarseSpace::Lines::place(double fine) const {
  std::uint32_t before = 0;
  while (before + 2 < at.size() && fine >= at[before + 1]) ++before;
  return {before, std::clamp((fine - at[before]) / (at[before + 1] - at[before]), 0.0, 1.0)};
}

CoarseSpace::CoarseSpace(const Cloth& cloth, const PanelPlan& plan) : cloth_(cloth), plan_(plan), shares_(plan.slots) {
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const auto panel =
        std::find_if(plan.panels.begin(), plan.panels.end(), [&](const Panel& q) { return q.piece == p; });
    if (cloth.pieces[p].live) addNet(cloth.pieces[p], panel == plan.panels.end() ? nullptr : &*panel);
  }
  for (auto& axis : value_) axis.assign(nodes_, 0);
  coarseRows_ = rowsOf(kCoarseRows, true);
  fineRows_ = rowsOf(kRows, false);
  std::size_t blends = 0;
  for (const Net& net : nets_) {
    firstBlend_.push_back(blends);
    if (!net.panel) continue;
    blends += std::size_t{net.rows()} * net.panel->stride;
    tail_ = net.panel->first + std::size_t{net.panel->rows} * net.panel->stride;
  }
  for (auto& axis : blend_) axis.assign(blends, 0);
}

std::vector<CoarseSpace::Rows> CoarseSpace::rowsOf(std::uint32_t atOnce, bool coarse) const {
  std::vector<Rows> all;
  for (std::uint32_t n = 0; n < nets_.size(); ++n) {
    if (!nets_[n].panel) continue;
    const std::uint32_t count = coarse ? nets_[n].rows() : nets_[n].panel->rows;
    for (std::uint32_t k = 0; k < count; k += atOnce) all.push_back({n, k, std::min(k + atOnce, count)});
  }
  return all;
}

void CoarseSpace::addNet(const ClothPiece& piece, const Panel* panel) {
  const Lattice& lattice = *piece.lattice;
  const double each = std::fmax(kEach, std::sqrt(1.0 * lattice.columns * lattice.rows) / kMost);
  Net net{panel, Lines(lattice.columns, each), Lines(lattice.rows, each), nodes_};
  nodes_ += net.columns() * net.rows();
  const double weftStep = panel ? panel->weftStep : lattice.spacing,
               warpStep = panel ? panel->warpStep : lattice.spacing;
  std::vector<std::uint8_t> onPanel(lattice.nodes.size(), 0);
  Flat origin = lattice.nodes.front();  // of the grid; a piece too narrow for one has a net of one cell
  for (std::uint32_t j = 0; j < lattice.rows; ++j)
    for (std::uint32_t i = 0; i < lattice.columns; ++i)
      if (const std::uint32_t k = lattice.grid[std::size_t{j} * lattice.columns + i]; k != kNoNode) {
        onPanel[k] = panel != nullptr;
        origin = lattice.nodes[k] - lattice.weft * (i * weftStep) - lattice.warp * (j * warpStep);
      }
  for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
    const std::uint32_t slot = plan_.slotOf[piece.firstNode + k];
    const Flat at = lattice.nodes[k] - origin;
    shares_[slot] = sharesAt(net, dot(at, lattice.weft) / weftStep, dot(at, lattice.warp) / warpStep);
    if (!onPanel[k]) loose_.push_back(slot);
  }
  nets_.push_back(std::move(net));
}

CoarseSpace::Shares CoarseSpace::sharesAt(const Net& net, double column, double row) const {
  const auto [i, u] = net.column.place(column);
  const auto [j, v] = net.row.place(row);
  const std::uint32_t here = net.first + j * net.columns() + i, above = here + net.columns();
  return {Share{here, static_cast<float>((1 - u) * (1 - v))}, Share{here + 1, static_cast<float>(u * (1 - v))},
          Share{above, static_cast<float>((1 - u) * v)}, Share{above + 1, static_cast<float>(u * v)}};
}

void CoarseSpace::setTies(std::span<const std::uint32_t> homes, std::span<const Guest> guests) {
  free_.assign(plan_.slots, 0);
  for (const std::uint32_t home : homes) free_[home] = 1;
  guests_.assign(guests.begin(), guests.end());
  numbered_ = ready_ = false;
}

void CoarseSpace::number() {
  std::vector<double> support(nodes_, 0);
  for (std::size_t slot = 0; slot < free_.size(); ++slot)
    if (free_[slot] > 0)
      for (const Share& share : shares_[slot]) support[share.node] += double{share.weight} * share.weight;
  numberOf_.assign(nodes_, kNoNode);
  nodeOf_.clear();
  for (std::uint32_t node = 0; node < nodes_; ++node)
    if (support[node] > kLeastSupport) {
      numberOf_[node] = static_cast<std::uint32_t>(nodeOf_.size());
      nodeOf_.push_back(node);
    }
  meet();
  // Renumbered so that those who feel each other have numbers near each other.
  const std::vector<std::uint32_t> near = nearNumbers(around_);
  std::vector<std::uint32_t> nodes(nodeOf_.size());
  std::vector<std::vector<std::uint32_t>> around(nodeOf_.size());
  for (std::uint32_t c = 0; c < nodeOf_.size(); ++c) {
    nodes[near[c]] = nodeOf_[c];
    numberOf_[nodeOf_[c]] = near[c];
    for (const std::uint32_t other : around_[c]) around[near[c]].push_back(near[other]);
    std::sort(around[near[c]].begin(), around[near[c]].end());
  }
  nodeOf_ = std::move(nodes);
  around_ = std::move(around);
  colour();
  std::vector<std::uint32_t> first;
  for (std::uint32_t c = 0; c < nodeOf_.size(); ++c)
    for (int axis = 0; axis < 3; ++axis) first.push_back(3 * around_[c].front());
  matrix_ = Envelope(std::move(first));
  found_.assign(3 * nodeOf_.size(), 0);
  numbered_ = true;
}

// Two meet where a face of the cloth feels both.
void CoarseSpace::meet() {
  std::vector<std::vector<std::uint32_t>> homes(plan_.slots);
  for (const Guest& guest : guests_) homes[guest.slot].push_back(guest.home);
  around_.assign(nodeOf_.size(), {});
  std::vector<std::uint32_t> felt, last;
  const auto feel = [&](std::uint32_t slot) {
    if (free_[slot] == 0) return;
    for (const Share& share : shares_[slot])
      if (share.weight > 0 && numberOf_[share.node] != kNoNode) felt.push_back(numberOf_[share.node]);
  };
  for (const ClothPiece& piece : cloth_.pieces) {
    if (!piece.live) continue;
    for (const Triangle& face : piece.lattice->faces) {
      felt.clear();
      for (const std::uint32_t k : face) {
        const std::uint32_t slot = plan_.slotOf[piece.firstNode + k];
        feel(slot);
        for (const std::uint32_t home : homes[slot]) feel(home);
      }
      sortOnce(felt);
      if (felt == last) continue;
      for (const std::uint32_t a : felt) around_[a].insert(around_[a].end(), felt.begin(), felt.end());
      last = felt;
    }
  }
  for (auto& list : around_) sortOnce(list);
}

void CoarseSpace::colour() {
  colours_.clear();
  std::vector<std::vector<std::uint8_t>> feelsOne;  // per colour and number
  for (std::uint32_t c = 0; c < nodeOf_.size(); ++c) {
    std::size_t k = 0;
    const auto clash = [&](std::uint32_t other) { return feelsOne[k][other] != 0; };
    while (k < colours_.size() && std::any_of(around_[c].begin(), around_[c].end(), clash)) ++k;
    if (k == colours_.size()) {
      colours_.emplace_back();
      feelsOne.emplace_back(nodeOf_.size(), 0);
    }
    colours_[k].push_back(c);
    for (const std::uint32_t other : around_[c]) feelsOne[k][other] = 1;
  }
}

// Each product with one move of every coarse node of a colour gives that many columns of the matrix.
bool CoarseSpace::refresh(const Product& product, Lanes3& p, const Lanes3& q, Workers& workers) {
  if (!numbered_) number();
  matrix_.clear();
  const Lanes3 nothing{std::vector<float>(plan_.slots, 0), std::vector<float>(plan_.slots, 0),
                       std::vector<float>(plan_.slots, 0)};
  for (const auto& colour : colours_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (auto& values : value_) std::fill(values.begin(), values.end(), 0.0f);
      for (const std::uint32_t c : colour) value_[axis][nodeOf_[c]] = 1;
      turn(nothing, 0, p, workers);
      product();
      gather(q, workers);
      for (const std::uint32_t c : colour)
        for (const std::uint32_t other : around_[c])
          for (std::uint32_t b = 0; b < 3; ++b) {
            // What is felt of neighbours' neighbours is shared out, alike both ways.
            const std::uint32_t i = 3 * other + b, j = 3 * c + static_cast<std::uint32_t>(axis);
            const double half = 0.5 * double{value_[b][nodeOf_[other]]};
            matrix_.at(std::max(i, j), std::min(i, j)) += i == j ? 2 * half : half;
          }
    }
  ready_ = matrix_.factor();
  return ready_;
}

void CoarseSpace::gather(const Lanes3& r, Workers& workers) {
  for (auto& value : value_) std::fill(value.begin(), value.end(), 0.0f);
  workers.forBlocks(coarseRows_.size(), 1, [&](std::size_t at, std::size_t) {
    thread_local std::vector<float> row;
    const Rows rows = coarseRows_[at];
    const Net& net = nets_[rows.net];
    const Panel& panel = *net.panel;
    for (std::size_t c = rows.begin; c < rows.end; ++c) {
      const std::size_t first = net.row.at[c > 0 ? c - 1 : 0],
                        last = net.row.at[std::min<std::size_t>(c + 1, net.rows() - 1)];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        row.assign(panel.columns, 0);
        for (std::size_t j = first; j <= last && j < panel.rows; ++j) {
          const float next = net.row.next[j];
          const float weight = net.row.cell[j] == c ? 1 - next : net.row.cell[j] + 1 == c ? next : 0;
          const std::size_t s = panel.first + j * panel.stride;
          if (weight > 0) addScaled(panel.columns, weight, r[axis].data() + s, free_.data() + s, row.data());
        }
        float* to = value_[axis].data() + net.first + c * net.columns();
        for (std::size_t i = 0; i < panel.columns; ++i) {
          const float next = net.column.next[i];
          to[net.column.cell[i]] += (1 - next) * row[i];
          to[net.column.cell[i] + 1] += next * row[i];
        }
      }
    }
  });
  for (const std::uint32_t slot : loose_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float own = free_[slot] * r[axis][slot];
      for (const Share& share : shares_[slot]) value_[axis][share.node] += share.weight * own;
    }
}

double CoarseSpace::answer(const Lanes3& r, Workers& workers) {
  gather(r, workers);
  for (std::size_t c = 0; c < nodeOf_.size(); ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) found_[3 * c + axis] = value_[axis][nodeOf_[c]];
  matrix_.solve(found_);
  double product = 0;
  for (std::size_t c = 0; c < nodeOf_.size(); ++c)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float& value = value_[axis][nodeOf_[c]];
      product += double{value} * double{found_[3 * c + axis]};
      value = found_[3 * c + axis];
    }
  for (std::uint32_t node = 0; node < nodes_; ++node)
    if (numberOf_[node] == kNoNode)
      for (auto& values : value_) values[node] = 0;
  return product;
}

void CoarseSpace::turn(const Lanes3& z, float beta, Lanes3& p, Workers& workers) {
  for (std::size_t n = 0; n < nets_.size(); ++n) {
    const Net& net = nets_[n];
    if (!net.panel) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t c = 0; c < net.rows(); ++c) {
        float* row = blend_[axis].data() + firstBlend_[n] + c * net.panel->stride;
        const float* from = value_[axis].data() + net.first + c * net.columns();
        for (std::size_t i = 0; i < net.panel->columns; ++i) {
          const float next = net.column.next[i];
          row[i] = (1 - next) * from[net.column.cell[i]] + next * from[net.column.cell[i] + 1];
        }
      }
  }
  const std::size_t rest = plan_.slots - tail_, tails = (rest + kTail - 1) / kTail;
  workers.forBlocks(fineRows_.size() + tails, 1, [&](std::size_t at, std::size_t) {
    if (at >= fineRows_.size()) {
      const std::size_t begin = tail_ + (at - fineRows_.size()) * kTail;
      for (std::size_t axis = 0; axis < 3; ++axis)
        turnTail(begin, std::min(begin + kTail, plan_.slots), beta, z[axis].data(), p[axis].data());
      return;
    }
    const Rows rows = fineRows_[at];
    const Net& net = nets_[rows.net];
    const Panel& panel = *net.panel;
    for (std::size_t j = rows.begin; j < rows.end; ++j) {
      const std::size_t s = panel.first + j * panel.stride;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float* row = blend_[axis].data() + firstBlend_[rows.net] + net.row.cell[j] * panel.stride;
        turnRow(panel.columns, beta, {row, row + panel.stride, 1 - net.row.next[j], net.row.next[j]}, free_.data() + s,
                z[axis].data() + s, p[axis].data() + s);
      }
    }
  });
  for (const std::uint32_t slot : loose_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float move = 0;
      for (const Share& share : shares_[slot]) move += share.weight * value_[axis][share.node];
      p[axis][slot] += free_[slot] * move;
    }
}

}  // namespace karinui
