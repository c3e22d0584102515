// A run of edges becomes longer or shorter, and what it is sewn to by as much: an armhole with its cap.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/design/edge_length.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/edge_length.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr double kMostLonger = 1;    // metres
constexpr double kFarForIt = 2;      // times what the run gains: farther than that an end does not go along an edge
constexpr double kFarAlong = 0.5;    // metres: that an end goes along an edge
constexpr double kTrial = 1e-3;      // metres: an end goes so far to see what comes of it
constexpr double kExactly = 1e-9;    // metres
constexpr double kAsGood = 5e-4;     // metres: as much longer as it is to be
constexpr double kSamePlace = 0.02;  // of a seam's length: opposite each other
constexpr int kMostTries = 12;
constexpr int kMostSeamsAway = 6;  // a lining's cap is three seams from the armhole
constexpr double kChanged = 5e-5;  // metres

using RunEdge = std::pair<PieceId, std::string>;

// What becomes of an edge: which of its ends move, and how much longer it is for that.
struct Lengthened {
  bool start = false, end = false;
  double by = 0;
  KeptEnd keep() const { return start && end ? KeptEnd::Middle : start ? KeptEnd::End : KeptEnd::Start; }
};

std::string millimetres(double metres) { return fixed(metres * 1e3, 1); }

double lengthOf(const Outline& outline, const std::string& edge) {
  return outline.edges[*outline.find(edge)].curve.length();
}

// withLength(), with the angles at its ends as they were.
Result<Outline> madeAsLong(const Outline& from, const LengthChange& change, const PaperSymmetry* symmetry) {
  for (const bool keep : {change.neighboursKeep, false}) {  // what keeps by a hair may stretch with the angles
    LengthChange tried = change;
    tried.neighboursKeep = keep;
    for (int k = 0; k < kMostTries; ++k) {
      const auto now = withLength(from, tried, symmetry);
      if (!now) break;
      auto angled = withAnglesOf(from, *now, change.edge, symmetry);
      if (!angled) break;
      const double miss = change.to - lengthOf(*angled, change.edge);
      if (std::fabs(miss) < kExactly) return angled;
      tried.to += miss;
    }
  }
  return withLength(from, change, symmetry);  // as long, whatever its angles
}
// withEndAlong(), likewise.
Result<Outline> goneAlongBeside(const Outline& from, const std::string& edge, KeptEnd keep, double by,
                                const PaperSymmetry* symmetry) {
  auto now = withEndAlong(from, edge, keep, by, symmetry);
  if (!now) return now;
  auto angled = withAnglesOf(from, *now, edge, symmetry);
  return angled ? angled : now;
}

class Run {
 public:
  Run(const Document& before, const Lengthen& op) : before_(before), op_(op) {}

  Done find() {
    for (const EdgeRef& ref : op_.edges) {
      const RunEdge edge{ref.piece.id, ref.edge};
      if (std::find(images_.begin(), images_.end(), edge) != images_.end()) continue;
      own_.push_back(edge);
      for (const RunEdge& image : withImages(edge)) images_.push_back(image);
    }
    for (const RunEdge& edge : own_) {
      Lengthened change;
      if (Done done = freeEnds(edge, change); !done) return done;
      changes_[edge] = change;
      whole_ += lengthOf(outline(edge.first), edge.second);
    }
    if (whole_ + op_.by < 1e-3)
      return refused(say("The edges are {0} mm long together, and cannot become {1} mm shorter.", millimetres(whole_),
                         millimetres(-op_.by)));
    return {};
  }

  // The pieces with the run as long as it is to be.
  Result<std::map<PieceId, Outline>> lengthened(double& along) {
    if (op_.beside != Lengthen::Beside::Along) {
      std::map<PieceId, Outline> now;
      for (const RunEdge& edge : own_) {
        const Outline& from = now.contains(edge.first) ? now.at(edge.first) : outline(edge.first);
        const double was = lengthOf(outline(edge.first), edge.second);
        auto next = madeAsLong(
            from,
            {edge.second, was + op_.by * was / whole_, changes_.at(edge).keep(), op_.beside == Lengthen::Beside::Keep},
            symmetry(from, edge.second));
        if (!next) return next.error();
        now.insert_or_assign(edge.first, *std::move(next));
      }
      return now;
    }
    const auto way = howFarAlong();
    if (!way) return way.error();
    along = *way;
    if (std::fabs(along) > kFarForIt * std::fabs(op_.by))
      return refused(
          say("The ends would go {0} mm along the edges beside them, which stand nearly square to the run. Let those "
              "edges keep their lengths instead (beside=keep).",
              millimetres(std::fabs(along))));
    return goneAlong(along);
  }

