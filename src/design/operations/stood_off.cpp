#include "design/operations/stood_off.h"

#include <algorithm>
#include <cmath>

#include "design/operations/new_piece.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

namespace {

constexpr double kApart = 0.008;         // metres from cloth to cloth
constexpr double kFlatWithin = 0.12;     // metres that a flat piece may stand too near to the body,
constexpr double kWrappedWithin = 0.08;  // and one that is wrapped round it
constexpr double kSameWay = 0.3;         // cosine between directions away from the body
constexpr double kWidenedAbout = 0.04;   // metres about a place that is moved, over which its neighbours are

struct Sheet {
  std::shared_ptr<const Form> form;  // in space
  std::vector<Vec3> outward;         // unit, of each place
  bool flat = false;
};

// Its lattice where it stands. Null: the paper cannot be laid.
std::shared_ptr<const Form> formOf(const Piece& piece, double spacing) {
  const auto laid = layAlone(piece, spacing);
  if (!laid) return nullptr;
  const Stand stand(piece);
  auto form = std::make_shared<Form>();
  form->flat = (*laid)->nodes, form->faces = (*laid)->faces;
  for (const Flat place : form->flat) form->space.push_back(stand(place));
  return form;
}

// The same with normals away from the body: of a flat piece, which may stand far beside it, from the body's middle; of
// one that is wrapped round it, from the limb that is nearest.
std::optional<Sheet> sheetOf(const Piece& piece, double spacing, const Body& body) {
  const auto form = formOf(piece, spacing);
  if (!form) return std::nullopt;
  Sheet sheet{form, std::vector<Vec3>(form->flat.size()), !piece.form};
  const Vec3 middle = boxOf(body.mesh().points).centre();
  double away = 0;
  for (const Triangle& face : form->faces) {
    const Vec3 a = form->space[face[0]],
               normal = cross(form->space[face[1]] - a, form->space[face[2]] - a);  // as long as twice the area
    for (const std::uint32_t corner : face) sheet.outward[corner] += normal;
    away += dot(normal, sheet.flat ? a - middle : body.field().sample(a).gradient);
  }
  for (Vec3& normal : sheet.outward) normal = normalized(normal) * (away < 0 ? -1.0 : 1.0);
  return sheet;
}

// Cloth that hangs already, as one surface.
class WornCloth {
 public:
  WornCloth(const Document& document, const std::set<PieceId>& pieces, const Body& body)
      : body_(body), mesh_(meshOf(document, pieces)), near_(mesh_) {}

  // How far a place must go along `outward` to be outside of all cloth beneath which it stands.
  double inTheWay(Vec3 place, Vec3 outward, double within) const {
    constexpr double kBehind = 1e-6;  // metres: a ray that begins on cloth meets it
    double need = 0;
    const Vec3 start = place - outward * kApart;
    for (const Bvh::Hit& hit : near_.all(start, outward)) {
      if (hit.along > within + kApart) break;
      if (hit.along < kBehind) continue;
      if (dot(body_.field().sample(hit.point).gradient, outward) < kSameWay) break;  // on another limb
      need = std::max(need, hit.along);
    }
    return need;
  }
  bool empty() const { return mesh_.faces.empty(); }

 private:
  static TriangleMesh meshOf(const Document& document, const std::set<PieceId>& pieces) {
    TriangleMesh mesh;
    for (const PieceId id : pieces) {
      const auto form = formOf(*document.find(id), document.settings.spacing);
      if (!form) continue;
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.insert(mesh.points.end(), form->space.begin(), form->space.end());
      for (const Triangle& face : form->faces)
        mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    }
    return mesh;
  }

  const Body& body_;
  TriangleMesh mesh_;
  Bvh near_;
};

// The largest within a radius of each place, then the mean of these: no place moves less than it must, and none leaves
// its neighbours behind.
std::vector<double> widened(const std::vector<Flat>& places, const std::vector<double>& by) {
  std::vector<double> largest(places.size()), mean(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      if (by[j] > 0 && distance(places[i], places[j]) <= 2 * kWidenedAbout) largest[i] = std::max(largest[i], by[j]);
  for (std::size_t i = 0; i < places.size(); ++i) {
    double sum = 0, count = 0;
    for (std::size_t j = 0; j < places.size(); ++j)
      if (distance(places[i], places[j]) <= kWidenedAbout) sum += largest[j], ++count;
    mean[i] = std::max(by[i], sum / count);
  }
  return mean;
}

std::vector<double> inTheWay(const WornCloth& cloth, const Sheet& sheet) {
  std::vector<double> by;
  for (std::size_t i = 0; i < sheet.form->space.size(); ++i)
    by.push_back(cloth.inTheWay(sheet.form->space[i], sheet.outward[i], sheet.flat ? kFlatWithin : kWrappedWithin));
  return by;
}

}  // namespace

Document stoodOff(Document document, const std::set<PieceId>& pieces, const std::set<PieceId>& worn, const Body& body) {
  const WornCloth cloth(document, worn, body);
  if (cloth.empty()) return document;
  struct Flats {
    Vec3 outward;
    double by = 0;
    std::set<PieceId> pieces;
  };
  std::vector<Flats> flats;
  for (const PieceId id : pieces) {
    const auto sheet = sheetOf(*document.find(id), document.settings.spacing, body);
    if (!sheet) continue;
    const Form& form = *sheet->form;
    std::vector<double> by = inTheWay(cloth, *sheet);
    const double most = by.empty() ? 0 : *std::max_element(by.begin(), by.end());
    if (sheet->flat) {
      const Vec3 outward = sheet->outward.empty() ? Vec3{0, 0, 1} : sheet->outward.front();
      auto same = std::find_if(flats.begin(), flats.end(),
                               [&](const Flats& other) { return dot(other.outward, outward) > 1 - kSameWay; });
      if (same == flats.end()) same = flats.insert(flats.end(), {outward, 0, {}});
      same->by = std::max(same->by, most);
      same->pieces.insert(id);
    } else if (most > 0) {
      by = widened(form.flat, by);
      auto moved = std::make_shared<Form>(form);
      for (std::size_t i = 0; i < moved->space.size(); ++i) moved->space[i] += sheet->outward[i] * by[i];
      Piece piece = *document.find(id);
      piece.form = std::move(moved), piece.pose = Rigid();
      document.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
    }
  }
  for (const Flats& together : flats)
    for (const PieceId id : together.pieces) {
      if (!(together.by > 0)) continue;
      Piece piece = *document.find(id);
      piece.pose.carry += together.outward * together.by;
      document.pattern.pieces[id] = std::make_shared<const Piece>(std::move(piece));
    }
  return document;
}

}  // namespace karinui
