#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "karinui/base/sort_once.h"

#include "karinui/cloth/cloth.h"

namespace karinui {
namespace {

Result<Fabric> fabricOf(const Piece& piece, const std::map<std::string, Fabric>& fabrics) {
  const auto named = [&](const std::string& name) {
    const auto found = fabrics.find(name);
    return found != fabrics.end() ? Result<Fabric>(found->second) : preset(name);
  };
  Result<Fabric> fabric = named(piece.fabric);
  if (!fabric) return fabric;
  if (!piece.interfacing.empty()) {
    const Result<Fabric> inner = named(piece.interfacing);
    if (!inner) return inner;
    fabric = fused(*fabric, *inner);
  }
  if (const auto fine = checkFabric(*fabric); !fine) return fine.error();
  return fabric;
}

// The nodes within a radius of a place on paper, or the nearest one.
std::vector<std::uint32_t> nodesAt(const Lattice& lattice, Flat place, double radius) {
  std::vector<std::uint32_t> nodes;
  std::uint32_t nearest = 0;
  for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
    const double d = distance(lattice.nodes[k], place);
    if (d <= radius) nodes.push_back(k);
    if (d < distance(lattice.nodes[nearest], place)) nearest = k;
  }
  if (nodes.empty()) nodes.push_back(nearest);
  return nodes;
}

// Where a form holds the nodes of a lattice, each on its own bank of a slit. A form that was left by this very lattice
// holds each where it stood.
std::vector<Vec3> placesIn(const Form& form, const Lattice& lattice) {
  if (form.flat == lattice.nodes && form.faces == lattice.faces) return form.space;
  const LatticeFinder finder(form.flat, form.faces);
  const std::vector<Flat> inwards = inwardsOf(lattice.nodes, lattice.faces);
  std::vector<Vec3> places(lattice.nodes.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const LatticePlace in = finder.find(lattice.nodes[k], inwards[k]);
    for (int c = 0; c < 3; ++c) places[k] += form.space[in.face[c]] * in.weight[c];
  }
  return places;
}

ClothEdge edgeOf(const Cloth& cloth, std::size_t piece, const Piece& paper, const std::string& name) {
  ClothEdge edge{piece, name, {}, 0};
  const Lattice& lattice = *cloth.pieces[piece].lattice;
  const auto found = lattice.edges.find(name);
  const Curve* drawn = findCurve(paper, name);
  if (found == lattice.edges.end() || !drawn) return edge;
  for (const std::uint32_t node : found->second.nodes) edge.nodes.push_back(cloth.pieces[piece].firstNode + node);
  edge.length = drawn->length();
  return edge;
}

// What piping and bindings add to an edge. Their layers, and the cord's fibres, slide on each other and bend each as if
// alone: a strip as its cloth on the bias, a cord by its cross-section.
struct Trims {
  const std::map<std::string, Fabric>& fabrics;

  static constexpr double kCordWeight = 600;  // kg/m3 of cotton cord, its air included
  // N: bending stiffness over cross-section. A 4 mm cotton cord that sticks out over a table's edge by 8 cm hangs down
  // at 41.5 degrees: w (l/2)^3 = 5e-6 N m2 (F. T. Peirce, The handle of cloth as a measurable quantity, 1930).
  static constexpr double kCordBending = 0.4;

