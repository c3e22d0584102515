#pragma once
// The looks of a document as a renderer draws them. Pure but for the photographs, which are read once each; the
// functions may be called by any thread, a PrintShelf by one at a time.
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "karinui/design/apply.h"
#include "karinui/scene/cloth_look.h"

namespace karinui {

Colour linear(Dye dye);

using Prints = std::function<std::shared_ptr<const PrintImage>(const std::string& photo)>;  // null: it cannot be read
// `origin`: where on the paper the print begins.
ClothLook clothLookOf(const Look& look, const Fabric& fabric, Flat grain, Flat origin, const Prints& prints);

// The right side of cloth turned to the other side of its surface.
void turnInsideOut(Colour& colour, ClothLook& look);

// Photographs of a document, kept when they were read.
class PrintShelf {
 public:
  std::shared_ptr<const PrintImage> find(const std::string& photo, const Blobs& blobs);

 private:
  std::map<std::string, std::shared_ptr<const PrintImage>> read_;
};

}  // namespace karinui
