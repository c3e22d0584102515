#pragma once
// Assembles the Galerkin matrix A_c = P^T A P of a coarse space from the terms that the step's matrix A is made of
// (galerkin_part.h), by several threads.
//
// Each thread collects the entries of a part in lists by their rows of A_c; then each adds the lists of some rows, part
// after part. So every entry of A_c is added up in the order in which one thread does it, and has its bits.
#include "cloth/galerkin_part.h"
#include "karinui/base/workers.h"

namespace karinui {

class GalerkinMatrix {
 public:
  // `out`: three rows and columns for each of `numbers`, to be added to.
  void assemble(const GalerkinSource& of, std::span<const CoarseGrid> grids, std::size_t numbers, EnvelopeCholesky& out,
                Workers& workers);

 private:
  std::vector<std::vector<GalerkinEntry>> lists_;  // of each part as many; kept for their memory
};

}  // namespace karinui