  Fabric stripOf(const ClothPiece& piece, const std::string& name) const {
    if (name.empty()) return piece.fabric;
    const auto found = fabrics.find(name);
    const auto fabric = found != fabrics.end() ? Result<Fabric>(found->second) : preset(name);
    return fabric ? *fabric : piece.fabric;
  }
  static TrimmedEdge strip(ClothEdge edge, const Fabric& fabric, double width) {
    const double onBias = 0.5 * (std::sqrt(fabric.bendWarp) + std::sqrt(fabric.bendWeft));
    return {std::move(edge), onBias * onBias * width, fabric.weight * width};
  }
  TrimmedEdge of(const ClothPiece& piece, ClothEdge edge, const Binding& own) const {
    return strip(std::move(edge), stripOf(piece, own.fabric), own.stripWidth());
  }
  TrimmedEdge of(const ClothPiece& piece, ClothEdge edge, const Piping& own) const {
    TrimmedEdge made = strip(std::move(edge), stripOf(piece, own.fabric), own.stripWidth());
    const double section = std::numbers::pi * own.thickness * own.thickness / 4;
    made.bending += kCordBending * section, made.weight += kCordWeight * section;
    return made;
  }
};

// What is sewn to the pieces' edges, turned up at them and pressed into them.
void finish(const Pattern& pattern, const Allowances* finish, const Trims& trims, Cloth& cloth) {
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const Piece& piece = *pattern.pieces.at(cloth.pieces[p].id);
    for (const InternalLine& line : piece.lines) {
      if (!line.crease) continue;
      std::vector<Flat> places;
      for (const Curve& curve : line.curves)
        for (const Flat place : curve.flattened(1e-4))
          if (places.empty() || distance(places.back(), place) > 1e-6) places.push_back(place);
      cloth.creases.push_back({p, std::move(places), *line.crease});
    }
    if (!finish) continue;
    const auto add = [&](const auto& all, auto& to) {
      for (auto own = all.lower_bound({piece.id, ""}); own != all.end() && own->first.first == piece.id; ++own)
        if (ClothEdge edge = edgeOf(cloth, p, piece, own->first.second); edge.nodes.size() > 1)
          to.push_back({std::move(edge), own->second});
    };
    add(finish->elastics, cloth.elastics);
    for (auto own = finish->hems.lower_bound({piece.id, ""}); own != finish->hems.end() && own->first.first == piece.id;
         ++own)
      if (ClothEdge edge = edgeOf(cloth, p, piece, own->first.second); edge.nodes.size() > 1)
        cloth.foldedBack.push_back({std::move(edge), own->second.allowance()});
    const auto trim = [&](const auto& all) {
      for (auto own = all.lower_bound({piece.id, ""}); own != all.end() && own->first.first == piece.id; ++own)
        if (ClothEdge edge = edgeOf(cloth, p, piece, own->first.second); edge.nodes.size() > 1)
          cloth.trims.push_back(trims.of(cloth.pieces[p], std::move(edge), own->second));
    };
    trim(finish->pipings), trim(finish->bindings);
  }
}

// What lies beyond a seam is pressed open on either side. Where cloth is gathered into a seam its allowance is gathered
// with it and stiffens nothing; within a pleat there is none.
void pressOpen(const Pattern& pattern, const Allowances& allowances, Cloth& cloth) {
  std::vector<bool> sewn(cloth.nodeCount, false);
  for (const Tie& tie : cloth.ties) {
    if (pattern.seams.at(cloth.seams[tie.seam]).tie == Seam::Tie::Pleat) continue;
    sewn[tie.a] = true;
    if (tie.c == kNoNode) sewn[tie.b] = true;
  }
  const AllowancePlan plan(pattern, allowances);
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const Piece& piece = *pattern.pieces.at(cloth.pieces[p].id);
    for (const Edge& edge : piece.outline.edges) {
      const ClothEdge whole = edgeOf(cloth, p, piece, edge.name);
      ClothEdge part{p, edge.name, {}, whole.length};
      for (std::size_t k = 0; k <= whole.nodes.size(); ++k) {
        if (k < whole.nodes.size() && sewn[whole.nodes[k]]) {
          part.nodes.push_back(whole.nodes[k]);
          continue;
        }
        if (part.nodes.size() > 1) cloth.foldedBack.push_back({part, plan.width(piece.id, edge.name)});
        part.nodes.clear();
      }
    }
  }
}

void fasten(const Pattern& pattern, const Fastenings& fastenings, Cloth& cloth) {
  std::map<PieceId, std::pair<std::uint32_t, LatticeFinder>> finders;
  const auto place = [&](const FasteningPlace& at, double sign, std::size_t corner, ClothFastener& to) {
    const auto piece =
        std::find_if(cloth.pieces.begin(), cloth.pieces.end(), [&](const auto& p) { return p.id == at.piece; });
    if (piece == cloth.pieces.end()) return false;
    const auto& [first, finder] =
        finders.try_emplace(at.piece, piece->firstNode, LatticeFinder(piece->lattice->nodes, piece->lattice->faces))
            .first->second;
    const LatticePlace in = finder.find(at.place, at.place - at.outward * 1e-3);
    for (std::size_t c = 0; c < 3; ++c)
      to.nodes[corner + c] = first + in.face[c], to.weights[corner + c] = sign * in.weight[c];
    return true;
  };
  std::size_t index = 0;
  for (const auto& [name, own] : fastenings) {
    const SeamId zip = zipId(index++);
    if (own.kind == FasteningKind::Zip) {
      const auto seam = std::find(cloth.seams.begin(), cloth.seams.end(), zip);
      if (seam != cloth.seams.end())
        cloth.zips.push_back(
            {name, static_cast<std::uint32_t>(seam - cloth.seams.begin()), length(pattern, pattern.seams.at(zip).a)});
      continue;
    }
    // A hook holds edges that meet, or within them ends that lap, as those of a waistband.
    const bool laps = own.kind == FasteningKind::Button || own.kind == FasteningKind::Snap ||
                      (own.kind == FasteningKind::Hook && own.inset > 0);
    std::size_t number = 0;
    for (const FastenedPlaces& pair : placesOf(pattern, own)) {
      ClothFastener fastener{name, ++number, own.kind, {}, {}, own.gap, laps};
      if (pair.closed && place(pair.a, 1, 0, fastener) && place(pair.b, -1, 3, fastener))
        cloth.fasteners.push_back(std::move(fastener));
    }
  }
}

}  // namespace

