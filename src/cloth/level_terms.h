#pragma once
// The energies and contacts that act on a level of cloth: the lists that LevelSolver goes through. A new one is a class
// and one line in level_terms.cpp (docs/develop/howto.md). Sums are taken in the order of the lists, so the order is
// part of a drape's bits: what is new comes last. The grid blocks' membrane and the bending are not in the lists, since
// the step's matrix is made around them.
#include <memory>
#include <vector>

#include "cloth/collider_contact.h"
#include "cloth/hand_contact.h"
#include "cloth/intersection_removal.h"
#include "cloth/membrane.h"
#include "cloth/seam_closing.h"
#include "cloth/self_contact.h"
#include "cloth/springs.h"
#include "karinui/cloth/settle.h"

namespace karinui {

using BlockEnergies = std::vector<std::unique_ptr<BlockEnergy>>;
using Contacts = std::vector<std::unique_ptr<Contact>>;

// The pointers are to what is in the list: what the solver asks by its kind.
struct LevelEnergies {
  // The cloth and the layout must outlive it.
  LevelEnergies(const Cloth& cloth, const GridLayout& layout);

  BlockEnergies list;
  const Membrane* membrane = nullptr;
  std::vector<const Springs*> springs;
  Springs* simcloth = nullptr;  // of springs; null: none of the pieces is
};

struct LevelContacts {
  // The cloth, the colliders, `moving` and `tied` must outlive it. `nodes`: those that move, with the fabrics' own
  // friction; `moving`:
  // the same by index. `tied`: of each tie of the cloth, whether it is closed. `clothRadius`: how near cloth comes to
  // cloth, metres.
  LevelContacts(const Cloth& cloth, const ColliderList& colliders, const std::vector<ColliderContact::Node>& nodes,
                const std::vector<NodeIndex>& moving, const std::vector<std::uint8_t>& tied,
                const SettleSettings& settings, double clothRadius);
  LevelContacts(const LevelContacts&) = delete;  // its contacts refer to each other
  LevelContacts& operator=(const LevelContacts&) = delete;

  Contacts list;
  std::vector<const ColliderContact*> colliders;
  SelfContact* self = nullptr;
  SeamClosing* seams = nullptr;
  IntersectionRemoval* intersections = nullptr;
  HandContact* hand = nullptr;
};

// What someone adds to a solver of their own, after all others: a test, an experiment.
struct AddedTerms {
  BlockEnergies energies;
  Contacts contacts;
};

}  // namespace karinui
