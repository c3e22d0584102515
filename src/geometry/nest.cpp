#include "karinui/geometry/nest.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <thread>

namespace karinui {
namespace {

constexpr double kTouch = 1e-9;       // metres; shapes may touch
constexpr double kBeside = 1e-8;      // metres; more than shapes overlap by where they touch
constexpr double kSameStripe = 1e-9;  // of the repeat: so near to a stripe a place lies on it
constexpr double kRough = 1e-4;       // shapes are grown by it, so that their chords may miss by as much
constexpr std::size_t kChains = 8;
constexpr int kAsk = 32;  // tries after which the token is asked and told
constexpr double kFar = 1e18;

// The same numbers everywhere, unlike the distributions of the standard library (SplitMix64: Steele, Lea, Flood 2014).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

struct Interval {
  double low = 0, high = 0;
};

// Sorted, and one where they overlap or nearly meet.
void merge(std::vector<Interval>& all, double near) {
  std::sort(all.begin(), all.end(), [](Interval a, Interval b) { return a.low < b.low; });
  std::size_t kept = 0;
  for (const Interval next : all)
    if (kept > 0 && next.low <= all[kept - 1].high + near)
      all[kept - 1].high = std::max(all[kept - 1].high, next.high);
    else
      all[kept++] = next;
  all.resize(kept);
}

// Where the upright line at u lies within the ring.
void addWithin(const Ring& ring, double u, std::vector<double>& crossings, std::vector<Interval>& out) {
  crossings.clear();
  for (std::size_t k = 0, before = ring.size() - 1; k < ring.size(); before = k++) {
    const Flat a = ring[before], b = ring[k];
    if ((a.u > u) != (b.u > u)) crossings.push_back(a.v + (b.v - a.v) * (u - a.u) / (b.u - a.u));
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) out.push_back({crossings[k], crossings[k + 1]});
}

// A shape in columns. Column k covers [(first + k) * width, (first + k + 1) * width] of the shape's own u.
struct Columns {
  long first = 0;
  std::vector<std::vector<Interval>> filled;
  FlatBox own;  // of the shape itself
  Ring wide;    // with half the gap
  double area = 0;
  long count() const { return static_cast<long>(filled.size()); }
};

Columns columnsOf(const NestShape& shape, double gap, double width) {
  Columns out;
  out.own = boxOf(shape.ring);
  out.area = std::abs(signedArea(shape.ring));
  out.wide = widened(shape.ring, gap / 2 + kRough);
  const FlatBox box = boxOf(out.wide);
  // Columns begin at the reference, so that shapes whose columns agree agree in their stripes.
  out.first = static_cast<long>(std::floor((box.low.u - shape.reference.u) / width));
  const long last = static_cast<long>(std::ceil((box.high.u - shape.reference.u) / width));
  out.filled.resize(static_cast<std::size_t>(std::max(1L, last - out.first)));
  const auto from = [&](long k) { return shape.reference.u + static_cast<double>(out.first + k) * width; };
  for (std::size_t i = 0, n = out.wide.size(); i < n; ++i) {
    Flat a = out.wide[i], b = out.wide[(i + 1) % n];
    if (a.u > b.u) std::swap(a, b);
    const long low = std::max(0L, static_cast<long>(std::floor((a.u - from(0)) / width)) - 1);
    const long high = std::min(out.count() - 1, static_cast<long>(std::floor((b.u - from(0)) / width)) + 1);
    for (long k = low; k <= high; ++k) {
      const double left = std::max(a.u, from(k)), right = std::min(b.u, from(k + 1));
      if (left > right) continue;
      const auto at = [&](double u) { return b.u > a.u ? a.v + (b.v - a.v) * (u - a.u) / (b.u - a.u) : a.v; };
      double v0 = at(left), v1 = at(right);
      if (b.u <= a.u) v1 = b.v;
      out.filled[static_cast<std::size_t>(k)].push_back({std::min(v0, v1), std::max(v0, v1)});
    }
  }
  std::vector<double> crossings;
  for (long k = 0; k < out.count(); ++k) {
    auto& column = out.filled[static_cast<std::size_t>(k)];
    for (const double share : {0.0, 0.5, 1.0}) addWithin(out.wide, from(k) + share * width, crossings, column);
    merge(column, 1e-3);
  }
  return out;
}

// What is forbidden to shape b beside shape a: for each difference of their columns the open intervals of the
// difference of their v.
struct Forbidden {
  long least = 0;  // difference of columns of the first row
  std::vector<std::uint32_t> begin;
  std::vector<Interval> intervals;
};

Forbidden forbidden(const Columns& a, const Columns& b) {
  Forbidden out;
  // Column i of a lies over column j of b where a.first + i == b.first + j + difference.
  out.least = a.first - b.first - (b.count() - 1);
  const long most = a.first - b.first + a.count() - 1;
  std::vector<Interval> all;
  out.begin.push_back(0);
  for (long d = out.least; d <= most; ++d) {
    all.clear();
    const long shift = b.first + d - a.first;  // i = j + shift
    for (long j = std::max(0L, -shift); j < b.count() && j + shift < a.count(); ++j)
      for (const Interval x : a.filled[static_cast<std::size_t>(j + shift)])
        for (const Interval y : b.filled[static_cast<std::size_t>(j)]) {
          const Interval no{x.low - y.high + kTouch, x.high - y.low - kTouch};
          if (no.low >= no.high) continue;
          if (!all.empty() && no.low <= all.back().high && all.back().low <= no.high)
            all.back() = {std::min(all.back().low, no.low), std::max(all.back().high, no.high)};
          else
            all.push_back(no);
        }
    merge(all, 0);
    out.intervals.insert(out.intervals.end(), all.begin(), all.end());
    out.begin.push_back(static_cast<std::uint32_t>(out.intervals.size()));
  }
  return out;
}

class Search {
 public:
  Search(const std::vector<NestShape>& shapes, const std::vector<NestItem>& items, const NestSettings& settings,
         Workers& workers)
      : shapes_(shapes), items_(items), settings_(settings) {
    width_ = settings.along > 0 ? settings.along / std::ceil(settings.along / settings.column) : settings.column;
    period_ = settings.along > 0 ? static_cast<long>(std::lround(settings.along / width_)) : 1;
    columns_.resize(shapes.size());
    workers.forBlocks(shapes.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) columns_[i] = columnsOf(shapes[i], settings.gap, width_);
    });
    for (std::size_t i = 0; i < items.size(); ++i) {
      ways_.emplace_back();
      for (const std::size_t way : items[i].ways)
        if (range(i, way)) ways_.back().push_back(way);
    }
    const std::size_t n = shapes.size();
    pairs_.resize(n * n);
    workers.forBlocks(n * n, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) pairs_[i] = forbidden(columns_[i / n], columns_[i % n]);
    });
  }

  struct Laid {
    std::size_t item = 0, way = 0;
    long column = 0;
    double v = 0;
  };
  struct Gene {  // how an item is laid
    std::size_t way = 0;
    bool far = false;  // as far across as it goes
    bool operator==(const Gene&) const = default;
  };
  struct Plan {
    std::vector<std::size_t> order;
    std::vector<Gene> genes;  // of each item
  };
  struct Found {
    Plan plan;
    std::vector<Laid> laid;  // in the plan's order
    double length = kFar, worth = kFar;
  };

  std::optional<std::size_t> homeless() const {
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (ways_[i].empty()) return i;
    return std::nullopt;
  }

  // Where the plan leads; nothing where it goes beyond `limit` along the strip. What lies before `same` in the order
  // lies as in `before`.
  std::optional<Found> lay(const Plan& plan, double limit, std::size_t same, const std::vector<Laid>& before) const {
    Found found;
    found.laid.assign(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(same));
    for (std::size_t k = same; k < plan.order.size(); ++k) {
      const std::size_t item = plan.order[k];
      const auto place = placed(item, plan.genes[item], found.laid);
      if (!place) return std::nullopt;
      found.laid.push_back(*place);
      if (endOf(*place) > limit) return std::nullopt;
    }
    double length = 0, weighed = 0, weight = 0;
    for (const Laid& laid : found.laid) {
      length = std::max(length, endOf(laid));
      weighed += columns_[laid.way].area * endOf(laid);
      weight += columns_[laid.way].area;
    }
    found.length = length;
    found.worth = length + 0.1 * (weight > 0 ? weighed / weight : 0);
    return found;
  }

  // One way of annealing, from an order of its own.
  Found chain(std::size_t nth, int tries, const Token& token, const std::function<void(int)>& tried) const {
    Dice dice(settings_.seed * 1000003 + nth);
    Plan first = beginning(nth, dice);
    Found now = *lay(first, kFar, 0, {});
    now.plan = std::move(first);
    Found best = now;
    const std::size_t n = items_.size();
    if (n == 0) return best;
    const double hot = 0.02, cold = 0.0005;
    for (int t = 0; t < tries; ++t) {
      if (t % kAsk == 0) {
        if (token.cancelled()) break;
        tried(std::min(kAsk, tries - t));
      }
      const double heat = now.worth * hot * std::pow(cold / hot, static_cast<double>(t) / std::max(1, tries));
      const double accept = now.worth - heat * std::log(std::max(1e-300, dice.share()));
      Plan next = now.plan;
      const std::size_t a = dice.below(n), b = dice.below(n);
      std::size_t same = std::min(a, b);
      const double kind = dice.share();
      if (kind < 0.35) {
        std::swap(next.order[a], next.order[b]);
      } else if (kind < 0.7) {
        const std::size_t moved = next.order[a];
        next.order.erase(next.order.begin() + static_cast<std::ptrdiff_t>(a));
        next.order.insert(next.order.begin() + static_cast<std::ptrdiff_t>(b), moved);
      } else {
        const std::size_t item = next.order[a];
        Gene& gene = next.genes[item];
        const auto& ways = ways_[item];
        if (ways.size() > 1 && dice.share() < 0.7)
          gene.way = ways[dice.below(ways.size())];
        else
          gene.far = !gene.far;
        same = a;
      }
      if (next.order == now.plan.order && next.genes == now.plan.genes) continue;
      auto found = lay(next, accept, same, now.laid);
      if (!found || found->worth > accept) continue;
      found->plan = std::move(next);
      now = *std::move(found);
      if (now.length < best.length - kTouch || (now.length < best.length + kTouch && now.worth < best.worth))
        best = now;
    }
    return best;
  }

  Nesting finished(const Found& best) const {
    Nesting out;
    out.places.resize(items_.size());
    for (const Laid& laid : best.laid)
      out.places[laid.item] = {laid.way,
                               {static_cast<double>(laid.column) * width_ - shapes_[laid.way].reference.u, laid.v}};
    if (settings_.along <= 0) slide(out);
    for (const NestPlace& place : out.places)
      out.length = std::max(out.length, columns_[place.way].own.high.u + place.at.u);
    return out;
  }

 private:
  double endOf(const Laid& laid) const {
    return columns_[laid.way].own.high.u - shapes_[laid.way].reference.u + static_cast<double>(laid.column) * width_;
  }

  // Of v, within the strip and on the stripes; nothing: there is none.
  std::optional<Interval> range(std::size_t item, std::size_t way) const {
    const FlatBox& own = columns_[way].own;
    if (items_[item].onEdge)
      return own.high.v <= settings_.width + kTouch ? std::optional(Interval{0, 0}) : std::nullopt;
    Interval all{-own.low.v, settings_.width - own.high.v};
    if (all.low > all.high + kTouch) return std::nullopt;
    // From stripe to stripe: asked for the first and for the last of them a piece has a place or has none.
    all.low = onStripe(way, all.low, false);
    if (all.low > all.high + kTouch) return std::nullopt;
    all.high = std::max(all.low, onStripe(way, all.high, true));
    return all;
  }
  // The next v from `v` on (or back) at which the shape's reference lies on a stripe.
  double onStripe(std::size_t way, double v, bool back) const {
    if (settings_.across <= 0) return v;
    const double steps = (v + shapes_[way].reference.v) / settings_.across;
    return (back ? std::floor(steps + kSameStripe) : std::ceil(steps - kSameStripe)) * settings_.across -
           shapes_[way].reference.v;
  }

  std::optional<Laid> placed(std::size_t item, Gene gene, const std::vector<Laid>& laid) const {
    const auto all = range(item, gene.way);
    if (!all) return std::nullopt;
    const Columns& own = columns_[gene.way];
    const double reference = shapes_[gene.way].reference.u;
    // The column at which the shape itself begins at 0 or later.
    long column = static_cast<long>(std::ceil((reference - own.own.low.u) / width_ - 1e-9));
    column = (column + (period_ << 20) + period_ - 1) / period_ * period_ - (period_ << 20);
    // Nothing that was laid has gone: an equal shape begins no sooner than the one before it.
    for (const Laid& other : laid)
      if (other.way == gene.way && items_[other.item].onEdge == items_[item].onEdge)
        column = std::max(column, other.column);
    const std::size_t n = columns_.size();
    std::vector<Interval> no;
    for (;; column += period_) {
      no.clear();
      for (const Laid& other : laid) {
        const Forbidden& pair = pairs_[other.way * n + gene.way];
        const long row = column - other.column - pair.least;
        if (row < 0 || row + 1 >= static_cast<long>(pair.begin.size())) continue;
        for (std::uint32_t i = pair.begin[static_cast<std::size_t>(row)];
             i < pair.begin[static_cast<std::size_t>(row) + 1]; ++i)
          no.push_back({pair.intervals[i].low + other.v, pair.intervals[i].high + other.v});
      }
      if (const auto v = free(*all, no, gene, item)) return Laid{item, gene.way, column, *v};
    }
  }

  // The least v (or the greatest) of the range outside all that is forbidden.
  std::optional<double> free(Interval all, const std::vector<Interval>& no, Gene gene, std::size_t item) const {
    const bool far = gene.far && !items_[item].onEdge;
    double v = items_[item].onEdge ? 0 : far ? all.high : all.low;
    // A stripe that onStripe() takes for the end of an interval lies at its end, or it would be left for itself for
    // ever.
    const double end = 2 * kSameStripe * settings_.across;
    for (bool moved = true; moved;) {
      if (far ? v < all.low - kTouch : v > all.high + kTouch) return std::nullopt;
      moved = false;
      for (const Interval one : no)
        if (one.low + end < v && v < one.high - end) {
          if (items_[item].onEdge) return std::nullopt;
          v = onStripe(gene.way, far ? one.low : one.high, far);
          moved = true;
        }
    }
    return v;
  }

  Plan beginning(std::size_t nth, Dice& dice) const {
    Plan plan;
    plan.order.resize(items_.size());
    std::iota(plan.order.begin(), plan.order.end(), std::size_t{0});
    const auto size = [&](std::size_t item) {
      const Columns& own = columns_[ways_[item][0]];
      const Flat box = own.own.high - own.own.low;
      // What lies on the fold comes first: only there can it lie.
      return (nth % 2 ? box.u : own.area) + (items_[item].onEdge ? 100 : 0);
    };
    std::stable_sort(plan.order.begin(), plan.order.end(),
                     [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const auto& ways = ways_[i];
      plan.genes.push_back({ways[nth < 2 ? 0 : dice.below(ways.size())], nth >= 2 && dice.share() < 0.3});
    }
    for (std::size_t swaps = nth < 2 ? 0 : nth; swaps > 0; --swaps) {
      const std::size_t a = dice.below(plan.order.size()), b = dice.below(plan.order.size());
      std::swap(plan.order[a], plan.order[b]);
    }
    return plan;
  }

  // Every piece, the foremost first, goes back along the strip until it meets another: what the columns kept apart.
  void slide(Nesting& out) const {
    std::vector<std::size_t> order(out.places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int round = 0; round < 3; ++round) {
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return out.places[a].at.u + columns_[out.places[a].way].own.low.u <
               out.places[b].at.u + columns_[out.places[b].way].own.low.u;
      });
      for (const std::size_t i : order) {
        NestPlace& place = out.places[i];
        double room = place.at.u + columns_[place.way].own.low.u;
        for (std::size_t j = 0; j < out.places.size(); ++j)
          if (j != i) room = std::min(room, roomBack(out.places[j], place));
        if (room > 1e-6) place.at.u -= room - 1e-7;
      }
    }
  }
  // How far b may go back before it meets a, beside which it lies.
  double roomBack(const NestPlace& a, const NestPlace& b) const {
    const Ring &still = columns_[a.way].wide, &moved = columns_[b.way].wide;
    const Flat between = b.at - a.at;
    const FlatBox stillBox = boxOf(still), movedBox = boxOf(moved);
    double room = kFar;
    if (stillBox.low.u > movedBox.high.u + between.u || stillBox.low.v > movedBox.high.v + between.v ||
        movedBox.low.v + between.v > stillBox.high.v)
      return room;
    const auto ask = [&](const Ring& corners, const Ring& sides, Flat shift, double sign) {
      const FlatBox& box = sign > 0 ? stillBox : movedBox;
      for (const Flat corner : corners) {
        const Flat p = corner + shift;                                          // in the space of the sides
        if (p.v < box.low.v + kBeside || p.v > box.high.v - kBeside) continue;  // side by side they do not meet
        for (std::size_t k = 0, before = sides.size() - 1; k < sides.size(); before = k++) {
          const Flat s = sides[before], e = sides[k];
          if (p.v < std::min(s.v, e.v) || p.v > std::max(s.v, e.v)) continue;
          const double at = s.v == e.v ? (sign > 0 ? std::max(s.u, e.u) : std::min(s.u, e.u))
                                       : s.u + (e.u - s.u) * (p.v - s.v) / (e.v - s.v);
          const double free = sign * (p.u - at);
          if (free >= -kTouch) room = std::min(room, std::max(0.0, free));
        }
      }
    };
    ask(moved, still, between, 1);
    ask(still, moved, -between, -1);
    return room;
  }

  const std::vector<NestShape>& shapes_;
  const std::vector<NestItem>& items_;
  const NestSettings& settings_;
  double width_ = 0.002;
  long period_ = 1;  // columns of the repeat along the strip
  std::vector<Columns> columns_;
  std::vector<std::vector<std::size_t>> ways_;  // of each item those that have a place within the width
  std::vector<Forbidden> pairs_;
};

}  // namespace

