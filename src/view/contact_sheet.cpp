#include <algorithm>
#include <cmath>

#include "karinui/view/picture.h"
#include "view/legend.h"

namespace karinui {

Result<Image> contactSheet(const std::vector<SheetItem>& items, int columns, std::vector<Message>* notes) {
  if (items.empty()) return badInput(say("A sheet needs at least one picture."));
  const int count = static_cast<int>(items.size());
  if (columns <= 0 || columns > count) columns = count;
  const int rows = (count + columns - 1) / columns;
  int wide = 0, high = 0;
  for (const SheetItem& item : items) wide = std::max(wide, item.image.width), high = std::max(high, item.image.height);
  const double em = std::max(10.0, std::min(wide / 18.0, high / 34.0));
  const int gap = std::max(4, wide / 60), strip = static_cast<int>(2.4 * em);
  const long long allWide = 1LL * columns * (wide + gap) + gap, allHigh = 1LL * rows * (high + strip) + gap;
  if (wide == 0 || high == 0 || allWide > 32768 || allHigh > 32768)
    return badInput(
        say("A sheet of {0}x{1} pixels is too large; take fewer or smaller pictures, at most 32768 pixels a side.",
            allWide, allHigh));
  Image sheet(static_cast<int>(allWide), static_cast<int>(allHigh), {250, 247, 242, 255});
  Lettering lettering;
  for (int i = 0; i < count; ++i) {
    const SheetItem& item = items[static_cast<std::size_t>(i)];
    const int x = gap + i % columns * (wide + gap), y = gap + i / columns * (high + strip);
    sheet.paste(item.image, x + (wide - item.image.width) / 2, y + (high - item.image.height));
    double size = em;
    const double width = lettering.width(item.caption, size);
    if (width > wide) size *= wide / width;
    lettering.write(sheet, item.caption, x + (wide - std::min<double>(wide, width)) / 2, y + high + 1.55 * em, size,
                    kInk);
  }
  if (notes) *notes = lettering.takeNotes();
  return sheet;
}

}  // namespace karinui
