#pragma once
// Curvature where the lattice's own second differences end: in the ring and along it. That part of the piece is divided
// into a region around each node. By Gauss's theorem a region's mean curvature is the sum, along its outline, of how
// steeply the cloth runs there; two regions that share a stretch of outline share the slope there, and so do region and
// lattice. Slopes are right for every quadratic, so every region feels a cylinder as bent as it is; and as all is
// shared, an evenly bent piece is nowhere out of balance but on its edges. (Energies that have only the first are soft
// along every border that runs askew: a strip of four cells cut on the bias fell 8 % too far.) After Chen, Wu, Yoon and
// You 2001, stabilised conforming nodal integration.
#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "cloth/lattice_shares.h"

namespace karinui {

// What the quadratic that fits the nodes around one best says, as weights of their places.
struct Fit {
  std::vector<std::uint32_t> nodes;  // of the lattice
  Eigen::MatrixXd slope;             // 2 x n: along weft and warp, at the node
  Eigen::MatrixXd curvature;         // 3 x n: k_uu, k_uv, k_vv
  Eigen::MatrixXd leftover;          // n x n: what it leaves over, squared, weighted, in 1/m4
};

struct BendRegion {
  std::vector<std::uint32_t> members;                              // nodes whose surroundings it is
  std::vector<std::uint32_t> nodes;                                // whose places it asks for
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> rows;  // k_uu, k_uv, k_vv from them
  double area = 0, ring = 0;                                       // m2; the twist is asked for in the ring alone
};

struct BorderBending {
  std::vector<Fit> fits;  // per node; empty for those that the lattice speaks for
  std::vector<BendRegion> regions;
};
// `held`: per node of the lattice. Regions are either of held nodes or of free ones.
BorderBending borderBending(const Lattice& lattice, const LatticeShares& shares,
                            const std::vector<std::vector<std::uint32_t>>& near, const std::vector<std::uint8_t>& held);

}  // namespace karinui
