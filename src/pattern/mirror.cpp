#include <algorithm>
#include <array>
#include <set>

#include "divide_edges.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

Flat across(Flat p) { return {-p.u, p.v}; }
Vec3 across(Vec3 p) { return {-p.x, p.y, p.z}; }

// Mirroring turns an outline clockwise; running it backwards turns it counter-clockwise again.
Outline across(const Outline& outline) {
  Outline copy;
  for (auto edge = outline.edges.rbegin(); edge != outline.edges.rend(); ++edge) {
    copy.edges.push_back({otherSide(edge->name), edge->curve.mirrored({0, 0}, {0, 1}).reversed()});
  }
  // An edge "left" beside an edge "right" changes names with it; one whose other name is taken keeps its own.
  std::map<std::string, int> count;
  for (const Edge& edge : copy.edges) ++count[edge.name];
  if (std::any_of(count.begin(), count.end(), [](const auto& c) { return c.second > 1; })) {
    for (std::size_t i = 0; i < copy.edges.size(); ++i)
      copy.edges[i].name = outline.edges[copy.edges.size() - 1 - i].name;
  }
  return copy;
}

// M R M for the mirror M = diag(-1, 1, 1): the turn's part about x stays, those about y and z turn the other way.
Rigid across(const Rigid& pose) { return {pose.w, pose.x, -pose.y, -pose.z, across(pose.carry)}; }

}  // namespace

Piece mirrored(const Piece& piece) {
  Piece copy = piece;
  copy.id = PieceId();
  copy.name.clear();
  copy.outline = across(piece.outline);
  for (Outline& hole : copy.holes) hole = across(hole);
  for (InternalLine& line : copy.lines) {
    line.name = otherSide(line.name);
    for (Curve& curve : line.curves) curve = curve.mirrored({0, 0}, {0, 1});
  }
  for (Mark& mark : copy.marks) {
    if (const auto at = piece.outline.find(mark.edge)) {
      mark.edge = copy.outline.edges[copy.outline.edges.size() - 1 - *at].name;
      mark.fraction = 1 - mark.fraction;
    }
    mark.place = across(mark.place);
  }
  copy.grain = across(piece.grain);
  copy.pose = across(piece.pose);
  if (piece.form) {
    auto form = std::make_shared<Form>(*piece.form);
    for (Flat& p : form->flat) p = across(p);
    for (Vec3& p : form->space) p = across(p);
    for (Triangle& face : form->faces) std::swap(face[1], face[2]);
    copy.form = std::move(form);
  }
  return copy;
}

namespace {

// Whether an outline has the edges of another, where that has them.
bool alike(const Outline& outline, const Outline& other) {
  constexpr double kSame = 1e-6;  // metres
  return outline.edges.size() == other.edges.size() &&
         std::all_of(other.edges.begin(), other.edges.end(), [&](const Edge& edge) {
           const auto k = outline.find(edge.name);
           return k && distance(outline.edges[*k].curve.start, edge.curve.start) <= kSame;
         });
}

}  // namespace

std::optional<std::string> edgeOnCopy(const Piece& copy, const Piece& piece, std::string_view edge) {
  const auto on = [&](const Outline& its, const Outline& own) -> std::optional<std::string> {
    const Outline image = across(own);
    const auto k = own.find(edge);
    if (!k || !alike(its, image)) return std::nullopt;
    return image.edges[image.edges.size() - 1 - *k].name;
  };
  if (auto name = on(copy.outline, piece.outline)) return name;
  for (std::size_t h = 0; h < piece.holes.size() && h < copy.holes.size(); ++h)
    if (auto name = on(copy.holes[h], piece.holes[h])) return name;
  return std::nullopt;
}

namespace {

// The names the edges of an outline have on another of the same shape.
std::optional<std::map<std::string, std::string>> namesOn(const Outline& other, const Outline& outline) {
  constexpr double kSame = 1e-6;  // metres
  if (outline.edges.size() != other.edges.size()) return std::nullopt;
  const auto same = [](const Curve& a, const Curve& b) {
    return distance(a.start, b.start) <= kSame && distance(a.end, b.end) <= kSame &&
           distance(a.atFraction(0.5), b.atFraction(0.5)) <= kSame;
  };
  std::map<std::string, std::string> names;
  for (const Edge& edge : outline.edges) {
    const auto found = std::find_if(other.edges.begin(), other.edges.end(),
                                    [&](const Edge& one) { return same(one.curve, edge.curve); });
    if (found == other.edges.end()) return std::nullopt;
    names[edge.name] = found->name;
  }
  return names;
}

}  // namespace