Result<Cloth> assemble(const Pattern& pattern, const LaidPattern& laid, const std::map<std::string, Fabric>& fabrics,
                       const ClothChoice& choice) {
  Cloth cloth;
  cloth.spacing = laid.spacing;
  std::map<PieceId, std::uint32_t> first;
  for (const auto& [id, piece] : pattern.pieces) {
    const auto lattice = laid.lattices.find(id);
    if (lattice == laid.lattices.end() || !lattice->second || lattice->second->nodes.empty())
      return refused(say("The piece “{0}” has not been laid as cloth.", piece->name));
    auto fabric = fabricOf(*piece, fabrics);
    if (!fabric) return fabric.error();
    const auto live = choice.live.find(id);
    first[id] = cloth.nodeCount;
    cloth.pieces.push_back({id, piece->name, lattice->second, *fabric, cloth.nodeCount, piece->layer,
                            live != choice.live.end() ? live->second : !piece->frozen});
    cloth.nodeCount += static_cast<std::uint32_t>(lattice->second->nodes.size());
    if (const auto pins = choice.pins.find(id); pins != choice.pins.end())
      for (Flat place : pins->second)
        for (std::uint32_t k : nodesAt(*lattice->second, place, choice.pinRadius))
          cloth.pinned.push_back(first[id] + k);
  }
  sortOnce(cloth.pinned);
  std::map<SeamId, std::uint32_t> seamIndex;
  for (const auto& [id, seam] : pattern.seams) {
    seamIndex[id] = static_cast<std::uint32_t>(cloth.seams.size());
    cloth.seams.push_back(id);
    cloth.pleated = cloth.pleated || seam.tie == Seam::Tie::Pleat;
  }
  for (const SeamTie& tie : laid.ties) {
    const auto a = first.find(tie.pieceA), b = first.find(tie.pieceB);
    const auto seam = seamIndex.find(tie.seam);
    if (a == first.end() || b == first.end() || seam == seamIndex.end()) continue;  // its piece is not of this pattern
    const Tie joined{a->second + tie.a, b->second + tie.b, tie.c == kNoNode ? kNoNode : b->second + tie.c,
                     seam->second};
    if (joined.a != joined.b || joined.c != kNoNode) cloth.ties.push_back(joined);
  }
  finish(pattern, choice.finish, Trims{fabrics}, cloth);
  if (choice.finish) pressOpen(pattern, *choice.finish, cloth), fasten(pattern, choice.finish->fastenings, cloth);
  return cloth;
}

ClothState standing(const Pattern& pattern, const Cloth& cloth) {
  ClothState state;
  state.position.resize(cloth.nodeCount);
  for (const ClothPiece& part : cloth.pieces) {
    const Piece& piece = *pattern.pieces.at(part.id);
    const Lattice& lattice = *part.lattice;
    const bool formed = piece.form && !piece.form->faces.empty() && piece.form->flat.size() == piece.form->space.size();
    const std::vector<Vec3> places = formed ? placesIn(*piece.form, lattice) : std::vector<Vec3>();
    for (std::uint32_t k = 0; k < lattice.nodes.size(); ++k) {
      const Flat flat = lattice.nodes[k];
      state.position[part.firstNode + k] = piece.pose(formed ? places[k] : Vec3{flat.u, flat.v, 0});
    }
  }
  return state;
}

std::shared_ptr<const Form> formOf(const Cloth& cloth, const ClothState& state, std::size_t piece) {
  const ClothPiece& part = cloth.pieces.at(piece);
  auto form = std::make_shared<Form>();
  form->flat = part.lattice->nodes;
  form->faces = part.lattice->faces;
  form->space.assign(state.position.begin() + part.firstNode,
                     state.position.begin() + part.firstNode + static_cast<std::ptrdiff_t>(form->flat.size()));
  return form;
}

}  // namespace karinui
