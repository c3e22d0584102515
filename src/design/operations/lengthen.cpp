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

// What a side of a piece is sewn to on other pieces ends there, as a waist at a side seam: it can be let out at that
// end. At a dart, or where a symmetric piece goes on in its other half, it cannot.
struct LetOutEnds {
  bool start = false, end = false;
  bool any() const { return start || end; }
};
bool endsAtSeam(const Document& document, const RunEdge& beside) {
  bool own = false, other = false;
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto& [side, over] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)})
      for (const EdgeSpan& span : *side)
        if (RunEdge{span.piece, span.edge} == beside)
          for (const EdgeSpan& far : *over) (far.piece == beside.first ? own : other) = true;
  return other || !own;
}
LetOutEnds letOutEnds(const Document& document, const RunEdge& edge, const std::vector<RunEdge>& run) {
  const auto& edges = document.find(edge.first)->outline.edges;
  const std::size_t k = *document.find(edge.first)->outline.find(edge.second), n = edges.size();
  const auto can = [&](std::size_t beside) {
    const RunEdge next{edge.first, edges[beside % n].name};
    return std::find(run.begin(), run.end(), next) == run.end() && endsAtSeam(document, next);
  };
  return {can(k + n - 1), can(k + 1)};
}

// A band: its ends are sewn to each other, or free.
bool isBandAlong(const Document& document, const RunEdge& edge) {
  const auto& edges = document.find(edge.first)->outline.edges;
  const std::size_t k = *document.find(edge.first)->outline.find(edge.second), n = edges.size();
  if (n < 4) return false;
  for (const std::size_t beside : {k + n - 1, k + 1})
    for (const auto& [id, seam] : document.pattern.seams)
      for (const auto& [side, over] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)})
        for (const EdgeSpan& span : *side)
          if (span.piece == edge.first && span.edge == edges[beside % n].name)
            for (const EdgeSpan& far : *over)
              if (far.piece != edge.first) return false;
  return true;
}
// The ends of a band go outwards as they are, so that its upper edge becomes longer by as much as its lower one.
Result<Document> endsCarriedOut(const Document& before, const RunEdge& edge, double by, const Context& context) {
  const auto& edges = before.find(edge.first)->outline.edges;
  const std::size_t k = *before.find(edge.first)->outline.find(edge.second), n = edges.size();
  TakeIn out;
  for (const std::size_t beside : {k + n - 1, k + 1})
    out.edges.push_back({PieceRef(edge.first), edges[beside % n].name});
  out.by = {-by / 2};
  out.partners = out.symmetric = Choice::No;
  out.whole = out.together = out.follow = Choice::Yes;
  Context quiet = context;
  quiet.advise = {};
  return perform(before, out, quiet);
}

// As they are named; or, where they go all round, by what can be let out at the seams that cross them.
enum class Way { AsNamed, Round };

class Run {
 public:
  Run(const Document& before, const Lengthen& op, Way way) : before_(before), op_(op), way_(way), by_(op.by) {}

  Done find() {
    for (const EdgeRef& ref : op_.edges) {
      const RunEdge edge{ref.piece.id, ref.edge};
      if (std::find(images_.begin(), images_.end(), edge) != images_.end()) continue;
      own_.push_back(edge);
      for (const RunEdge& image : withImages(edge)) images_.push_back(image);
    }
    bool anyGrows = false;
    for (const RunEdge& edge : own_) {
      Lengthened change;
      const double length = lengthOf(outline(edge.first), edge.second);
      if (way_ == Way::Round) {
        const LetOutEnds ends = letOutEnds(before_, edge, images_);
        change.start = ends.start, change.end = ends.end;
        if (ends.any()) grows_ += length, anyGrows = true;
      } else {
        if (Done done = freeEnds(edge, change); !done) return done;
        grows_ += length;
      }
      changes_[edge] = change;
      whole_ += length;
    }
    if (way_ == Way::Round) {
      if (!goesRound()) return refused(say("These edges do not go all round."));
      for (const RunEdge& edge : own_)
        if (!anyGrows) {  // as a waistband
          if (Done done = freeEnds(edge, changes_[edge]); !done) return done;
          grows_ += lengthOf(outline(edge.first), edge.second);
        }
      double named = 0;  // with those that are images of each other
      std::set<RunEdge> once;
      for (const EdgeRef& ref : op_.edges)
        if (once.insert({ref.piece.id, ref.edge}).second) named += lengthOf(outline(ref.piece.id), ref.edge);
      by_ = op_.by * whole_ / named;
      wholeNamed_ = named, named_.assign(once.begin(), once.end());
    } else {
      wholeNamed_ = whole_, named_ = own_;
    }
    if (whole_ + by_ < 1e-3)
      return refused(say("The edges are {0} mm long together, and cannot become {1} mm shorter.", millimetres(whole_),
                         millimetres(-op_.by)));
    return {};
  }

