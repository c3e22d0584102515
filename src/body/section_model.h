#pragma once
// The statistical description of adult figures (data/body_sections.json): given girths and height it draws the figure,
// and says the girths and lengths that usually go with them. A child is drawn as a man with a child's proportions.
// Built from the embedded text; a plain value.
#include <map>
#include <string>
#include <vector>

#include "body/figure.h"

namespace karinui {

class SectionModel {
 public:
  static SectionModel of(Sex sex);

  // Fills height, bust, waist, hip and (women) underbust girth where they are not stated. A guess from what is stated.
  Measurements completed(const Measurements& stated) const;
  // The usual value of another measurement; nothing for a key without a rule.
  std::map<std::string, double> usual(const Measurements& complete) const;
  // The figure of a complete set; shapes are clipped to what was seen so that odd proportions do not grow rolls.
  Figure draw(const Measurements& complete) const;
  double distance(const Measurements& complete) const;  // from the middle of what was seen, in standard deviations

 private:
  struct Rows {  // value = (rows[0] + sum rows[i] p_i) / scale, for each of `width` values
    std::vector<std::vector<double>> row;
    std::vector<double> at(const std::vector<double>& p) const;
  };
  struct LimbModel {
    Limb frame;  // harmonics, regions, fractions
    std::vector<std::vector<double>> shape;
    std::vector<Rows> response;  // per station; without the constant row; may be empty
    Rows girth;
    std::vector<Rows> offset;  // per station: forward, sideways
  };
  std::vector<double> predictors(const Measurements& complete) const;
  Limb drawLimb(const LimbModel& model, const std::vector<double>& clipped, const std::vector<double>& girths,
                double height) const;

  Sex sex_ = Sex::Female;
  std::vector<std::string> keys_;
  std::vector<double> mean_, sd_;
  std::vector<std::vector<double>> inverseCovariance_;
  double maxDistance_ = 3.3;
  Rows landmarks_;
  LimbModel torso_, arm_, leg_, foot_;
  std::array<double, 2> thumbRadius_{};
  std::map<std::string, std::vector<double>> rule_;
  std::vector<double> defaultUnderbust_;
};

}  // namespace karinui
