#include "karinui/touch/scene_exchange.h"

#include "karinui/base/result.h"

namespace karinui {

void SceneExchange::free() {
  for (auto& slot : done_)
    if (const TouchScene* scene = slot.exchange(nullptr, std::memory_order_acq_rel)) {
      delete scene;
      ++freed_;
    }
}

SceneExchange::~SceneExchange() {
  free();
  delete waiting_.load();
}

void SceneExchange::publish(std::unique_ptr<const TouchScene> scene) {
  delete waiting_.exchange(scene.release(), std::memory_order_acq_rel);
  free();
}

bool SceneExchange::mayHandBack() const {
  for (const auto& slot : done_)
    if (!slot.load(std::memory_order_acquire)) return true;
  return false;
}

void SceneExchange::handBack(const TouchScene* scene) {
  if (!scene) return;
  for (auto& slot : done_)
    if (!slot.load(std::memory_order_acquire)) return slot.store(scene, std::memory_order_release);
  KARINUI_ASSERT(!"room for a scene that is handed back");
}

}  // namespace karinui
