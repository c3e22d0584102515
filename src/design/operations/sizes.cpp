// Grading: sizes, and the one that stands.
#include <algorithm>
#include <cmath>

#include "design/operations/operations.h"
#include "karinui/pattern/graded_places.h"

namespace karinui {

namespace {

constexpr double kFarthest = 1;  // metres a place may go from one size to another

Done checkSizeName(const std::string& name) {
  const bool good = !name.empty() && name.size() <= 24 && name.find_first_of(" \t\r\n;,=\"") == std::string::npos;
  return good ? Done()
              : refused(say("“{0}” cannot name a size: no blanks, commas or quotes, 24 letters at most.", name));
}

std::string namesOf(const Grading& grading) {
  std::string all;
  for (const std::string& size : grading.sizes) all += (all.empty() ? "" : ", ") + size;
  return all;
}

Result<std::size_t> sizeNamed(const Grading& grading, const std::string& name) {
  if (grading.empty()) return refused(say("There are no sizes yet; name them first: grade sizes=\"S M L\" base=M."));
  if (const auto at = grading.find(name)) return *at;
  return refused(say("There is no size “{0}”; there are: {1}.", name, namesOf(grading)));
}

// All sizes of a piece, or why one is no outline.
Done checkSizes(const Piece& piece, const Grading& grading) {
  for (std::size_t size = 0; size < grading.sizes.size(); ++size)
    if (const auto made = inSize(piece, grading, size); !made) return made.error();
  return {};
}

// The sizes named anew: what is known of those that stay is kept; a new one is as its neighbour towards the base is.
Result<Grading> renamed(const Grading& before, const GradePieces& op) {
  Grading after;
  after.sizes = op.sizes;
  after.base = *after.find(op.base);
  after.standing = before.empty() ? after.base : *after.find(before.sizes[before.standing]);
  std::vector<std::optional<std::size_t>> was;
  for (const std::string& size : after.sizes) was.push_back(before.find(size));
  for (std::size_t i = after.base; i-- > 0;)
    if (!was[i]) was[i] = was[i + 1];
  for (std::size_t i = after.base + 1; i < was.size(); ++i)
    if (!was[i]) was[i] = was[i - 1];
  for (const auto& [id, points] : before.pieces)
    for (const GradePoint& point : points) {
      GradePoint& now = after.pieces[id].emplace_back(GradePoint{point.edge, point.at, {}});
      for (const auto& old : was) now.by.push_back(point.by[*old]);
    }
  return after;
}

// The places of a piece with its corner among them.
GradePoint& cornerOf(GradePoints& points, const Piece& piece, const std::string& edge, std::size_t sizes) {
  const auto at = std::find_if(points.begin(), points.end(),
                               [&](const GradePoint& point) { return point.edge == edge && point.at == 0; });
  if (at != points.end()) return *at;
  return points.emplace_back(GradePoint{edge, 0, differenceAt(piece.outline, points, edge, 0, sizes)});
}

// A piece that was graded for the first time: its corners stay where they are unless they are told to go.
void beginGrading(Grading& grading, const Piece& piece) {
  if (grading.pieces.contains(piece.id)) return;
  for (const Edge& edge : piece.outline.edges)
    grading.pieces[piece.id].push_back({edge.name, 0, std::vector<Flat>(grading.sizes.size())});
}

// Symmetric copies are graded likewise, unless they went their own way since.
void gradeCopies(Document& document, PieceId id) {
  const Piece& piece = *document.find(id);
  const Outline image = mirrored(piece).outline;
  for (const auto& [other, copy] : document.pattern.pieces)
    if (other != id && (copy->mirrorOf == id || piece.mirrorOf == other) && copy->outline == image)
      document.grading.pieces[other] = mirroredGrading(document.grading.pieces.at(id), piece.outline, image);
}

}  // namespace

Done resolve(const Document& before, GradePieces& op, Context& context) {
  const Grading& grading = before.grading;
  if (const int meant = !op.sizes.empty() + !op.corners.empty() + (op.like || !op.points.empty()) + op.plain;
      meant != 1)
    return refused(say(
        "Say one thing: the sizes (sizes=\"S M L\"), how corners go (corners=front.hem by=5mm,0), or what a piece is "
        "in another size (piece=front size=L like=front_large)."));
  if (op.piece)
    if (Done done = resolve(before, op.piece); !done) return done;
  if (!op.sizes.empty()) {
    if (op.sizes.size() < 2 || op.sizes.size() > kMostSizes)
      return refused(say("There are two sizes at least and {0} at most.", kMostSizes));
    for (std::size_t i = 0; i < op.sizes.size(); ++i) {
      if (Done done = checkSizeName(op.sizes[i]); !done) return done;
      if (std::find(op.sizes.begin(), op.sizes.begin() + static_cast<std::ptrdiff_t>(i), op.sizes[i]) !=
          op.sizes.begin() + static_cast<std::ptrdiff_t>(i))
        return refused(say("The size “{0}” is named twice.", op.sizes[i]));
    }
    if (op.base.empty()) op.base = grading.empty() ? op.sizes[(op.sizes.size() - 1) / 2] : grading.sizes[grading.base];
    const auto has = [&](const std::string& size) {
      return std::find(op.sizes.begin(), op.sizes.end(), size) != op.sizes.end();
    };
    if (!has(op.base)) return refused(say("The base size “{0}” is not among the sizes.", op.base));
    if (!grading.empty() && !grading.pieces.empty() && op.base != grading.sizes[grading.base])
      return refused(say("Pieces are graded from size {0}, which stays the base.", grading.sizes[grading.base]));
    if (!grading.empty() && !has(grading.sizes[grading.standing]))
      return refused(say("Size {0} stands now; choose another one before it goes.", grading.sizes[grading.standing]));
    return {};
  }
  if (grading.empty()) return sizeNamed(grading, op.size).error();
  if (op.plain) return {};
  if (grading.standing != grading.base)
    return refused(say("Grade in the base size: choose it first, size name={0}.", grading.sizes[grading.base]));
  if (!op.size.empty() || op.like) {
    const auto size = sizeNamed(grading, op.size);
    if (!size) return size.error();
    if (*size == grading.base) return refused(say("{0} is the base size, which the others begin from.", op.size));
  }
  if (!op.corners.empty()) {
    if (!(length(op.by) <= kFarthest)) return refused(say("From size to size a corner goes by up to 1 m."));
    bool any = false;
    for (EdgeRef& edge : op.corners) {
      edge.from = 0, edge.to = 1;
      if (Done done = resolve(before, edge); !done) return done;
      const Piece& piece = *before.find(edge.piece.id);
      const auto k = piece.outline.find(edge.edge);
      if (!k) return refused(say("The corners of holes go along with the outline; grade the outline’s."));
      Choice symmetric = op.symmetric;
      const auto both = [&](const PaperSymmetry& symmetry) { return symmetry.corner[*k].has_value(); };
      if (Done done = resolveSymmetric(piece, symmetric, context, both); !done) return done;
      any = any || symmetric == Choice::Yes;
    }
    op.symmetric = any ? Choice::Yes : Choice::No;
    return {};
  }
  if (!op.piece) return refused(say("Say which piece is meant."));
  const Piece& piece = *before.find(op.piece.id);
  if (op.like) {
    if (Done done = resolve(before, op.like); !done) return done;
    std::vector<Outline> sizes;
    const auto own = grading.pieces.find(piece.id);
    for (std::size_t i = 0; i < grading.sizes.size(); ++i) {
      auto outline = own == grading.pieces.end() ? Result<Outline>(piece.outline)
                                                 : graded(piece.outline, grading, own->second, grading.base, i);
      if (!outline) return outline.error();
      sizes.push_back(*std::move(outline));
    }
    sizes[*grading.find(op.size)] = before.find(op.like.id)->outline;
    auto measured = measuredGrading(sizes, grading.base);
    if (!measured) return measured.error();
    op.points = *std::move(measured);
    op.like = {}, op.size.clear();
  }
  for (const GradePoint& point : op.points) {
    if (!piece.outline.find(point.edge)) return refused(say("Piece {0} has no edge {1}.", piece.name, point.edge));
    if (!(point.at >= 0 && point.at < 1))
      return refused(say("A graded place lies between 0, the corner where the edge begins, and 1."));
    if (point.by.size() != grading.sizes.size())
      return refused(say("The place on “{0}” goes {1} {1|way|ways}; there are {2} sizes: {3}.", point.edge,
                         point.by.size(), grading.sizes.size(), namesOf(grading)));
    for (const Flat by : point.by)
      if (!(length(by) <= kFarthest)) return refused(say("From size to size a corner goes by up to 1 m."));
    if (length(point.by[grading.base]) != 0)
      return refused(say("In the base size, {0}, no place goes anywhere.", grading.sizes[grading.base]));
  }
  return {};
}

Result<Document> perform(const Document& before, const GradePieces& op, Context&) {
  Document after = before;
  Grading& grading = after.grading;
  if (!op.sizes.empty()) {
    auto now = renamed(before.grading, op);
    if (!now) return now.error();
    grading = *std::move(now);
    return after;
  }
  if (op.plain) {
    if (!op.piece) grading = {};
    grading.pieces.erase(op.piece.id);
    return after;
  }
  std::set<PieceId> touched;
  if (op.piece) {
    touched.insert(op.piece.id);
    grading.pieces[op.piece.id] = op.points;
  }
  const auto only = op.size.empty() ? std::nullopt : grading.find(op.size);
  for (const EdgeRef& ref : op.corners) {
    const Piece& piece = *before.find(ref.piece.id);
    touched.insert(piece.id);
    beginGrading(grading, piece);
    const auto go = [&](const std::string& edge, Flat by) {
      GradePoint& corner = cornerOf(grading.pieces[piece.id], piece, edge, grading.sizes.size());
      for (std::size_t i = 0; i < corner.by.size(); ++i)
        if (only ? i == *only : i != grading.base)
          corner.by[i] = only ? by : by * (static_cast<double>(i) - static_cast<double>(grading.base));
    };
    go(ref.edge, op.by);
    if (op.symmetric != Choice::Yes) continue;
    if (const auto symmetry = symmetryOf(piece.outline))
      if (const auto other = symmetry->corner[*piece.outline.find(ref.edge)];
          other && piece.outline.edges[*other].name != ref.edge)
        go(piece.outline.edges[*other].name, symmetry->imageOf(op.by));
  }
  for (const PieceId id : touched) {
    if (Done done = checkSizes(*after.find(id), grading); !done) return done.error();
    gradeCopies(after, id);
  }
  return after;
}

Done resolve(const Document& before, ChooseSize& op, Context&) {
  const auto size = sizeNamed(before.grading, op.name);
  return size ? Done() : size.error();
}

Result<Document> perform(const Document& before, const ChooseSize& op, Context&) {
  Document after = before;
  const std::size_t to = *before.grading.find(op.name);
  for (const auto& [id, points] : before.grading.pieces) {
    const Piece& old = *before.find(id);
    auto piece = inSize(old, before.grading, to);
    if (!piece) return piece.error();
    if (const Piece* first = old.mirrorOf ? before.find(old.mirrorOf) : nullptr;
        first && old.outline == mirrored(*first).outline && before.grading.pieces.contains(first->id))
      piece->outline = mirrored(*after.find(first->id)).outline;  // to the last bit, so that it stays its likeness
    if (piece->outline == old.outline) continue;
    after.grading.pieces[id] = placesInSize(old.outline, points, before.grading.standing, to);
    piece->form = followedForm(old, piece->outline);
    if (const auto pins = after.pins.find(id); pins != after.pins.end())
      pins->second = carriedWithin(old.outline, piece->outline, pins->second);
    after = withPiece(std::move(after), *std::move(piece));
  }
  after.grading.standing = to;
  return after;
}

}  // namespace karinui
