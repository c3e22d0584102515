#pragma once
// A lock-free triple buffer of scenes between one publisher and the servo: at any time one is waiting, one is used and
// one is blended from. The servo takes and hands back pointers; only the publisher's thread allocates and frees.
#include <array>
#include <atomic>
#include <memory>

#include "karinui/touch/touch_scene.h"

namespace karinui {

class SceneExchange {
 public:
  SceneExchange() = default;
  SceneExchange(const SceneExchange&) = delete;
  SceneExchange& operator=(const SceneExchange&) = delete;
  ~SceneExchange();  // when the servo has ended

  // The publisher's thread: a scene that was not taken yet is replaced, those handed back are freed.
  void publish(std::unique_ptr<const TouchScene> scene);
  std::size_t freed() const { return freed_; }

  // The servo's thread, wait-free. take(): the newest scene, null where there is none since the last time.
  const TouchScene* take() { return waiting_.exchange(nullptr, std::memory_order_acq_rel); }
  bool mayHandBack() const;                // false only while the publisher has not come by for kRoom scenes
  void handBack(const TouchScene* scene);  // null: nothing

 private:
  static constexpr std::size_t kRoom = 8;
  void free();
  std::atomic<const TouchScene*> waiting_{nullptr};
  std::array<std::atomic<const TouchScene*>, kRoom> done_{};
  std::size_t freed_ = 0;
};

}  // namespace karinui