bool nameLikeImage(Piece& copy, EdgeMap& edges, const Piece& piece) {
  auto names = namesOn(across(piece.outline), copy.outline);
  if (!names || copy.holes.size() != piece.holes.size()) return false;
  for (const Outline& hole : copy.holes) {
    std::optional<std::map<std::string, std::string>> own;
    for (std::size_t h = 0; h < piece.holes.size() && !own; ++h) own = namesOn(across(piece.holes[h]), hole);
    if (!own) return false;
    names->merge(*own);
  }
  renameEdges(copy, edges, *names);
  return true;
}

void renameEdges(Piece& piece, EdgeMap& edges, const std::map<std::string, std::string>& names) {
  const auto rename = [&](std::string& name) {
    if (const auto found = names.find(name); found != names.end()) name = found->second;
  };
  std::set<std::string> told;  // by the map
  for (auto& [edge, parts] : edges)
    for (EdgePart& part : parts)
      if (part.now.piece == piece.id) told.insert(part.now.edge), rename(part.now.edge);
  for (const auto& [was, now] : names)
    if (was != now && !told.contains(was)) edges[{piece.id, was}] = {{0, 1, {piece.id, now, 0, 1}}};
  for (Edge& edge : piece.outline.edges) rename(edge.name);
  for (Outline& hole : piece.holes)
    for (Edge& edge : hole.edges) rename(edge.name);
  for (Mark& mark : piece.marks) rename(mark.edge);
}

std::vector<std::string> cutEdgesOf(const Piece& part, const Piece& whole, const EdgeMap& edges) {
  std::set<std::string> old = edgeNames(whole);
  for (const auto& [edge, parts] : edges)
    for (const EdgePart& one : parts)
      if (one.now.piece == part.id) old.insert(one.now.edge);
  std::vector<std::string> made;
  for (const Edge& edge : part.outline.edges)
    if (!old.contains(edge.name)) made.push_back(edge.name);
  // They were numbered along the line.
  std::sort(made.begin(), made.end(),
            [](const std::string& a, const std::string& b) { return std::pair(a.size(), a) < std::pair(b.size(), b); });
  return made;
}

void nameCutEdges(Piece& part, const Piece& whole, EdgeMap& edges, const std::string& name) {
  const std::vector<std::string> made = cutEdgesOf(part, whole, edges);
  std::set<std::string> taken = edgeNames(part);
  for (const std::string& edge : made) taken.erase(edge);
  std::map<std::string, std::string> names;
  for (const std::string& edge : made) names[edge] = freeName(name, taken);
  for (Edge& edge : part.outline.edges)
    if (const auto now = names.find(edge.name); now != names.end()) edge.name = now->second;
}

std::optional<EditedPiece> editedLikewise(const Piece& copy, const Piece& before, const EditedPiece& edit) {
  const Outline was = across(before.outline);
  if (!alike(copy.outline, was)) return std::nullopt;
  EditedPiece likewise{copy, {}};
  likewise.piece.outline = across(edit.piece.outline);
  // An edge's name on the other side: by its place in the outline, as across() gave it.
  const auto other = [](const Outline& outline, const Outline& image, const std::string& name) {
    return image.edges[image.edges.size() - 1 - *outline.find(name)].name;
  };
  for (const auto& [edge, parts] : edit.edges) {
    if (!before.outline.find(edge.second)) return std::nullopt;  // of a hole
    auto& now = likewise.edges[{copy.id, other(before.outline, was, edge.second)}];
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
      now.push_back({1 - part->to,
                     1 - part->from,
                     {copy.id, other(edit.piece.outline, likewise.piece.outline, part->now.edge), 1 - part->now.to,
                      1 - part->now.from}});
  }
  followMarks(likewise.piece, likewise.edges);
  return likewise;
}

std::string otherSide(const std::string& name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kWords{
      {{"left", "right"}, {"Left", "Right"}}};
  for (const auto& [left, right] : kWords) {
    if (const auto at = name.find(left); at != std::string::npos)
      return std::string(name).replace(at, left.size(), right);
    if (const auto at = name.find(right); at != std::string::npos)
      return std::string(name).replace(at, right.size(), left);
  }
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kEnds{
      {{"_l", "_r"}, {"_r", "_l"}, {"_L", "_R"}, {"_R", "_L"}}};
  for (const auto& [end, other] : kEnds)
    if (name.ends_with(end)) return name.substr(0, name.size() - end.size()) + std::string(other);
  return name;
}

}  // namespace karinui
