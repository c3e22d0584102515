#pragma once
// Conjugate gradients pass a force on from node to node, an iteration each; long waves take hundreds. Here they are met
// at once: a net of coarse nodes, one for every eight lattice nodes each way (fewer in very fine cloth), moves running
// straight between them, and the step's matrix as such moves feel it, factored. What it finds is added to what the
// diagonal finds: a two-level additive Schwarz preconditioner (Smith, Bjorstad, Gropp: Domain Decomposition, 1996,
// chapter 1).
//
// The factored matrix may be older than the step's: that costs iterations, never truth.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "cloth/envelope.h"
#include "cloth/panel_product.h"

namespace karinui {

// A slot that is no unknown of its own moves with others'.
struct Guest {
  std::uint32_t slot = 0, home = 0;
  float weight = 1;
};

class CoarseSpace {
 public:
  // Both must outlive this.
  CoarseSpace(const Cloth& cloth, const PanelPlan& plan);

  void setTies(std::span<const std::uint32_t> homes, std::span<const Guest> guests);  // forgets the matrix
  // Takes up the matrix anew. `product`: p = 0 moved by every part (`turn`, beta 0), q = A p, every part feels q.
  // Whether it could be factored.
  bool refresh(const std::function<void()>& product);
  bool ready() const { return ready_; }

  // What coarse moves feel of a part's residual; for different parts from different threads.
  void feel(const SlotPart& part, const Lanes3& r);
  // Finds the coarse move that answers all parts' residuals; returns residual . move. On one thread.
  double answer();
  // p = z + beta p + the move, for a part.
  void turn(const SlotPart& part, const Lanes3& z, float beta, Lanes3& p) const;

 private:
  struct Lines {                      // coarse lines along one side of a piece's grid
    std::vector<std::uint32_t> at;    // which fine line each is
    std::vector<std::uint32_t> cell;  // per fine line: the coarse one before it,
    std::vector<float> next;          // and how far it is on the way to the next; padded
    Lines(std::uint32_t fine, double each);
    std::pair<std::uint32_t, double> place(double fine) const;  // the same for any place
  };
  struct Share {
    std::uint32_t node = 0;  // coarse
    float weight = 0;
  };
  using Shares = std::array<Share, 4>;
  struct Net {
    const Panel* panel = nullptr;  // null: all its nodes are loose
    Lines column, row;
    std::uint32_t first = 0;  // coarse node
    std::uint32_t columns() const { return static_cast<std::uint32_t>(column.at.size()); }
    std::uint32_t rows() const { return static_cast<std::uint32_t>(row.at.size()); }
  };
  struct Felt {  // by a part's slots, of these coarse nodes; three axes, one after the other
    std::uint32_t first = 0, count = 0;
    std::vector<float> value;
  };
  void addNet(const ClothPiece& piece, const Panel* panel);
  Felt reachOf(const SlotPart& part) const;
  std::pair<std::uint32_t, std::uint32_t> coarseRows(const SlotPart& part) const;  // the first, and how many
  void sumUp();                                                                    // value_ = what was felt
  Shares sharesAt(const Net& net, double column, double row) const;
  void number();  // the coarse nodes that move something
  void meet();    // which of them feel each other
  void colour();  // sets of them that nothing feels two of

  const Cloth& cloth_;
  const PanelPlan& plan_;
  std::vector<Net> nets_;
  std::vector<std::uint32_t> netOf_;  // per panel
  std::uint32_t nodes_ = 0;           // coarse
  std::vector<Shares> shares_;        // per slot
  std::vector<float> free_;           // per slot: 1 for an unknown's own, else 0
  std::vector<Guest> guests_;
  std::vector<std::uint32_t> numberOf_, nodeOf_;     // of coarse nodes that move something, and back
  std::vector<std::vector<std::uint32_t>> around_;   // numbers that feel a number
  std::vector<std::vector<std::uint32_t>> colours_;  // numbers
  std::array<std::vector<float>, 3> value_;          // per coarse node: what it feels, then how it moves
  std::vector<Felt> felt_;                           // per part of the plan
  Envelope matrix_;
  std::vector<float> found_;
  bool numbered_ = false, ready_ = false;
};

}  // namespace karinui