Result<Nesting> nest(const std::vector<NestShape>& shapes, const std::vector<NestItem>& items,
                     const NestSettings& settings, Workers& workers, const Token& token) {
  if (items.empty()) return Nesting{};
  const Search search(shapes, items, settings, workers);
  if (const auto homeless = search.homeless()) return Nesting{{}, 0, homeless};
  const int tries = std::max(0, settings.tries) / static_cast<int>(kChains);
  std::vector<Search::Found> found(kChains);
  // All threads count; the caller's tells.
  std::atomic<int> done = 0;
  const auto caller = std::this_thread::get_id();
  const auto tried = [&](int more) {
    const double share = static_cast<double>(done += more) / (static_cast<double>(kChains) * tries);
    if (std::this_thread::get_id() == caller)
      token.progress(settings.from + (settings.to - settings.from) * std::min(1.0, share));
  };
  workers.forBlocks(kChains, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) found[i] = search.chain(i, tries, token, tried);
  });
  if (token.cancelled()) return cancelled();
  // The columns hide up to their width: what is best is known only after the pieces slid together.
  std::optional<Nesting> best;
  for (const Search::Found& one : found)
    if (Nesting nesting = search.finished(one); !best || nesting.length < best->length) best = std::move(nesting);
  return *std::move(best);
}

}  // namespace karinui