  const std::vector<RunEdge>& own() const { return own_; }
  double whole() const { return whole_; }
  const Lengthened& change(const RunEdge& edge) const { return changes_.at(edge); }

  const PaperSymmetry* symmetry(const Outline& outline, const std::string& edge) {
    kept_ = op_.symmetric == Choice::No ? std::nullopt : symmetryOf(outline);
    const auto k = outline.find(edge);
    return kept_ && k && kept_->partner[*k] ? &*kept_ : nullptr;
  }
  // The edge, its image on the piece's other half, and those on symmetric copies; the second: it runs the other way.
  std::vector<RunEdge> withImages(const RunEdge& edge, std::vector<bool>* turned = nullptr) const {
    std::vector<RunEdge> all{edge};
    std::vector<bool> other{false};
    const Piece& piece = *before_.find(edge.first);
    const auto k = piece.outline.find(edge.second);
    const auto paper = op_.symmetric != Choice::No && k ? symmetryOf(piece.outline) : std::nullopt;
    if (const auto image = paper ? paper->partner[*k] : std::nullopt; image && *image != *k)
      all.push_back({piece.id, piece.outline.edges[*image].name}), other.push_back(true);
    for (std::size_t i = 0, here = all.size(); i < here; ++i)
      for (const PieceId copy : likenesses(before_, piece.id))
        if (const auto name = edgeOnCopy(*before_.find(copy), piece, all[i].second))
          all.push_back({copy, *name}), other.push_back(!other[i]);
    if (turned) *turned = std::move(other);
    return all;
  }

 private:
  const Outline& outline(PieceId id) const { return before_.find(id)->outline; }
  bool named(const RunEdge& edge) const { return std::find(own_.begin(), own_.end(), edge) != own_.end(); }

  // Ends at which the run goes on, on the paper or over a seam, stay.
  Done freeEnds(const RunEdge& edge, Lengthened& change) const {
    const Piece& piece = *before_.find(edge.first);
    const auto& edges = piece.outline.edges;
    const std::size_t k = *piece.outline.find(edge.second), n = edges.size();
    bool start = !named({edge.first, edges[(k + n - 1) % n].name}), end = !named({edge.first, edges[(k + 1) % n].name});
    for (const auto& [id, seam] : before_.pattern.seams)
      for (const auto* side : {&seam.a, &seam.b})
        for (std::size_t i = 0; i < side->size(); ++i) {
          const auto on = [&](std::size_t j) { return RunEdge{(*side)[j].piece, (*side)[j].edge}; };
          if (on(i) != edge) continue;
          if (i > 0 && named(on(i - 1))) start = false;
          if (i + 1 < side->size() && named(on(i + 1))) end = false;
        }
    if (!start && !end && n > 2)
      return refused(say("{0} lies between two other edges of the run, and has no end that could move.",
                         edgeSaid(before_, {PieceRef(edge.first), edge.second})));
    if (start && end) {
      const bool both = op_.symmetric != Choice::No && symmetryOf(piece.outline).has_value();
      const auto keep = keptEnd(before_, piece, edge.second, both);
      start = keep != SetLength::Keep::Start, end = keep != SetLength::Keep::End;
    }
    change.start = start, change.end = end;
    return {};
  }

  Result<std::map<PieceId, Outline>> goneAlong(double by) {
    std::map<PieceId, Outline> now;
    for (const RunEdge& edge : own_) {
      const Outline& from = now.contains(edge.first) ? now.at(edge.first) : outline(edge.first);
      auto next = goneAlongBeside(from, edge.second, changes_.at(edge).keep(), by, symmetry(from, edge.second));
      if (!next) return next.error();
      now.insert_or_assign(edge.first, *std::move(next));
    }
    return now;
  }
  Result<double> longerWhenAlong(double by) {
    const auto now = goneAlong(by);
    if (!now) return now.error();
    double length = 0;
    for (const RunEdge& edge : own_) length += lengthOf(now->at(edge.first), edge.second);
    return length - whole_;
  }
  // How far all ends go along the edges beside them, that the run becomes as long.
  Result<double> howFarAlong() {
    const auto trial = longerWhenAlong(kTrial);
    if (!trial) return trial.error();
    const double way = (*trial > 0) == (op_.by > 0) ? 1 : -1;
    double near = 0, reached = 0, far = kTrial;
    for (;;) {
      const auto there = longerWhenAlong(way * far);
      if (!there || far > kFarAlong || std::fabs(*there) < std::fabs(reached))
        return refused(
            op_.by < 0
                ? say("The ends cannot go so far along the edges beside them that the run becomes {0} mm shorter: it "
                      "becomes {1} mm shorter at most. Let those edges keep their lengths (beside=keep), or ask for "
                      "less.",
                      millimetres(-op_.by), millimetres(std::fabs(reached)))
                : say("The ends cannot go so far along the edges beside them that the run becomes {0} mm longer: it "
                      "becomes {1} mm longer at most. Let those edges keep their lengths (beside=keep), or ask for "
                      "less.",
                      millimetres(op_.by), millimetres(reached)));
      reached = *there;
      if (std::fabs(reached) >= std::fabs(op_.by)) break;
      near = far, far *= 1.5;
    }
    for (int i = 0; i < 60 && far - near > kExactly; ++i) {
      const double middle = (near + far) / 2;
      const auto there = longerWhenAlong(way * middle);
      if (!there) return there.error();
      (std::fabs(*there) < std::fabs(op_.by) ? near : far) = middle;
    }
    return way * (near + far) / 2;
  }

