#include "cloth/level_terms.h"

#include "cloth/collider_face_contact.h"
#include "cloth/crease.h"
#include "cloth/edge_bending.h"
#include "cloth/elastic.h"
#include "cloth/fastener.h"

namespace karinui {

namespace {

template <class Base, class Term>
Term* add(std::vector<std::unique_ptr<Base>>& list, std::unique_ptr<Term> term) {
  Term* raw = term.get();
  list.push_back(std::move(term));
  return raw;
}

}  // namespace

LevelEnergies::LevelEnergies(const Cloth& cloth, const GridLayout& layout) {
  membrane = add(list, std::make_unique<Membrane>(cloth, &layout));
  Springs* stretched = add(list, std::make_unique<Springs>(simclothSprings(cloth), cloth.nodeCount));
  if (stretched->count() > 0) simcloth = stretched;
  springs = {stretched, add(list, std::make_unique<Springs>(edgeSprings(cloth), cloth.nodeCount))};
  if (!cloth.elastics.empty())
    springs.push_back(add(list, std::make_unique<Springs>(elasticSprings(cloth), cloth.nodeCount)));
  if (!cloth.foldedBack.empty() || !cloth.trims.empty()) add(list, std::make_unique<EdgeBending>(cloth));
  if (!cloth.creases.empty()) add(list, std::make_unique<CreaseHinges>(cloth));
}

LevelContacts::LevelContacts(const Cloth& cloth, const ColliderList& bodies,
                             const std::vector<ColliderContact::Node>& nodes, const std::vector<NodeIndex>& moving,
                             const std::vector<std::uint8_t>& tied, const SettleSettings& settings,
                             double clothRadius) {
  // The last one to limit a move is obeyed: that is the first of the bodies.
  for (std::size_t k = bodies.entries().size(); k-- > 0;) {
    const ColliderList::Entry& entry = bodies.entries()[k];
    std::vector<ColliderContact::Node> touching = nodes;
    if (entry.friction)
      for (ColliderContact::Node& node : touching) node.friction = *entry.friction;
    colliders.push_back(add(
        list, std::make_unique<ColliderContact>(*entry.collider, std::move(touching), cloth.nodeCount, settings.skin)));
    add(list, std::make_unique<ColliderFaceContact>(cloth, *entry.collider, settings.skin));
  }
  self = add(list, std::make_unique<SelfContact>(cloth, clothRadius));
  seams = add(list, std::make_unique<SeamClosing>(cloth, tied, colliders));
  intersections = add(list, std::make_unique<IntersectionRemoval>(cloth, moving, *self));
  hand = add(list, std::make_unique<HandContact>());
  if (!cloth.fasteners.empty()) add(list, std::make_unique<FastenerContact>(cloth, clothRadius));
}

}  // namespace karinui
