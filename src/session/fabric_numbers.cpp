#include "karinui/session/fabric_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "karinui/base/number.h"

namespace karinui {

namespace {

double threeDigits(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 3);
  std::from_chars(text.begin(), end.ptr, value);
  return value;
}

Fabric presetOf(const MeasuredFabric& measured) {
  const auto like = preset(measured.like);
  return like ? *like : Fabric();
}

constexpr double kMicro = 1e6;  // bending is read in micronewton metres

std::string withUnit(const MeasuredRow& row, double value) {
  if (!row.number) return fixed(value * kMicro, 2) + " µN m";
  return fixed(value * row.number->factor, row.number->decimals) + row.number->unit;
}

}  // namespace

std::span<const FabricNumber> fabricNumbers() {
  static const std::vector<FabricNumber> all{
      {say("weight"), " g/m²", 1000, 3000, 0, &Fabric::weight, &SetFabric::weight},
      {say("stretch, warp"), " N/m", 1, 1e6, 0, &Fabric::stretchWarp, &SetFabric::stretchWarp},
      {say("stretch, weft"), " N/m", 1, 1e6, 0, &Fabric::stretchWeft, &SetFabric::stretchWeft},
      {say("toe, warp"), " %", 100, 50, 2, &Fabric::toeWarp, &SetFabric::toeWarp},
      {say("toe, weft"), " %", 100, 50, 2, &Fabric::toeWeft, &SetFabric::toeWeft},
      {say("stiffening, warp"), "", 1, 1e5, 0, &Fabric::stiffenWarp, &SetFabric::stiffenWarp},
      {say("stiffening, weft"), "", 1, 1e5, 0, &Fabric::stiffenWeft, &SetFabric::stiffenWeft},
      {say("shear"), " N/m", 1, 1e5, 1, &Fabric::shear, &SetFabric::shear},
      {say("stiffening, shear"), "", 1, 1000, 2, &Fabric::shearStiffen, &SetFabric::shearStiffen},
      {say("bending, warp"), " µN m", kMicro, 1e5, 2, &Fabric::bendWarp, &SetFabric::bendWarp},
      {say("bending, weft"), " µN m", kMicro, 1e5, 2, &Fabric::bendWeft, &SetFabric::bendWeft},
      {say("thickness"), " mm", 1000, 20, 2, &Fabric::thickness, nullptr},
      {say("friction on skin"), "", 1, 2, 2, &Fabric::frictionBody, &SetFabric::frictionBody},
      {say("friction on cloth"), "", 1, 2, 2, &Fabric::frictionCloth, &SetFabric::frictionCloth}};
  return all;
}

std::string clothOf(const Document& document, const std::set<PieceId>& chosen) {
  if (const Piece* piece = chosen.empty() ? nullptr : document.find(*chosen.begin())) return piece->fabric;
  std::map<std::string, double> area;
  for (const auto& [id, piece] : document.pattern.pieces) area[piece->fabric] += piece->outline.area();
  const auto most =
      std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == area.end() ? std::string() : most->first;
}

void cutFromItsCloth(Operation& operation, const Document& document, const std::set<PieceId>& chosen) {
  const auto cut = [&](std::string& fabric) {
    const std::string own = clothOf(document, chosen);
    if (fabric.empty() && own != Piece().fabric) fabric = own;
  };
  if (auto* drawn = std::get_if<DrawPiece>(&operation)) cut(drawn->fabric);
  if (auto* rectangle = std::get_if<DrawRectangle>(&operation)) cut(rectangle->fabric);
  if (auto* polygon = std::get_if<DrawPolygon>(&operation)) cut(polygon->fabric);
  if (auto* ring = std::get_if<DrawRing>(&operation)) cut(ring->fabric);
}

SetFabric described(const Fabric& now, const Fabric& was) {
  SetFabric set;
  for (const FabricNumber& one : fabricNumbers()) {
    if (now.*one.value == was.*one.value) continue;
    if (one.step)
      set.*one.step = now.*one.value;
    else
      set.thickness = Length{now.*one.value};
  }
  return set;
}

SetFabric fabricStep(const MeasuredFabric& measured, std::string name) {
  const Fabric like = presetOf(measured);
  Fabric rounded = measured.fabric;
  for (const FabricNumber& one : fabricNumbers())
    if (rounded.*one.value != like.*one.value) rounded.*one.value = threeDigits(rounded.*one.value);
  SetFabric set = described(rounded, like);
  set.name = std::move(name), set.like = measured.like;
  return set;
}

std::vector<MeasuredRow> rowsOf(const MeasuredFabric& measured) {
  std::vector<MeasuredRow> rows;
  const Fabric like = presetOf(measured);
  for (const FabricNumber& one : fabricNumbers()) {
    MeasuredRow row{&one, one.label, measured.fabric.*one.value, {}, like.*one.value};
    for (const MeasuredNumber& number : measured.numbers)
      if (number.field == one.value) row.error = number.value.error;
    if (row.error || row.value != row.like) rows.push_back(std::move(row));
  }
  if (measured.bendBias)
    rows.push_back(
        {nullptr, say("bending, bias"), measured.bendBias->value, measured.bendBias->error, measured.bendBiasOfFabric});
  return rows;
}

std::string MeasuredRow::valueText() const { return withUnit(*this, value); }
std::string MeasuredRow::errorText() const { return error ? "± " + withUnit(*this, 2 * *error) : ""; }
std::string MeasuredRow::likeText() const { return withUnit(*this, like); }

double uncertaintyOf(double halfWidth) { return halfWidth / std::sqrt(3.0); }

}  // namespace karinui
