#include "karinui/view/line_up.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/base/number.h"
#include "karinui/view/strain_scale.h"

namespace karinui {

namespace {
constexpr int kLongRow = 6;  // turns of one figure; more take two rows
constexpr double kWhole = 2 * std::numbers::pi;
}  // namespace

LineUp::LineUp(std::vector<Figure> figures, std::span<const SceneFrame> frames, PictureOptions each)
    : figures_(std::move(figures)), frames_(frames), each_(std::move(each)), easels_(1) {
  KARINUI_ASSERT(figures_.size() == frames_.size());
  const double aspect = static_cast<double>(each_.width) / each_.height;
  if (each_.camera) {
    camera_ = *each_.camera;
    const Vec3 axis{camera_.target.x, 0, camera_.target.z};
    camera_.eye -= axis, camera_.target -= axis;
    axes_.assign(figures_.size(), axis);
  } else {
    std::vector<SceneFrame> framed;
    for (const SceneFrame& frame : frames_) framed.push_back(worn(frame));
    camera_ = frameTurning(framed, each_.view, aspect);
    for (const SceneFrame& frame : framed) axes_.push_back(axisOf(frame));
  }
  if (each_.map == Map::Strain || (each_.map == Map::Pressure && each_.mapTop <= 0))
    for (const SceneFrame& frame : frames_) each_.mapTop = std::max(each_.mapTop, strainTop(frame));
}

Result<Image> LineUp::see(std::size_t which, double turn, InRow row, bool legend) {
  Easel& easel = easels_[which % easels_.size()];
  if (!easel.picture) {
    auto opened = Picture::open();
    if (!opened) return opened.error();
    easel.picture = *std::move(opened);
  }
  PictureOptions how = each_;
  how.camera = walkedRound(camera_, axes_[which], turn);
  how.row = row;
  how.lettering = each_.lettering && legend;
  if (each_.mapTop > 0 && strainTop(frames_[which]) == 0) how.map = Map::None;  // wears nothing
  auto image = easel.shows == which ? easel.picture->again(how) : easel.picture->draw(frames_[which], how);
  easel.shows = image ? which : ~std::size_t{0};
  const std::string& name = figures_[which].name;
  for (const Message& note : easel.picture->notes())
    notes_.push_back(name.empty() ? note : say("{0}: {1}", name, note));
  return image;
}

Result<Image> LineUp::laidOut(const std::vector<SheetItem>& items, int columns) {
  std::vector<Message> unwritten;
  Result<Image> sheet = contactSheet(
      items, {.columns = columns, .joined = true, .width = fill_.first, .height = fill_.second}, &unwritten);
  notes_.insert(notes_.end(), unwritten.begin(), unwritten.end());
  return sheet;
}

Result<Image> LineUp::draw(double turn, int columns, const Token& token) {
  notes_.clear();
  const int count = static_cast<int>(figures_.size());
  if (columns <= 0 || columns > count) columns = count;
  if (count == 1 && figures_[0].name.empty()) return see(0, turn, {}, true);
  std::vector<SheetItem> items;
  for (int k = 0; k < count; ++k) {
    if (token.cancelled()) return cancelled();
    const auto which = static_cast<std::size_t>(k);
    auto image = see(which, turn, {k % columns, columns}, k == columns - 1);
    if (!image) return image.error();
    items.push_back({*std::move(image), figures_[which].name, figures_[which].below, figures_[which].marked});
  }
  return laidOut(items, columns);
}

Result<Image> LineUp::turns(int count, const Token& token) {
  notes_.clear();
  const bool alone = figures_.size() == 1;
  const int columns = alone && count > kLongRow ? (count + 1) / 2 : count;
  std::vector<SheetItem> items;
  for (std::size_t which = 0; which < figures_.size(); ++which)
    for (int k = 0; k < count; ++k) {
      if (token.cancelled()) return cancelled();
      const double share = static_cast<double>(k) / count;
      auto image = see(which, kWhole * share, {k % columns, columns}, which == 0 && k == columns - 1);
      if (!image) return image.error();
      const std::string turned = fixed(360 * share, 360 % count == 0 ? 0 : 1) + "°";
      SheetItem item{*std::move(image), alone ? turned : figures_[which].name + ", " + turned};
      if (k == 0) item.below = figures_[which].below;
      item.marked = figures_[which].marked;
      items.push_back(std::move(item));
    }
  return laidOut(items, columns);
}

}  // namespace karinui