  const Document& before_;
  const Lengthen& op_;
  std::vector<RunEdge> own_, images_;
  std::map<RunEdge, Lengthened> changes_;
  double whole_ = 0;
  std::optional<PaperSymmetry> kept_;
};

// Where each span of a side begins and ends, as shares of the seam's length, counted from the start of side a.
struct Stretch {
  double from = 0, to = 1;
};
std::vector<Stretch> stretchesOf(const Pattern& pattern, const Seam& seam, bool b) {
  const auto& side = b ? seam.b : seam.a;
  const double whole = length(pattern, side);
  std::vector<Stretch> all;
  double along = 0;
  for (const EdgeSpan& span : side) {
    const double here = length(pattern, {span});
    all.push_back({along / whole, (along + here) / whole});
    along += here;
  }
  if (b && seam.reversed)
    for (Stretch& one : all) one = {1 - one.from, 1 - one.to};
  return all;
}
double overlapOf(const Stretch& one, const Stretch& other) {
  return std::fmin(std::fmax(one.from, one.to), std::fmax(other.from, other.to)) -
         std::fmax(std::fmin(one.from, one.to), std::fmin(other.from, other.to));
}

// What the run is sewn to, and what that is sewn to.
class Followers {
 public:
  Followers(const Document& before, const Lengthen& op, Run& run, Document after, double along, const Context& context)
      : before_(before), op_(op), run_(run), after_(std::move(after)), along_(along), context_(context) {
    for (const RunEdge& edge : run.own()) done(edge, run.change(edge));
  }

  Result<Document> follow() {
    for (int round = 0; round < kMostSeamsAway; ++round) {
      const auto next = sewnToDone();
      if (next.empty()) break;
      for (const auto& [edge, change] : next) {
        if (done_.contains(edge)) continue;  // the image of one that is done
        if (Done fine = lengthen(edge, change); !fine) return fine.error();
        done(edge, change);
      }
    }
    return std::move(after_);
  }