  // The pieces with the run as long as it is to be.
  Result<std::map<PieceId, Outline>> lengthened(double& along) {
    if (op_.beside != Lengthen::Beside::Along) {
      std::map<PieceId, Outline> now;
      for (const RunEdge& edge : own_) {
        if (!grows(edge)) continue;
        const Outline& from = now.contains(edge.first) ? now.at(edge.first) : outline(edge.first);
        const double was = lengthOf(outline(edge.first), edge.second);
        auto next = madeAsLong(
            from,
            {edge.second, was + by_ * was / grows_, changes_.at(edge).keep(), op_.beside == Lengthen::Beside::Keep},
            symmetry(from, edge.second));
        if (!next) return next.error();
        now.insert_or_assign(edge.first, *std::move(next));
      }
      return now;
    }
    const auto way = howFarAlong();
    if (!way) return way.error();
    along = *way;
    if (std::fabs(along) > kFarForIt * std::fabs(by_))
      return refused(
          say("The ends would go {0} mm along the edges beside them, which stand nearly square to the run. Let those "
              "edges keep their lengths instead (beside=keep).",
              millimetres(std::fabs(along))));
    return goneAlong(along);
  }

  const std::vector<RunEdge>& own() const { return own_; }
  double whole() const { return whole_; }
  const std::vector<RunEdge>& named() const { return named_; }
  double wholeNamed() const { return wholeNamed_; }
  double by() const { return by_; }
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
  bool grows(const RunEdge& edge) const {
    return way_ == Way::AsNamed || changes_.at(edge).start || changes_.at(edge).end;
  }
  // Whether the run, with its images, is one side of a seam, or goes on from each end over a seam.
  bool goesRound() const {
    for (const auto& [id, seam] : before_.pattern.seams)
      for (const auto* side : {&seam.a, &seam.b})
        if (seam.a.size() + seam.b.size() > 2 && std::all_of(side->begin(), side->end(), [&](const EdgeSpan& span) {
              return std::find(images_.begin(), images_.end(), RunEdge{span.piece, span.edge}) != images_.end();
            }))
          return true;
    return false;
  }
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
      if (!grows(edge)) continue;
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
    for (const RunEdge& edge : own_)
      length += lengthOf(now->contains(edge.first) ? now->at(edge.first) : outline(edge.first), edge.second);
    return length - whole_;
  }
  // How far all ends go along the edges beside them, that the run becomes as long.
  Result<double> howFarAlong() {
    const auto trial = longerWhenAlong(kTrial);
    if (!trial) return trial.error();
    const double way = (*trial > 0) == (by_ > 0) ? 1 : -1;
    double near = 0, reached = 0, far = kTrial;
    for (;;) {
      const auto there = longerWhenAlong(way * far);
      if (!there || far > kFarAlong || std::fabs(*there) < std::fabs(reached))
        return refused(
            by_ < 0
                ? say("The ends cannot go so far along the edges beside them that the run becomes {0} mm shorter: it "
                      "becomes {1} mm shorter at most. Let those edges keep their lengths (beside=keep), or ask for "
                      "less.",
                      millimetres(-by_), millimetres(std::fabs(reached)))
                : say("The ends cannot go so far along the edges beside them that the run becomes {0} mm longer: it "
                      "becomes {1} mm longer at most. Let those edges keep their lengths (beside=keep), or ask for "
                      "less.",
                      millimetres(by_), millimetres(reached)));
      reached = *there;
      if (std::fabs(reached) >= std::fabs(by_)) break;
      near = far, far *= 1.5;
    }
    for (int i = 0; i < 60 && far - near > kExactly; ++i) {
      const double middle = (near + far) / 2;
      const auto there = longerWhenAlong(way * middle);
      if (!there) return there.error();
      (std::fabs(*there) < std::fabs(by_) ? near : far) = middle;
    }
    return way * (near + far) / 2;
  }

  const Document& before_;
  const Lengthen& op_;
  const Way way_;
  double by_;
  std::vector<RunEdge> own_, images_, named_;
  std::map<RunEdge, Lengthened> changes_;
  double whole_ = 0, grows_ = 0, wholeNamed_ = 0;  // its length, that of what grows, and with the images named
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
  Followers(const Document& before, const Lengthen& op, Run& run, Way way, Document after, double along,
            const Context& context)
      : before_(before), op_(op), run_(run), way_(way), after_(std::move(after)), along_(along), context_(context) {
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
        const std::vector<double> share = way_ == Way::Round ? letOutShares(others) : std::vector<double>();
        const double ratio =
            seam.tie == Seam::Tie::TwoToOne ? length(before_.pattern, others) / length(before_.pattern, own) : 1;
        for (std::size_t j = 0; j < others.size(); ++j) {
          const RunEdge other{others[j].piece, others[j].edge};
          if (done_.contains(other) || !before_.find(other.first)->outline.find(other.second)) continue;
          if (covered[other] + others[j].to - others[j].from > 1 + kSamePlace) continue;  // by another seam
          Lengthened change;
          bool touched = false;
          if (!share.empty()) {  // all of it where that side can be let out
            for (const EdgeSpan& span : own)
              if (const auto longer = done_.find({span.piece, span.edge}); longer != done_.end())
                touched = true, change.by += ratio * share[j] * longer->second.by * (span.to - span.from);
            const LetOutEnds ends = letOutEnds(before_, other, edgesOf(others));
            change.start = ends.start, change.end = ends.end;
          }
          for (std::size_t i = 0; share.empty() && i < own.size(); ++i) {
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
  static std::vector<RunEdge> edgesOf(const std::vector<EdgeSpan>& side) {
    std::vector<RunEdge> all;
    for (const EdgeSpan& span : side) all.push_back({span.piece, span.edge});
    return all;
  }
  // How much of what a side of several edges gets is each one's; nothing where it has as much as it is long.
  std::vector<double> letOutShares(const std::vector<EdgeSpan>& side) const {
    std::vector<double> share;
    if (side.size() < 2) return share;
    double sum = 0;
    for (const EdgeSpan& span : side) {
      const bool line = !before_.find(span.piece)->outline.find(span.edge);
      if (line) return {};
      const bool can = letOutEnds(before_, {span.piece, span.edge}, edgesOf(side)).any();
      share.push_back(can ? length(before_.pattern, {span}) : 0);
      sum += share.back();
    }
    if (!(sum > 0)) return {};
    for (double& one : share) one /= sum;
    return share;
  }
  void tell(const RunEdge& edge, double was, double by) const {
    if (context_.advise && std::fabs(by) >= kChanged)
      context_.advise({say("{0} as well: {1} mm → {2} mm.", edgeSaid(before_, {PieceRef(edge.first), edge.second}),
                           millimetres(was), millimetres(was + by))});
  }
  Done lengthen(const RunEdge& edge, Lengthened change) {
    const Piece& piece = *after_.find(edge.first);
    const double was = lengthOf(piece.outline, edge.second);
    if (std::fabs(change.by) < kExactly) return {};
    if (!change.start && !change.end) {
      const auto keep = keptEnd(before_, piece, edge.second, op_.symmetric != Choice::No);
      change.start = keep != SetLength::Keep::Start, change.end = keep != SetLength::Keep::End;
    }
    if (way_ == Way::Round && change.start && change.end && isBandAlong(before_, edge)) {
      if (auto next = endsCarriedOut(after_, edge, change.by, context_);
          next && std::fabs(lengthOf(next->find(edge.first)->outline, edge.second) - was - change.by) < kAsGood) {
        after_ = *std::move(next);
        tell(edge, was, change.by);
        return {};
      }
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
    tell(edge, was, change.by);
    return {};
  }

  const Document& before_;
  const Lengthen& op_;
  Run& run_;
  const Way way_;
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

namespace {

Result<Document> lengthened(const Document& before, const Lengthen& op, Way way, const Context& context) {
  Run run(before, op, way);
  if (Done done = run.find(); !done) return done.error();
  double along = 0;
  auto outlines = run.lengthened(along);
  if (!outlines) return outlines.error();
  Document after = before;
  if (const RunEdge& only = run.own().front(); way == Way::Round && run.own().size() == 1 && isBandAlong(before, only))
    if (auto band = endsCarriedOut(before, only, run.by(), context);
        band && std::fabs(lengthOf(band->find(only.first)->outline, only.second) - run.whole() - run.by()) < kAsGood)
      after = *std::move(band), outlines->clear();
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
    constexpr std::size_t kMost = 4;  // edges that are named one by one
    const auto said = [&](const RunEdge& edge) { return edgeSaid(before, {PieceRef(edge.first), edge.second}); };
    std::optional<Message> names;
    if (run.named().size() > kMost) names = say("{0} … {1}", said(run.named().front()), said(run.named().back()));
    for (std::size_t k = 0; k < run.named().size() && run.named().size() <= kMost; ++k)
      names = names ? say("{0} + {1}", *names, said(run.named()[k])) : said(run.named()[k]);
    const std::string was = millimetres(run.wholeNamed()), is = millimetres(run.wholeNamed() + op.by);
    context.advise({op.beside == Lengthen::Beside::Along
                        ? say("{0}: {1} mm → {2} mm; the ends go {3} mm along the edges beside them.", *names, was, is,
                              millimetres(std::fabs(along)))
                        : say("{0}: {1} mm → {2} mm.", *names, was, is)});
  }
  if (op.partners) {
    auto followed = Followers(before, op, run, way, std::move(after), along, context).follow();
    if (!followed) return followed.error();
    after = *std::move(followed);
  }
  tellSeams(before, after, context);
  return after;
}

}  // namespace

// What has no end that could move, as a waist that goes all round, grows at its side seams, and what it is sewn to
// does.
Result<Document> perform(const Document& before, const Lengthen& op, Context& context) {
  std::vector<Advice> told;
  const auto tried = [&](Way way) {
    told.clear();
    Context quiet = context;
    if (context.advise) quiet.advise = [&](const Advice& advice) { told.push_back(advice); };
    return lengthened(before, op, way, quiet);
  };
  auto after = tried(Way::AsNamed);
  if (!after && !context.token.cancelled()) {
    auto round = tried(Way::Round);
    if (round || Run(before, op, Way::Round).find()) after = std::move(round);
  }
  if (after && context.advise)
    for (const Advice& advice : told) context.advise(advice);
  return after;
}

}  // namespace karinui
