#include "cloth/coarse_space.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr double kEach = 8;   // fine lines from one coarse line to the next, about; but of very fine cloth
constexpr double kMost = 22;  // so many that a square has this many coarse cells a side: more of them serve worse
constexpr double kLeastSupport = 0.05;  // fine nodes: a coarse one that moves less is left out

// What two coarse rows feel of a fine one.
KARINUI_WIDE void share(std::size_t count, const float next, const float* __restrict r, const float* __restrict free,
                        float* __restrict here, float* __restrict above) {
  for (std::size_t k = 0; k < count; ++k) {
    const float own = free[k] * r[k];
    here[k] += (1 - next) * own;
    above[k] += next * own;
  }
}

// A coarse row at each fine column from one coarse line to the next, and some more.
KARINUI_WIDE void alongCell(std::size_t begin, std::size_t end, float here, float there, const float* __restrict next,
                            float* __restrict row) {
  for (std::size_t i = begin; i < end; i += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) row[i + l] = (1 - next[i + l]) * here + next[i + l] * there;
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

KARINUI_WIDE void turnLoose(std::size_t begin, std::size_t end, float beta, const float* __restrict z,
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
  next.resize(next.size() + kLanes, 0);
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
    if (panel != plan.panels.end()) netOf_.push_back(static_cast<std::uint32_t>(nets_.size()));
    if (cloth.pieces[p].live) addNet(cloth.pieces[p], panel == plan.panels.end() ? nullptr : &*panel);
  }
  for (auto& axis : value_) axis.assign(nodes_, 0);
  for (const SlotPart& part : plan.parts) felt_.push_back(reachOf(part));
}

std::pair<std::uint32_t, std::uint32_t> CoarseSpace::coarseRows(const SlotPart& part) const {
  const std::vector<std::uint32_t>& cell = nets_[netOf_[part.panel]].row.cell;
  const std::uint32_t first = cell[part.row];
  return {first, cell[part.row + part.rows - 1] + 2 - first};
}

CoarseSpace::Felt CoarseSpace::reachOf(const SlotPart& part) const {
  Felt felt;
  if (!part.loose()) {
    const Net& net = nets_[netOf_[part.panel]];
    const auto [first, count] = coarseRows(part);
    felt.first = net.first + first * net.columns();
    felt.count = count * net.columns();
  } else {
    std::uint32_t least = nodes_, most = 0;
    for (std::size_t slot = part.begin; slot < part.end; ++slot)
      for (const Share& share : shares_[slot])
        if (share.weight > 0) {
          least = std::min(least, share.node);
          most = std::max(most, share.node);
        }
    felt.first = std::min(least, most);
    felt.count = least > most ? 0 : most - least + 1;
  }
  felt.value.assign(3 * std::size_t{felt.count}, 0);
  return felt;
}

