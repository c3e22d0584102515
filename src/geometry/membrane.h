#pragma once
// Flat triangles against their rest shapes, and Newton steps over them that turn no triangle over.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// A triangle whose rest shape lies in its own little frame. The map from that frame to paper has the gradient
// F = sum over corners of (u, v) times gradient[k]; kept as (du/dx, du/dy, dv/dx, dv/dy).
struct RestTriangle {
  Triangle corner{};
  std::array<Flat, 3> gradient{};
  double area = 0;
  Flat x, y, z;  // the rest corners in the frame
};
// Slivers are thickened to `thinnest` times their longest side so that they do not rule the sum.
RestTriangle restTriangle(const Triangle& corner, Flat a, Flat b, Flat c, double thinnest);
std::vector<RestTriangle> restOf(const TriangleMesh& sheet, double thinnest);
// The frame of a face of a sheet in space: x along its first edge, y to the left of it.
std::array<Flat, 3> laidFace(const TriangleMesh& sheet, const Triangle& face);

using Gradient = Eigen::Vector4d;
Gradient gradientOf(const RestTriangle& rest, std::span<const Flat> flat);
inline double determinant(const Gradient& f) { return f[0] * f[3] - f[1] * f[2]; }
bool foldFree(std::span<const RestTriangle> rest, std::span<const Flat> flat);

// Energy per rest area as a function of F, with a first derivative and a positive semidefinite second one.
struct MembraneTerm {
  double value = 0;
  Eigen::Vector4d slope = Eigen::Vector4d::Zero();
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
};
// |F|^2 + |F^-1|^2, least at rotations, infinite where a triangle folds (Smith & Schaefer 2015).
MembraneTerm symmetricDirichlet(const Gradient& f, bool derivatives);
// The energy cloth that is flat here has when it is strained to the rest shapes: warp along v, weft along u.
struct FabricLaw {
  double warp = 1, weft = 1, shear = 0.04, keep = 0.001;  // keep: a little symmetric Dirichlet, for a firm minimum
  MembraneTerm operator()(const Gradient& f, bool derivatives) const;
};
// How such cloth is stretched along weft and warp, and the cosine between the two afterwards.
struct ClothStretch {
  double weft = 1, warp = 1, cosine = 0;
};
ClothStretch stretchOf(const Gradient& f);

struct FlatProblem {
  std::span<const RestTriangle> rest;
  std::function<MembraneTerm(const Gradient&, bool)> law;
  struct Spring {  // keeps two points at a distance: weight * (l / length - 1)^2
    std::uint32_t a = 0, b = 0;
    double length = 0, weight = 0;
  };
  std::vector<Spring> springs;
  struct Hold {  // keeps a point's u at 0: weight * u^2
    std::uint32_t point = 0;
    double weight = 0;
  };
  std::vector<Hold> holds;
  std::vector<std::uint8_t> pinned;  // 1: the point stays where it is; empty: none
  bool holdTurn = false;             // no turning of the whole
  int maxSteps = 60;
  double enough = 1e-9;  // relative decrease of a step at which it is done
};
// Moves `flat` to a minimum; it must be fold-free and stays so. Stops early when the token is cancelled.
void minimise(const FlatProblem& problem, std::vector<Flat>& flat, const Token& token);

}  // namespace karinui
