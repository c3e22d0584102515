#pragma once
// Laying a curved sheet flat as cloth: the paper shape whose cloth has to stretch, squeeze and shear least to take the
// sheet's shape. Least-squares conformal map (Lévy et al. 2002; Tutte's embedding where that folds), then the symmetric
// Dirichlet energy (Smith & Schaefer 2015) by projected Newton steps that never turn a triangle over, then the fabric's
// own membrane energy with the grain held. Metres. Pure; any thread. Refused (with a sentence): what is no sheet, and
// what cannot be laid flat without a fold; Cancelled when the token says so.
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// How far cloth of the flat shape is strained when it takes the sheet's shape. Area-weighted; p99: 99 % are below.
struct Distortion {
  struct Spread {
    double mean = 0, p99 = 0, max = 0;
  };
  Spread warp, weft;  // |stretch - 1|
  Spread shear;       // radians off the right angle
  Spread area;        // |area ratio - 1|
  double border = 0;  // flat border length / sheet's border length - 1
  std::uint32_t worstFace = 0;
  enum class Gate { Green, Amber, Red } gate = Gate::Green;
};
// What a fabric bears. Woven: 2 % / 5 % stretch and 8 / 15 degrees of shear; knit: 10 % / 25 %, the same shear.
struct Gates {
  double stretchGreen = 0.02, stretchAmber = 0.05;
  double shearGreen = 8 * 0.017453292519943295, shearAmber = 15 * 0.017453292519943295;
};

struct FlattenSettings {
  double warp = 1000, weft = 1000, shear = 40;  // N/m; only their ratios count
  double border = 20;               // how much stiffer the border is than the cloth: seams must keep their length
  Vec3 grain{0, 1, 0};              // laid along +v, as far as the sheet as a whole allows
  std::vector<std::uint32_t> fold;  // points laid exactly on the line u = 0 (the centre of a symmetric half)
  Gates gates;
  int maxSteps = 60;  // Newton steps of each energy
};

struct Flattened {
  std::vector<Flat> flat;  // of each point; no triangle is turned over
  Distortion distortion;
};

// A sheet is a disk of triangles with its border in order (see Patch).
Result<Flattened> flatten(const TriangleMesh& sheet, std::span<const std::uint32_t> border,
                          const FlattenSettings& settings, const Token& token);

// The same from a first guess without folds, e.g. the flat places a remeshed patch already has.
Result<Flattened> flattenFrom(std::span<const Flat> guess, const TriangleMesh& sheet,
                              std::span<const std::uint32_t> border, const FlattenSettings& settings,
                              const Token& token);

// A map without folds good enough to work in (steps one and two only).
Result<std::vector<Flat>> unfold(const TriangleMesh& sheet, std::span<const std::uint32_t> border, const Token& token);

// After a sheet's points moved in space from `before` to `after`: where its paper points go when the cloth's strain in
// space stays what it was. Points that did not move at all stay exactly where they are.
Result<std::vector<Flat>> reflatten(std::span<const Flat> flat, std::span<const Triangle> faces,
                                    std::span<const Vec3> before, std::span<const Vec3> after, const Token& token);

// Carries some points of a flat sheet and lets the others follow evenly (harmonically).
struct Carried {
  std::uint32_t point = 0;
  Flat by;
};
std::vector<Flat> carryAlong(std::span<const Flat> flat, std::span<const Triangle> faces,
                             std::span<const Carried> held);

Distortion distortionOf(std::span<const Flat> flat, const TriangleMesh& sheet, std::span<const std::uint32_t> border,
                        const Gates& gates);

}  // namespace karinui
