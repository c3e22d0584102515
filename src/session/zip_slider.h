#pragma once
// The sliders of a garment's zips, and where they run. Pure.
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/document.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

// A place a slider runs over: on the side that lies over and on the one under it.
struct ZipPlace {
  struct Side {
    PieceId piece;
    Flat paper;
    Vec3 space;
  };
  Side over, under;
};

class ZipWay {
 public:
  // Nothing of what is no zip, or has lost a side.
  static std::optional<ZipWay> of(const Document& document, const std::string& name);
  const std::string& name() const { return name_; }
  double whole() const { return whole_; }    // metres of the zip
  double closed() const { return closed_; }  // metres that are closed
  ZipPlace at(double closed) const;          // where the slider is when so much is closed
  // How much is closed when the slider is drawn to where the hand points, in steps of a hand; the ends are full ends.
  double drawnTo(const PointerSample& sample, const TableLayout& table) const;
  // How far from the slider the hand points, in the sample's reach.
  double away(const PointerSample& sample, const TableLayout& table) const;

 private:
  std::string name_;
  double whole_ = 0, closed_ = 0;
  std::vector<ZipPlace> places_;  // evenly, from all open to all closed
};
std::vector<ZipWay> zipsOf(const Document& document);

}  // namespace karinui
