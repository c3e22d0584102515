#pragma once
// Which size of a graded garment is nearest to a figure. How far a garment is round the bust, waist and hips is taken
// from its pieces on paper (make_up.h reads what they are); what it has more than the figure it was made on is its
// ease, and the same ease is wanted on another figure. Metres. Pure; any thread.
#include <optional>
#include <string>
#include <vector>

#include "karinui/body/measurements.h"
#include "karinui/design/document.h"

namespace karinui {

struct SizeFit {
  struct Girth {
    std::string measure;          // "bust_girth", "waist_girth", "hip_girth"
    std::vector<double> ofSizes;  // round the garment, for each size
    double body = 0;              // round the figure that is asked about
    double ease = 0;              // of the size that stands on the figure it was made on; 0: that is not known
    double wanted() const { return body + ease; }
    double miss(std::size_t size) const { return ofSizes[size] - wanted(); }  // above 0: too wide
  };
  std::vector<Girth> girths;
  std::size_t nearest = 0;  // of the grading's sizes: the one whose largest miss is the smallest
  bool easeKnown = false;
};
// `madeOn`: of the figure the garment was made on in the size that stands; null: it was made on none. Nothing: the
// garment has no sizes, or none of these girths is known of garment and figure.
std::optional<SizeFit> sizeFit(const Document& garment, const Measurements* madeOn, const Measurements& figure);

}  // namespace karinui