 private:
  void done(const RunEdge& edge, const Lengthened& change) {
    std::vector<bool> turned;
    const auto all = run_.withImages(edge, &turned);
    for (std::size_t i = 0; i < all.size(); ++i) {
      Lengthened own = change;
      if (turned[i]) std::swap(own.start, own.end);
      own.by = lengthOf(after_.find(all[i].first)->outline, all[i].second) -
               lengthOf(before_.find(all[i].first)->outline, all[i].second);
      done_.emplace(all[i], own);
    }
  }
  std::map<RunEdge, Lengthened> sewnToDone() {
    std::map<RunEdge, Lengthened> next;
    std::map<RunEdge, double> covered;
    std::set<SeamId> crossing;  // once, and not back again
    for (const auto& [id, seam] : before_.pattern.seams)
      for (const bool b : {false, true}) {
        if (seam.tie == Seam::Tie::Pleat || crossed_.contains(id)) continue;
        const auto &own = b ? seam.b : seam.a, &others = b ? seam.a : seam.b;
        const auto here = stretchesOf(before_.pattern, seam, b), there = stretchesOf(before_.pattern, seam, !b);
        const double ratio =
            seam.tie == Seam::Tie::TwoToOne ? length(before_.pattern, others) / length(before_.pattern, own) : 1;
        for (std::size_t j = 0; j < others.size(); ++j) {
          const RunEdge other{others[j].piece, others[j].edge};
          if (done_.contains(other) || !before_.find(other.first)->outline.find(other.second)) continue;
          if (covered[other] + others[j].to - others[j].from > 1 + kSamePlace) continue;  // by another seam
          Lengthened change;
          bool touched = false;
          for (std::size_t i = 0; i < own.size(); ++i) {
            const auto longer = done_.find({own[i].piece, own[i].edge});
            const double both = overlapOf(here[i], there[j]);
            if (longer == done_.end() || both <= 1e-9) continue;
            touched = true;
            change.by +=
                ratio * longer->second.by * (own[i].to - own[i].from) * both / std::fabs(here[i].to - here[i].from);
            const auto opposite = [&](double place) {
              change.start = change.start || std::fabs(there[j].from - place) < kSamePlace;
              change.end = change.end || std::fabs(there[j].to - place) < kSamePlace;
            };
            if (longer->second.start && own[i].from == 0) opposite(here[i].from);
            if (longer->second.end && own[i].to == 1) opposite(here[i].to);
          }
          if (!touched) continue;
          crossing.insert(id);
          covered[other] += others[j].to - others[j].from;
          Lengthened& all = next[other];
          all.by += change.by, all.start = all.start || change.start, all.end = all.end || change.end;
        }
      }
    crossed_.merge(crossing);
    return next;
  }
  Done lengthen(const RunEdge& edge, Lengthened change) {
    const Piece& piece = *after_.find(edge.first);
    const double was = lengthOf(piece.outline, edge.second);
    if (std::fabs(change.by) < kExactly) return {};
    if (!change.start && !change.end) {
      const auto keep = keptEnd(before_, piece, edge.second, op_.symmetric != Choice::No);
      change.start = keep != SetLength::Keep::Start, change.end = keep != SetLength::Keep::End;
    }
    const PaperSymmetry* symmetry = run_.symmetry(piece.outline, edge.second);
    if (symmetry && symmetry->partner[*piece.outline.find(edge.second)] == piece.outline.find(edge.second))
      change.start = change.end = true;
    ReshapePiece reshape;
    reshape.piece = edge.first;
    std::optional<Outline> likewise;
    if (op_.beside == Lengthen::Beside::Along)
      if (auto gone = goneAlongBeside(piece.outline, edge.second, change.keep(), along_, symmetry))
        likewise = *std::move(gone);
    if (likewise && std::fabs(lengthOf(*likewise, edge.second) - was - change.by) < kAsGood) {
      reshape.outline = *likewise;
    } else {
      auto outline =
          madeAsLong(piece.outline,
                     {edge.second, was + change.by, change.keep(), op_.beside != Lengthen::Beside::Follow}, symmetry);
      if (!outline) return outline.error();
      reshape.outline = *std::move(outline);
    }
    auto next = cutAnew(after_, reshape);
    if (!next) return next.error();
    after_ = *std::move(next);
    if (context_.advise && std::fabs(change.by) >= kChanged)
      context_.advise({say("{0} as well: {1} mm → {2} mm.", edgeSaid(before_, {PieceRef(edge.first), edge.second}),
                           millimetres(was), millimetres(was + change.by))});
    return {};
  }

  const Document& before_;
  const Lengthen& op_;
  Run& run_;
  Document after_;
  double along_;
  const Context& context_;
  std::map<RunEdge, Lengthened> done_;
  std::set<SeamId> crossed_;
};

}  // namespace

Done resolve(const Document& before, Lengthen& op, Context& context) {
  if (op.by == 0.0 || !(std::fabs(op.by) <= kMostLonger))
    return refused(say("Edges become longer or shorter by up to 1 m, not by {0} mm.", millimetres(op.by)));
  return resolveWhole(before, op.edges, op.symmetric, context);
}

Result<Document> perform(const Document& before, const Lengthen& op, Context& context) {
  Run run(before, op);
  if (Done done = run.find(); !done) return done.error();
  double along = 0;
  auto outlines = run.lengthened(along);
  if (!outlines) return outlines.error();
  Document after = before;
  for (auto& [id, outline] : *outlines) {
    if (after.find(id)->outline == outline) continue;  // the symmetric copy of one that is done
    ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
    reshape.piece = id;
    reshape.outline = std::move(outline);
    auto next = cutAnew(after, reshape);
    if (!next) return next.error();
    after = *std::move(next);
  }
  if (context.advise) {
    std::optional<Message> names;
    for (const RunEdge& edge : run.own()) {
      const Message name = edgeSaid(before, {PieceRef(edge.first), edge.second});
      names = names ? say("{0} + {1}", *names, name) : name;
    }
    const std::string was = millimetres(run.whole()), is = millimetres(run.whole() + op.by);
    context.advise({op.beside == Lengthen::Beside::Along
                        ? say("{0}: {1} mm → {2} mm; the ends go {3} mm along the edges beside them.", *names, was, is,
                              millimetres(std::fabs(along)))
                        : say("{0}: {1} mm → {2} mm.", *names, was, is)});
  }
  if (op.partners) {
    auto followed = Followers(before, op, run, std::move(after), along, context).follow();
    if (!followed) return followed.error();
    after = *std::move(followed);
  }
  tellSeams(before, after, context);
  return after;
}

}  // namespace karinui
