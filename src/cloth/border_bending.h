#pragma once
// Curvature where the lattice's own second differences end: in the ring and along it. That part of the piece is divided
// into a region around each node. By Gauss's theorem the mean curvature of a region is the sum of slopes times outward
// normals along its outline. Two regions that share a stretch of outline share its slope, and so do a region and the
// lattice. Slopes are exact for quadratics, so that every region of a cylinder has the right curvature; and as slopes
// are shared, an evenly bent piece is in balance everywhere but on its edges. (An energy with the first property only
// is too soft along every border askew to the grid: a strip of four cells cut on the bias fell 8 % too far.) After
// Chen, Wu, Yoon and You 2001, stabilised conforming nodal integration.
#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "cloth/lattice_areas.h"

namespace karinui {

// The least-squares quadratic around a node, as weights of the positions of the nodes it is fitted to.
struct QuadraticFit {
  std::vector<std::uint32_t> nodes;  // of the lattice
  Eigen::MatrixXd slope;             // 2 x n: along weft and warp, at the node
  Eigen::MatrixXd curvature;         // 3 x n: k_uu, k_uv, k_vv
  Eigen::MatrixXd leftover;          // n x n: its squared residual, weighted, in 1/m4
};

struct BendRegion {
  std::vector<std::uint32_t> members;                              // nodes it belongs to
  std::vector<std::uint32_t> nodes;                                // whose positions it depends on
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows;  // k_uu, k_uv, k_vv from them
  double area = 0, ring = 0;                                       // m2; the twist counts in the ring alone
};

struct BorderBending {
  std::vector<QuadraticFit> fits;  // per node; empty for nodes with a stencil of the lattice
  std::vector<BendRegion> regions;
};
// `held`: per node of the lattice. Regions are either of held nodes or of free ones.
BorderBending borderBending(const Lattice& lattice, const LatticeAreas& shares,
                            const std::vector<std::vector<std::uint32_t>>& near, const std::vector<std::uint8_t>& held);

}  // namespace karinui
