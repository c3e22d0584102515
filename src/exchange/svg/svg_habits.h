#pragma once
// What drawing programs do that geometry does not tell: copies by reference, rules of style, names as they encode them,
// and how large their pixel is. Pure; any thread.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "exchange/xml.h"

namespace karinui {

struct WithClones {
  std::vector<XmlElement> elements;
  std::vector<std::string> missing;  // references that lead nowhere in the drawing, each once
  bool tooMany = false;              // the clones are more than can be read; `elements` is not whole
};
// Every <use> as a group that holds what it refers to, where it stands; drawings within drawings as groups too. Those
// for whose reference `leave` says yes stay as they are.
WithClones withClones(const std::vector<XmlElement>& elements, bool (*leave)(const std::string& reference));

// The rules for single classes in a drawing's <style>: ".st1 { display: none }". Other selectors are passed over.
class SvgStyles {
 public:
  explicit SvgStyles(const std::vector<XmlElement>& elements);
  // A property as SVG finds it: the style attribute goes before the rules of classes, these before attributes.
  std::string of(const XmlElement& element, const std::string& key) const;

 private:
  void read(std::string_view sheet);
  std::map<std::string, std::map<std::string, std::string>> rules_;  // by class, the last word counts
};

// Adobe Illustrator draws 72 pixels to the inch, Inkscape before 0.92 90, all others 96.
int pixelsPerInch(std::string_view svg, const XmlElement& root);
bool isFromIllustrator(std::string_view svg, const XmlElement& root);
// Illustrator's ids: "Back_x5F_left_1_" is "Back_left".
std::string illustratorName(std::string_view id);

}  // namespace karinui
