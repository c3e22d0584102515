#include "karinui/design/sewing_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

#include "karinui/base/number.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/pockets.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

constexpr double kNarrow = 0.15;      // of the largest piece's area: bands, cuffs, collars
constexpr double kGathered = 1.1;     // times as long as the other side; less is eased in
constexpr double kEased = 5e-4;       // metres: less is not spoken of
constexpr double kSameCorner = 1e-4;  // metres

// Sets that are joined (Tarjan, 1975).
class Sets {
 public:
  std::size_t add() {
    parent_.push_back(parent_.size());
    return parent_.size() - 1;
  }
  std::size_t find(std::size_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

class SewingPlan {
 public:
  explicit SewingPlan(const Document& document) : document_(document), pattern_(document.pattern) {
    std::size_t number = 0;
    for (const auto& [id, seam] : pattern_.seams) numbers_[id] = ++number, left_.insert(id);
    for (const auto& [id, piece] : pattern_.pieces) {
      part_[id] = parts_.add();
      largest_ = std::max(largest_, piece->outline.area());
    }
  }

  std::vector<SewingStep> made() {
    if (pattern_.seams.empty()) return {};
    interfacings();
    darts();
    pleats();
    along(document_.allowances.pipings, [](const Message& edges) { return say("Tack the piping along {0}.", edges); });
    pockets();
    patches();
    bool zipped = false;
    while (!left_.empty()) {
      const SeamId next = bestOf(left_);
      if (!std::exchange(zipped, zipped || narrow(pattern_.seams.at(next))) && narrow(pattern_.seams.at(next))) zips();
      steps_.push_back({{numbers_.at(next)}, seamWords(pattern_.seams.at(next))});
      sew(next);
    }
    if (!zipped) zips();
    along(document_.allowances.elastics,
          [](const Message& edges) { return say("Draw in the elastic along {0}.", edges); });
    along(document_.allowances.bindings, [](const Message& edges) { return say("Bind {0}.", edges); });
    hems();
    closings();
    return std::move(steps_);
  }

 private:
  std::size_t cornerAt(PieceId piece, Flat place) {
    for (const auto& [id, at, set] : corners_)
      if (id == piece && distance(at, place) < kSameCorner) return set;
    corners_.emplace_back(piece, place, meets_.add());
    return std::get<2>(corners_.back());
  }
  std::optional<std::size_t> cornerAt(const SeamPlace& at) {
    const Curve* curve = curveOf(pattern_, at.piece, at.edge);
    return curve ? std::optional(cornerAt(at.piece, curve->atFraction(at.fraction))) : std::nullopt;
  }

  void sew(SeamId id) {
    left_.erase(id);
    const Seam& seam = pattern_.seams.at(id);
    const SeamSides sides(pattern_, seam);
    for (const double at : sides.breaks()) {
      const auto a = cornerAt(sides.a.at(at)), b = cornerAt(sides.b.at(at));
      if (a && b) meets_.join(*a, *b);
    }
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        if (part_.contains(span.piece)) parts_.join(part_.at(span.piece), part_.at(seam.a.front().piece));
  }
  // `words`: of their numbers, and how many there are.
  void sew(const std::vector<SeamId>& group, const std::function<Message(const Message&, std::size_t)>& words) {
    if (group.empty()) return;
    SewingStep step;
    std::vector<Message> numbers;
    for (const SeamId id : group) {
      step.seams.push_back(numbers_.at(id));
      numbers.push_back(say("{0}", numbers_.at(id)));
      sew(id);
    }
    step.words = words(listSaid(numbers), numbers.size());
    steps_.push_back(std::move(step));
  }

  // Its edges follow each other, on their piece or over seams that are sewn.
  bool follows(const std::vector<EdgeSpan>& side) {
    for (std::size_t k = 1; k < side.size(); ++k) {
      const auto from = cornerAt({side[k - 1].piece, side[k - 1].edge, side[k - 1].to}),
                 to = cornerAt({side[k].piece, side[k].edge, side[k].from});
      if (from && to && meets_.find(*from) != meets_.find(*to)) return false;
    }
    return true;
  }
  bool narrow(const Seam& seam) const {
    double least = largest_;
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) least = std::min(least, pattern_.pieces.at(span.piece)->outline.area());
    return least < kNarrow * largest_;
  }
  // Smaller is sooner: whether it is sewn over what does not meet yet, what it does, how long it is.
  std::tuple<bool, int, double, SeamId> rank(SeamId id) {
    const Seam& seam = pattern_.seams.at(id);
    const std::size_t first = parts_.find(part_.at(seam.a.front().piece));
    bool joins = false;
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) joins = joins || parts_.find(part_.at(span.piece)) != first;
    const double along = std::round(length(pattern_, seam.a) * 1e3);
    return {!follows(seam.a) || !follows(seam.b), narrow(seam) ? 2 : joins ? 0 : 1, along, id};
  }
  SeamId bestOf(const std::set<SeamId>& seams) {
    SeamId best = *seams.begin();
    for (const SeamId id : seams)
      if (rank(id) < rank(best)) best = id;
    return best;
  }

