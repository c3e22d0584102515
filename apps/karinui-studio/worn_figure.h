#pragma once
#include "karinui/design/apply.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui::studio {

// The figure that a garment is seen on, for whoever asks for it by its hash.
class WornFigure : public MemoryBlobs {
 public:
  explicit WornFigure(const GarmentSnapshot& garment) {
    if (garment.body) own_ = garment.body->ownKept() ? garment.body->ownKept() : garment.body;
  }
  Result<std::string> figure(const std::string& hash) const override {
    return own_ && own_->hash() == hash ? packFigure(*own_) : MemoryBlobs::figure(hash);
  }

 private:
  BodyPtr own_;
};

}  // namespace karinui::studio