void CoarseSpace::addNet(const ClothPiece& piece, const Panel* panel) {
  const Lattice& lattice = *piece.lattice;
  const double each = std::fmax(kEach, std::sqrt(1.0 * lattice.columns * lattice.rows) / kMost);
  Net net{panel, Lines(lattice.columns, each), Lines(lattice.rows, each), nodes_};
  nodes_ += net.columns() * net.rows();
  const double weftStep = panel ? panel->weftStep : lattice.spacing,
               warpStep = panel ? panel->warpStep : lattice.spacing;
  Flat origin = lattice.nodes.front();  // of the grid; a piece too narrow for one has a net of one cell
  for (std::uint32_t j = 0; j < lattice.rows; ++j)
    for (std::uint32_t i = 0; i < lattice.columns; ++i)
      if (const std::uint32_t k = lattice.grid[std::size_t{j} * lattice.columns + i]; k != kNoNode) {
        origin = lattice.nodes[k] - lattice.weft * (i * weftStep) - lattice.warp * (j * warpStep);
      }
  for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
    const std::uint32_t slot = plan_.slotOf[piece.firstNode + k];
    const Flat at = lattice.nodes[k] - origin;
    shares_[slot] = sharesAt(net, dot(at, lattice.weft) / weftStep, dot(at, lattice.warp) / warpStep);
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
bool CoarseSpace::refresh(const std::function<void()>& product) {
  if (!numbered_) number();
  matrix_.clear();
  for (const auto& colour : colours_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (auto& values : value_) std::fill(values.begin(), values.end(), 0.0f);
      for (const std::uint32_t c : colour) value_[axis][nodeOf_[c]] = 1;
      product();
      sumUp();
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

void CoarseSpace::feel(const SlotPart& part, const Lanes3& r) {
  Felt& felt = felt_[static_cast<std::size_t>(&part - plan_.parts.data())];
  std::fill(felt.value.begin(), felt.value.end(), 0.0f);
  if (felt.count == 0) return;
  if (part.loose()) {
    for (std::size_t slot = part.begin; slot < part.end; ++slot) {
      if (free_[slot] == 0) continue;
      for (const Share& share : shares_[slot]) {
        if (share.weight == 0) continue;
        float* to = felt.value.data() + (share.node - felt.first);
        for (std::size_t axis = 0; axis < 3; ++axis) to[axis * felt.count] += share.weight * r[axis][slot];
      }
    }
    return;
  }
  const Panel& panel = plan_.panels[part.panel];
  const Net& net = nets_[netOf_[part.panel]];
  const auto [first, count] = coarseRows(part);
  thread_local std::array<std::vector<float>, 3> rows;  // the coarse rows at the fine columns, one after the other
  for (std::size_t axis = 0; axis < 3; ++axis) {
    rows[axis].assign(count * panel.columns, 0);
    for (std::size_t j = part.row; j < part.row + part.rows; ++j) {
      const std::size_t s = panel.first + j * panel.stride;
      float* here = rows[axis].data() + (net.row.cell[j] - first) * panel.columns;
      share(panel.columns, net.row.next[j], r[axis].data() + s, free_.data() + s, here, here + panel.columns);
    }
  }
  // Cell by cell: what its ends feel. The sums of all axes side by side, so that none waits for the last.
  for (std::size_t c = 0; c < count; ++c) {
    float* to = felt.value.data() + c * net.columns();
    for (std::size_t cell = 0, i = 0; cell + 1 < net.columns(); ++cell) {
      float here[3] = {}, next[3] = {};
      for (; i < panel.columns && net.column.cell[i] == cell; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float own = rows[axis][c * panel.columns + i];
          here[axis] += (1 - net.column.next[i]) * own;
          next[axis] += net.column.next[i] * own;
        }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        to[axis * felt.count + cell] += here[axis];
        to[axis * felt.count + cell + 1] += next[axis];
      }
    }
  }
}

void CoarseSpace::sumUp() {
  for (auto& value : value_) std::fill(value.begin(), value.end(), 0.0f);
  for (const Felt& felt : felt_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* from = felt.value.data() + axis * felt.count;
      float* to = value_[axis].data() + felt.first;
      for (std::size_t k = 0; k < felt.count; ++k) to[k] += from[k];
    }
}

double CoarseSpace::answer() {
  sumUp();
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

void CoarseSpace::turn(const SlotPart& part, const Lanes3& z, float beta, Lanes3& p) const {
  if (part.loose()) {
    for (std::size_t axis = 0; axis < 3; ++axis) turnLoose(part.begin, part.end, beta, z[axis].data(), p[axis].data());
    for (std::size_t slot = part.begin; slot < part.end; ++slot) {
      if (free_[slot] == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float move = 0;
        for (const Share& share : shares_[slot]) move += share.weight * value_[axis][share.node];
        p[axis][slot] += move;
      }
    }
    return;
  }
  const Panel& panel = plan_.panels[part.panel];
  const Net& net = nets_[netOf_[part.panel]];
  const auto [first, count] = coarseRows(part);
  thread_local std::vector<float> rows;  // coarse ones at the fine columns, one after the other
  rows.resize(count * panel.stride + kLanes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < count; ++c) {
      const float* from = value_[axis].data() + net.first + (first + c) * net.columns();
      for (std::size_t cell = 0; cell + 1 < net.columns(); ++cell)
        alongCell(net.column.at[cell], net.column.at[cell + 1] + 1, from[cell], from[cell + 1], net.column.next.data(),
                  rows.data() + c * panel.stride);
    }
    for (std::size_t j = part.row; j < part.row + part.rows; ++j) {
      const std::size_t s = panel.first + j * panel.stride;
      const float* row = rows.data() + (net.row.cell[j] - first) * panel.stride;
      turnRow(panel.columns, beta, {row, row + panel.stride, 1 - net.row.next[j], net.row.next[j]}, free_.data() + s,
              z[axis].data() + s, p[axis].data() + s);
    }
  }
}

}  // namespace karinui
