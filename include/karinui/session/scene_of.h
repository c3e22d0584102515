#pragma once
// A garment as a picture and as something to point at. Pure; long for large garments; any thread.
#include <memory>
#include <span>

#include "karinui/design/document.h"
#include "karinui/pattern/lattice.h"
#include "karinui/scene/scene_frame.h"
#include "karinui/session/look_of.h"

namespace karinui {

// The body (null: none) and every piece where it stands, at the document's own spacing.
// `prints` gives the photographs it is printed with; without it they are left out.
Result<SceneFrame> sceneOf(const Document& document, const Body* body, const Prints& prints = {});
// The same, and what each cloth of it was laid as.
struct LaidScene {
  SceneFrame frame;
  std::vector<std::shared_ptr<const Lattice>> lattices;
};
Result<LaidScene> laidSceneOf(const Document& document, const Body* body, const Prints& prints = {});

// Buttons and snaps as discs where they lie, but for those that other cloth covers; hooks and ties as threads, zips
// along their edges: closed in one line, open in two. `cloths`: the document's as they stand.
std::vector<SceneLine> fasteningLines(const Document& document, std::span<const SceneCloth> cloths);

// Per node, the mean of |l/L - 1| over the warp and weft edges of the lattice that meet there.
std::vector<float> strainOf(const Lattice& lattice, const std::vector<Vec3>& position);

// How far each point of a cloth is from the skin, metres; negative inside.
std::vector<float> easeOf(const SceneCloth& cloth, const Body& body);

}  // namespace karinui
