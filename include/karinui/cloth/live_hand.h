#pragma once
// A hand on the cloth while it still moves (see pull.h): the cloth is kept between the hand's moves, each a
// step or a few, none to rest. Metres, seconds, newtons. One caller at a time.
#include "karinui/cloth/pull.h"

namespace karinui {

class LiveHand {
 public:
  // Takes hold of the grip's nodes; of its path only the first place counts, where their middle is. The body and the
  // workers must outlive it.
  static Result<LiveHand> take(ClothLevel level, const ColliderList& colliders, const Grip& grip,
                               const SettleSettings& settings, Workers& workers);
  Result<Vec3> to(Vec3 place, const Token& token);  // leads the middle there; newtons the hand then feels
  const Cloth& cloth() const;
  const std::vector<Vec3>& places() const;  // of the nodes, as they are now

  LiveHand(LiveHand&&) noexcept;
  ~LiveHand();

 private:
  LiveHand();
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace karinui
