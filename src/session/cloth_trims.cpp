#include "session/cloth_trims.h"

#include <algorithm>
#include <cmath>

#include "karinui/pattern/lattice.h"
#include "karinui/pattern/trims.h"
#include "karinui/session/look_of.h"

namespace karinui {

namespace {

// A thread that is told from the cloth: darker, on dark cloth lighter.
Colour shadeOf(const Colour& cloth) {
  const float bright = 0.2126f * cloth[0] + 0.7152f * cloth[1] + 0.0722f * cloth[2];
  if (bright > 0.08f) return {cloth[0] * 0.45f, cloth[1] * 0.45f, cloth[2] * 0.45f};
  return {cloth[0] + 0.12f, cloth[1] + 0.12f, cloth[2] + 0.12f};
}

class ClothPlacer {
 public:
  explicit ClothPlacer(const SceneCloth& cloth) : finder_(cloth.flat, cloth.mesh.faces) {}
  ClothPlace operator()(Flat place, Flat inwards) const {
    const LatticePlace in = finder_.find(place, inwards);
    ClothPlace out;
    for (std::size_t c = 0; c < 3; ++c) out.corners[c] = in.face[c], out.weight[c] = in.weight[c];
    return out;
  }
  ClothPlace operator()(Flat place) const { return (*this)(place, place); }

 private:
  LatticeFinder finder_;
};

// Close enough together that what is drawn through them lies on the cloth.
std::vector<Flat> close(const std::vector<Flat>& points) {
  constexpr double kStep = 0.004;  // metres
  std::vector<Flat> all;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const int steps = std::max(1, static_cast<int>(std::ceil(distance(points[k], points[k + 1]) / kStep)));
    for (int i = 0; i < steps; ++i) all.push_back(lerp(points[k], points[k + 1], static_cast<double>(i) / steps));
  }
  if (!points.empty()) all.push_back(points.back());
  return all;
}

bool isSewn(const Pattern& pattern, PieceId piece, const std::string& edge) {
  const auto on = [&](const std::vector<EdgeSpan>& side) {
    return std::any_of(side.begin(), side.end(), [&](const EdgeSpan& s) { return s.piece == piece && s.edge == edge; });
  };
  return std::any_of(pattern.seams.begin(), pattern.seams.end(),
                     [&](const auto& seam) { return on(seam.second.a) || on(seam.second.b); });
}

}  // namespace

void addTrims(const Document& document, PieceId id, SceneCloth& cloth) {
  const Allowances& all = document.allowances;
  if (!all.trimmed()) return;
  const Piece& piece = *document.find(id);
  const auto own = [&](const auto& finishes, auto&& each) {
    for (auto at = finishes.lower_bound({id, ""}); at != finishes.end() && at->first.first == id; ++at)
      each(at->first.second, at->second);
  };
  std::optional<ClothPlacer> placer;  // made for the first that needs it
  const auto placed = [&]() -> const ClothPlacer& { return placer ? *placer : placer.emplace(cloth); };

  Allowances stitched;
  own(all.topstitches, [&](const std::string& edge, const Topstitch& t) { stitched.topstitches[{id, edge}] = t; });
  if (!stitched.topstitches.empty()) {
    Pattern alone;
    alone.pieces[id] = document.pattern.pieces.at(id);
    for (const StitchRow& row : stitchRows(alone, stitched)) {
      SceneStitches drawn;
      for (const Flat place : close(row.points)) drawn.line.push_back(placed()(place));
      const auto rgb = row.topstitch.colour;
      drawn.colour = rgb ? linear({static_cast<std::uint8_t>(*rgb >> 16), static_cast<std::uint8_t>(*rgb >> 8),
                                   static_cast<std::uint8_t>(*rgb)})
                         : shadeOf(cloth.colour);
      drawn.stitchMm = static_cast<float>(row.topstitch.length * (1 - kStitchGap) * 1000);
      drawn.gapMm = static_cast<float>(row.topstitch.length * kStitchGap * 1000);
      cloth.stitches.push_back(std::move(drawn));
    }
  }

  const auto add = [&](const TrimRun& run, SceneTrim trim, const std::string& fabric) {
    trim.fabric = fabric.empty() ? piece.fabric : fabric;
    trim.colour = fabric.empty() ? cloth.colour : linear(lookOf(document, fabric).colour);
    for (std::size_t k = 0; k < run.edgewise.size(); ++k) {
      trim.edge.push_back(placed()(run.edgewise[k], run.inside[k]));
      trim.inside.push_back(placed()(run.inside[k], run.inside[k]));
    }
    if (trim.edge.size() > 1) cloth.trims.push_back(std::move(trim));
  };
  own(all.pipings, [&](const std::string& edge, const Piping& piping) {
    SceneTrim trim;
    trim.kind = SceneTrim::Kind::Cord, trim.thickness = piping.thickness;
    trim.raised = isSewn(document.pattern, id, edge);
    add(runOf(piece, edge, piping), std::move(trim), piping.fabric);
  });
  own(all.bindings, [&](const std::string& edge, const Binding& binding) {
    SceneTrim trim;
    const auto fabric = fabricNamed(document, binding.fabric.empty() ? piece.fabric : binding.fabric);
    trim.thickness = fabric ? fabric->thickness : 0;
    add(runOf(piece, edge, binding, all), std::move(trim), binding.fabric);
  });
}

}  // namespace karinui
