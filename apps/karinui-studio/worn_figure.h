#pragma once
#include "karinui/design/apply.h"

namespace karinui::studio {

// The figure that a garment is seen on, in its own pose, for whoever asks for it by its hash: nothing is built anew.
class WornFigure : public MemoryBlobs {
 public:
  explicit WornFigure(const BodyPtr& body) : own_(body && body->ownKept() ? body->ownKept() : body) {}
  Result<std::string> figure(const std::string& hash) const override {
    return own_ && own_->hash() == hash ? packFigure(*own_) : MemoryBlobs::figure(hash);
  }

 private:
  BodyPtr own_;
};

}  // namespace karinui::studio