  // An edge by its name; several of one piece by the piece's.
  Message sideSaid(const std::vector<EdgeSpan>& side) const {
    std::vector<Message> all;
    for (std::size_t k = 0, next = 0; k < side.size(); k = next) {
      for (next = k + 1; next < side.size() && side[next].piece == side[k].piece;) ++next;
      const Piece& piece = *document_.find(side[k].piece);
      all.push_back(next - k > 1 ? nameSaid(piece.name) : edgeOf(piece, side[k].edge));
    }
    return listSaid(all);
  }
  Message seamWords(const Seam& seam) const {
    const double a = length(pattern_, seam.a), b = length(pattern_, seam.b), more = std::abs(a - b);
    const Message named =
        say("Seam {0}: {1}", numbers_.at(seam.id),
            seam.name.empty() ? say("{0} – {1}", sideSaid(seam.a), sideSaid(seam.b)) : nameSaid(seam.name));
    if (more < kEased) return named;
    return std::max(a, b) > kGathered * std::min(a, b)
               ? say("{0}, gathered to {1} cm", named, fixed(std::min(a, b) * 100, 1))
               : say("{0}, {1} mm eased in", named, fixed(more * 1e3, 0));
  }

  void interfacings() {
    std::vector<Message> names;
    for (const auto& [id, piece] : pattern_.pieces)
      if (!piece->interfacing.empty()) names.push_back(nameSaid(piece->name));
    if (!names.empty()) steps_.push_back({{}, say("Fuse interfacing to {0}.", listSaid(names))});
  }
  void darts() {
    std::vector<SeamId> group;
    for (const PaperDart& dart : dartsOf(pattern_)) group.push_back(dart.seam);
    for (const DoubleDart& dart : doubleDartsOf(pattern_)) group.push_back(dart.seam);
    std::sort(group.begin(), group.end());
    sew(group, [](const Message& numbers, std::size_t count) {
      return say("Sew the darts: {1|seam|seams} {0}.", numbers, count);
    });
  }
  bool onLines(const std::vector<EdgeSpan>& side) const {
    return std::all_of(side.begin(), side.end(), [&](const EdgeSpan& span) {
      const auto piece = pattern_.pieces.find(span.piece);
      return piece != pattern_.pieces.end() && !findEdge(*piece->second, span.edge);
    });
  }
  void pleats() {
    std::vector<SeamId> laid, down;
    for (const SeamId id : left_) {
      const Seam& seam = pattern_.seams.at(id);
      if (seam.a.front().piece != seam.b.front().piece) continue;  // layers of two pieces are sewn as seams are
      if (seam.tie == Seam::Tie::Pleat)
        laid.push_back(id);
      else if (onLines(seam.a) && onLines(seam.b))
        down.push_back(id);
    }
    for (const SeamId id : laid) sew(id);
    if (!laid.empty()) steps_.push_back({{}, say("Lay the pleats and press them.")});
    sew(down, [](const Message& numbers, std::size_t count) {
      return say("Sew the folds down: {1|seam|seams} {0}.", numbers, count);
    });
  }
  // The bags lie open while they are sewn to the opening's edges; round them is sewn when the seams beside it are.
  void pockets() {
    for (const SewnPocket& pocket : pocketsOf(pattern_)) {
      if (!left_.contains(pocket.opening)) continue;
      std::vector<SeamId> caught = pocket.caught;
      std::erase_if(caught, [&](SeamId id) { return !left_.contains(id); });
      std::sort(caught.begin(), caught.end());
      sew(caught, [](const Message& numbers, std::size_t count) {
        return say("Sew the pocket {2|bag|bags} to the {2|edge|edges} of the opening: {1|seam|seams} {0}.", numbers,
                   count, count);
      });
      const Seam& opening = pattern_.seams.at(pocket.opening);
      const Message name = opening.name.empty() ? say("the opening of the pocket") : nameSaid(opening.name);
      sew({pocket.opening}, [&](const Message& numbers, std::size_t) {
        return say("Baste, and do not sew, seam {0}: {1}. It is open once the garment is pressed.", numbers, name);
      });
    }
  }
  // What is sewn onto the inside of a piece, all seams of a pocket together.
  void patches() {
    std::map<std::pair<PieceId, PieceId>, std::vector<SeamId>> groups;  // by what is sewn on what
    for (const SeamId id : left_) {
      const Seam& seam = pattern_.seams.at(id);
      if (onLines(seam.a) == onLines(seam.b)) continue;
      const auto& [on, patch] = onLines(seam.a) ? std::tie(seam.a, seam.b) : std::tie(seam.b, seam.a);
      if (on.front().piece != patch.front().piece) groups[{on.front().piece, patch.front().piece}].push_back(id);
    }
    for (const auto& one : groups) {
      const Message on = nameSaid(document_.find(one.first.first)->name),
                    patch = nameSaid(document_.find(one.first.second)->name);
      sew(one.second, [&](const Message& numbers, std::size_t count) {
        return say("Sew {0} onto {1}: {3|seam|seams} {2}.", patch, on, numbers, count);
      });
    }
    std::set<PieceId> slit;
    for (const SeamId id : bagsOnLines(pattern_)) slit.insert(pattern_.seams.at(id).a.front().piece);
    for (const PieceId id : slit)
      steps_.push_back({{},
                        say("Slit {0} between the seams of its welt pocket and into the corners, and turn welt and "
                            "bags through.",
                            nameSaid(document_.find(id)->name))});
  }
  template <class Finishes>
  void along(const Finishes& finishes, const std::function<Message(const Message&)>& words) {
    std::vector<Message> edges;
    for (const auto& [at, own] : finishes)
      if (const Piece* piece = document_.find(at.first)) edges.push_back(edgeOf(*piece, at.second));
    if (!edges.empty()) steps_.push_back({{}, words(listSaid(edges))});
  }
  void hems() {
    const AllowancePlan plan(pattern_, document_.allowances);
    const auto turnedUp = [&](PieceId piece, const std::string& edge) {
      return plan.kind(piece, edge) == EdgeKind::Hem && plan.width(piece, edge) > 0 &&
             !document_.allowances.bindings.contains({piece, edge});
    };
    std::vector<Message> names;
    for (const auto& [id, piece] : pattern_.pieces) {
      bool any = false;
      for (const Edge& edge : piece->outline.edges) any = any || turnedUp(id, edge.name);
      if (any) names.push_back(nameSaid(piece->name));
    }
    if (!names.empty()) steps_.push_back({{}, say("Turn up the hems of {0}.", listSaid(names))});
  }
  Message edgeOf(const Piece& piece, const std::string& edge) const {
    return edgeSaid(document_, EdgeRef{PieceRef(piece.id), edge});
  }
  std::vector<Message> namesOf(FasteningKind kind) const {
    std::vector<Message> names;
    for (const auto& [name, own] : document_.allowances.fastenings)
      if (own.kind == kind) names.push_back(fasteningSaid(name));
    return names;
  }
  void zips() {
    if (const auto names = namesOf(FasteningKind::Zip); !names.empty())
      steps_.push_back({{}, say("Set in the {1|zip|zips}: {0}.", listSaid(names), names.size())});
  }
  void closings() {
    for (const FasteningKind kind :
         {FasteningKind::Button, FasteningKind::Snap, FasteningKind::Hook, FasteningKind::Tie})
      if (const auto names = namesOf(kind); !names.empty())
        steps_.push_back({{},
                          kind == FasteningKind::Button
                              ? say("Make the buttonholes and sew the buttons on: {0}.", listSaid(names))
                              : say("Sew on {0}: {1}.", nameSaid(traitsOf(kind).plural), listSaid(names))});
  }

  const Document& document_;
  const Pattern& pattern_;
  std::map<SeamId, std::size_t> numbers_;
  std::set<SeamId> left_;
  Sets parts_, meets_;
  std::map<PieceId, std::size_t> part_;
  std::vector<std::tuple<PieceId, Flat, std::size_t>> corners_;
  double largest_ = 0;
  std::vector<SewingStep> steps_;
};

}  // namespace

std::vector<SewingStep> sewingOrder(const Document& document) { return SewingPlan(document).made(); }

}  // namespace karinui
