#include "karinui/session/scene_of.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "karinui/design/drape.h"
#include "karinui/design/print_match.h"
#include "karinui/pattern/facing.h"
#include "karinui/pattern/seam_walk.h"
#include "session/cloth_trims.h"
#include "session/standing_buttons.h"
#include "session/zip_slider.h"

namespace karinui {

std::vector<float> strainOf(const Lattice& lattice, const std::vector<Vec3>& position) {
  std::vector<float> sum(lattice.nodes.size(), 0), count(lattice.nodes.size(), 0);
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    if (a == kNoNode || b == kNoNode) return;
    const double rest = distance(lattice.nodes[a], lattice.nodes[b]);
    const auto strain = static_cast<float>(std::abs(distance(position[a], position[b]) / rest - 1));
    for (const std::uint32_t node : {a, b}) {
      sum[node] += strain;
      count[node] += 1;
    }
  };
  for (std::uint32_t j = 0; j < lattice.rows; ++j) {
    for (std::uint32_t i = 0; i < lattice.columns; ++i) {
      const std::uint32_t node = lattice.grid[j * lattice.columns + i];
      if (i + 1 < lattice.columns) add(node, lattice.grid[j * lattice.columns + i + 1]);
      if (j + 1 < lattice.rows) add(node, lattice.grid[(j + 1) * lattice.columns + i]);
    }
  }
  for (std::size_t i = 0; i < lattice.border.size(); ++i) {
    add(lattice.border[i], lattice.border[(i + 1) % lattice.border.size()]);
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = count[i] > 0 ? sum[i] / count[i] : 0;
  return sum;
}

namespace {

// The runs of a piece's own nodes along its seams: where stitches are drawn. A closed seam is stitched once, on the
// side of the ties' first nodes; of one that is open still, both sides are. A dart's are drawn to its tip, whose two
// neighbours are tied to each other.
std::vector<std::vector<std::uint32_t>> seamsOf(const Cloth& cloth, const ClothPiece& piece,
                                                const std::vector<Vec3>& position) {
  constexpr double kClosed = 0.003;  // metres
  std::vector<bool> tied(piece.lattice->nodes.size(), false);
  const auto mark = [&](std::uint32_t node) {
    if (node != kNoNode && node >= piece.firstNode && node - piece.firstNode < tied.size()) {
      tied[node - piece.firstNode] = true;
    }
  };
  for (const Tie& tie : cloth.ties) {
    mark(tie.a);
    const Vec3 other = tie.c == kNoNode ? position[tie.b] : (position[tie.b] + position[tie.c]) * 0.5;
    if (distance(position[tie.a], other) <= kClosed) continue;
    mark(tie.b);
    mark(tie.c);
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> partners;
  for (const Tie& tie : cloth.ties) partners.insert(std::minmax(tie.a, tie.b));
  std::vector<std::vector<std::uint32_t>> runs;
  const auto along = [&](const std::vector<std::uint32_t>& border) {
    const std::size_t n = border.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t before = piece.firstNode + border[(i + n - 1) % n],
                          after = piece.firstNode + border[(i + 1) % n];
      if (partners.contains(std::minmax(before, after))) tied[border[i]] = true;
    }
    bool open = false;
    for (std::size_t i = 0; i <= n; ++i) {
      const std::uint32_t node = border[i % n];
      if (!tied[node]) {
        open = false;
        continue;
      }
      if (!open) runs.emplace_back();
      open = true;
      runs.back().push_back(node);
    }
  };
  along(piece.lattice->border);
  for (const auto& hole : piece.lattice->holes) along(hole);
  return runs;
}

// Where a ray meets a triangle, in lengths of its direction (Möller and Trumbore 1997).
std::optional<double> met(Vec3 from, Vec3 way, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, p = cross(way, ac);
  const double det = dot(ab, p);
  if (std::abs(det) < 1e-15) return std::nullopt;
  const Vec3 t = from - a, q = cross(t, ab);
  const double u = dot(t, p) / det, v = dot(way, q) / det;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return dot(ac, q) / det;
}

// Whether cloth lies over a button, but for what it holds together. Lines are drawn nearer to the eye than they are, so
// it would show through.
bool covered(const Document& document, const StandingButton& button, std::span<const SceneCloth> cloths) {
  constexpr double kReach = 0.03;  // metres above it
  const Vec3 up = button.up() * kReach;
  const std::string &over = document.find(button.over)->name, &under = document.find(button.under)->name;
  return std::any_of(cloths.begin(), cloths.end(), [&](const SceneCloth& cloth) {
    return cloth.name != over && cloth.name != under &&
           std::any_of(cloth.mesh.faces.begin(), cloth.mesh.faces.end(), [&](const Triangle& face) {
             const auto& points = cloth.mesh.points;
             const auto at = met(button.place, up, points[face[0]], points[face[1]], points[face[2]]);
             return at && *at > 0.01 && *at < 1;
           });
  });
}

// A zip's slider: a broad plate across both sides, and its pull tab, which hangs over what is closed.
void addSlider(std::vector<SceneLine>& lines, const ZipWay& way, const Colour& colour) {
  constexpr double kPlate = 0.006, kTab = 0.018;  // metres
  constexpr float kWide = 8, kNarrow = 5;         // mm
  const auto middle = [&](double closed) {
    const ZipPlace place = way.at(closed);
    // Where the sides gape the slider stays with the one that lies over.
    return distance(place.over.space, place.under.space) < kPlate ? lerp(place.over.space, place.under.space, 0.5)
                                                                  : place.over.space;
  };
  const double closed = way.closed();
  lines.push_back({{middle(closed - kPlate / 2), middle(closed + kPlate / 2)}, colour, kWide, false});
  if (closed > kTab) lines.push_back({{middle(closed), middle(closed - kTab)}, colour, kNarrow, false});
}

}  // namespace

std::vector<SceneLine> fasteningLines(const Document& document, std::span<const SceneCloth> cloths) {
  std::vector<SceneLine> lines;
  constexpr Colour kShell{0.86f, 0.84f, 0.78f}, kMetal{0.35f, 0.36f, 0.38f}, kBrass{0.50f, 0.33f, 0.09f};
  constexpr float kTeeth = 4;                          // mm
  constexpr double kAbove = 0.0015, kZipStep = 0.005;  // metres
  constexpr int kRound = 16;
  for (const auto& [name, own] : document.allowances.fastenings) {
    if (own.kind == FasteningKind::Zip) {
      const double whole = lengthOf(document.pattern, own), part = own.zipped;
      for (const bool over : {true, false}) {
        SceneLine line{{}, kMetal, kTeeth, false};
        const SeamSide side(document.pattern, over ? own.a : own.b, !over && own.reversed);
        const int steps = std::max(1, static_cast<int>(whole / kZipStep));
        for (int k = 0; k <= steps; ++k) {
          const double share = static_cast<double>(k) / steps;
          if (!over && (own.fromStart ? share >= 1 - part : share <= part) && part > 0) continue;  // a shows it
          const SeamPlace at = side.at(std::lerp(own.at[0], own.at[1], share));
          const Curve* curve = curveOf(document.pattern, at.piece, at.edge);
          if (curve) line.points.push_back(Stand(*document.find(at.piece))(curve->atFraction(at.fraction)));
        }
        if (line.points.size() > 1) lines.push_back(std::move(line));
      }
      if (const auto way = ZipWay::of(document, name)) addSlider(lines, *way, kBrass);
      continue;
    }
    if (own.kind != FasteningKind::Hook && own.kind != FasteningKind::Tie) continue;
    for (const FastenedPlaces& pair : placesOf(document.pattern, own))
      if (pair.closed)
        lines.push_back({{standing(document, pair.a).place, standing(document, pair.b).place},
                         kMetal,
                         own.kind == FasteningKind::Tie ? 3.0f : 2.0f,
                         false});
  }
  for (const StandingButton& button : standingButtons(document)) {
    if (covered(document, button, cloths)) continue;
    const Vec3 middle = button.place + button.up() * kAbove;
    SceneLine disc{
        {}, button.kind == FasteningKind::Snap ? kMetal : kShell, static_cast<float>(button.size * 500), false};
    for (int k = 0; k <= kRound; ++k) {
      const double turn = 2 * std::numbers::pi * k / kRound;
      disc.points.push_back(middle + (button.out * std::cos(turn) + button.along * std::sin(turn)) * (button.size / 4));
    }
    lines.push_back(std::move(disc));
  }
  return lines;
}

Result<SceneFrame> sceneOf(const Document& document, const Body* body, const Prints& prints) {
  Result<LaidScene> scene = laidSceneOf(document, body, prints);
  if (!scene) return scene.error();
  return std::move(scene->frame);
}

Result<LaidScene> laidSceneOf(const Document& document, const Body* body, const Prints& prints) {
  LaidScene scene;
  SceneFrame& frame = scene.frame;
  if (body) frame.bodies.push_back({body->mesh(), SceneBody{}.colour});
  if (document.pattern.pieces.empty()) return scene;
  const Result<Standing> standing = standingCloth(document, livePieces(document, {}));
  if (!standing) return standing.error();
  const std::set<PieceId> insideOut = wornInsideOut(document.pattern);
  for (const ClothPiece& piece : standing->cloth.pieces) {
    const Lattice& lattice = *piece.lattice;
    const auto first = standing->state.position.begin() + piece.firstNode;
    SceneCloth cloth;
    cloth.name = piece.name;
    cloth.mesh.points.assign(first, first + static_cast<std::ptrdiff_t>(lattice.nodes.size()));
    cloth.mesh.faces = lattice.faces;
    cloth.flat = lattice.nodes;
    cloth.strain = strainOf(lattice, cloth.mesh.points);
    const auto outline = [&](std::vector<std::uint32_t> ring) {
      ring.push_back(ring.front());
      cloth.outlines.push_back(std::move(ring));
    };
    outline(lattice.border);
    for (const auto& hole : lattice.holes) outline(hole);
    cloth.seams = seamsOf(standing->cloth, piece, standing->state.position);
    const Piece& cut = *document.find(piece.id);
    const Look look = lookOf(document, cut);
    cloth.colour = linear(look.colour);
    cloth.look = clothLookOf(look, piece.fabric, cut.grain, printOrigin(document, cut), prints);
    if (insideOut.contains(piece.id)) turnInsideOut(cloth.colour, cloth.look);
    cloth.live = document.drape.dirty.contains(piece.id);
    addTrims(document, piece.id, cloth);
    frame.cloths.push_back(std::move(cloth));
    scene.lattices.push_back(piece.lattice);
  }
  frame.lines = fasteningLines(document, frame.cloths);
  return scene;
}

std::vector<float> easeOf(const SceneCloth& cloth, const Body& body) {
  std::vector<float> ease;
  ease.reserve(cloth.mesh.points.size());
  for (const Vec3 p : cloth.mesh.points) ease.push_back(static_cast<float>(body.field().distance(p)));
  return ease;
}

}  // namespace karinui
