#pragma once
// Paper patterns that are traced.
// Conventions of the structs: field.h.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/operations/field.h"
#include "karinui/design/values.h"

namespace karinui {

// underlay photo=HASH width=60cm        underlay between="0,0; 20cm,0" apart=20.4cm        underlay none=yes
// Places lie on the table, where the scan shows them now. What is not said stays as it was.
struct LayUnderlay {
  static constexpr std::string_view kName = "underlay";
  static constexpr std::string_view kHelp = "Lays a scan or photograph of a paper pattern under the pattern, to trace.";
  std::string name, photo;
  std::optional<Length> width;
  std::optional<Flat> at;
  std::optional<Angle> turn;
  std::vector<Flat> between, upright, corners;
  Length apart;
  std::optional<Flat> rectangle;
  std::optional<double> strength;
  std::optional<bool> hidden;
  bool none = false;
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", self.name, "the scan's name, where there are several", kOptional);
    visit("photo", self.photo, "the photograph, by its name among the document's blobs", kOptional);
    visit("width", self.width, "true width of the whole picture (otherwise as at 150 dots an inch)", kOptional);
    visit("at", self.at, "where its middle lies on the table", kOptional);
    visit("turn", self.turn, "its angle, counter-clockwise", kOptional);
    visit("between", self.between, "two places on the scan; the first stays where it is", kOptional);
    visit("apart", self.apart, "how far these two are from each other on the paper: the scan becomes that large",
          kOptional);
    visit("upright", self.upright, "two places on a line of the scan that is turned upright, as its grain line",
          kOptional);
    visit("corners", self.corners,
          "the four corners of a rectangle, in order: a photograph taken at a slant is straightened", kOptional);
    visit("rectangle", self.rectangle, "how long it is from the first corner to the second, and to the third",
          kOptional);
    visit("strength", self.strength, "how strongly the scan shows, up to 1", kOptional);
    visit("hidden", self.hidden, "yes: it is not shown", kOptional);
    visit("none", self.none, "yes: takes it out", kOptional);
  }
  bool operator==(const LayUnderlay&) const = default;
};

using TracingOperations = OperationList<LayUnderlay>;

}  // namespace karinui
