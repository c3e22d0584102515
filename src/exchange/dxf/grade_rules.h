#pragma once
// The grade rules of a pattern, numbered. Metres on paper. Pure.
#include <vector>

#include "karinui/exchange/dxf.h"

namespace karinui {

struct NumberedRule {
  Flat place;  // in the base size
  bool corner = false;
  std::size_t number = 0;  // from 1
};

// Rules that are alike to a hundredth of a millimetre, as the files hold them, are one; numbered as they come, piece by
// piece along the outlines.
struct RuleBook {
  std::vector<std::vector<Flat>> rules;                 // rule n is the n-1st
  std::map<PieceId, std::vector<NumberedRule>> places;  // every corner of a graded piece, and its other graded places
};
Result<RuleBook> ruleBook(const Pattern& pattern, const Grading& grading);

// Names of sizes as operations take them, each once; and as these files do, in ASCII.
std::vector<std::string> sizeWords(const std::vector<std::string>& sizes);
std::vector<std::string> asciiSizes(const std::vector<std::string>& sizes);

// The pattern in one of the sizes.
Result<Pattern> patternInSize(const Pattern& pattern, const Grading& grading, std::size_t size);

}  // namespace karinui
