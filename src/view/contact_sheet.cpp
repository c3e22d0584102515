#include <algorithm>
#include <cmath>

#include "karinui/view/picture.h"
#include "view/legend.h"

namespace karinui {
namespace {

constexpr int kMostPixels = 32768;
constexpr Pixel kPaper{250, 247, 242, 255}, kMark{178, 38, 30, 255};
constexpr double kSmaller = 0.82, kLead = 1.3;  // of a line below the caption, and between lines, in em
constexpr std::size_t kMostLines = 4;

// A text broken where it is too wide: at its last space, or anywhere where it has none (Japanese).
std::vector<std::string> broken(Lettering& lettering, const std::string& words, double size, double room) {
  std::vector<std::string> lines;
  std::string rest = words;
  while (!rest.empty() && lines.size() < kMostLines) {
    std::size_t end = 0, space = 0;  // bytes
    while (end < rest.size()) {
      std::size_t next = end + 1;
      while (next < rest.size() && (rest[next] & 0xC0) == 0x80) ++next;  // a letter is whole
      if (lettering.width(rest.substr(0, next), size) > room && end > 0) break;
      if (rest[end] == ' ') space = end;
      end = next;
    }
    const std::size_t cut = end < rest.size() && space > 0 ? space : end;
    const bool last = lines.size() + 1 == kMostLines && cut < rest.size();
    lines.push_back(rest.substr(0, cut) + (last ? "…" : ""));
    rest.erase(0, rest[std::min(cut, rest.size() - 1)] == ' ' ? cut + 1 : cut);
  }
  return lines;
}

// The words of one picture, ready to be written.
struct Words {
  std::vector<std::string> lines;  // the first is the caption
  double high(double em) const {
    return em * (1.1 + kLead + (lines.size() > 1 ? kLead * kSmaller * static_cast<double>(lines.size() - 1) : 0));
  }
};

// The measures of a sheet of such pictures, in pixels.
struct Room {
  Room(int wide, int high, bool joined)
      : em(std::max(10.0, std::min(wide / 18.0, high / 34.0))),
        margin(std::max(4, wide / 60)),
        gap(joined ? 0 : margin) {}
  double em;
  int margin, gap;
  long long across(int columns, int wide) const { return 1LL * columns * (wide + gap) - gap + 2LL * margin; }
};

Words wordsOf(Lettering& lettering, const SheetItem& item, double em, double room) {
  Words words{{item.caption}};
  for (const std::string& below : item.below)
    for (std::string& line : broken(lettering, below, em * kSmaller, room)) words.lines.push_back(std::move(line));
  return words;
}

}  // namespace

SheetCell sheetCell(int count, SheetLayout layout) {
  const int columns = layout.columns <= 0 || layout.columns > count ? count : layout.columns;
  const int rows = (count + columns - 1) / columns;
  const Words caption{{""}};
  SheetCell cell{layout.width / columns, layout.height / rows};
  const auto room = [&] { return Room(cell.width, cell.height, layout.joined); };
  while (cell.width > 1 && room().across(columns, cell.width) > layout.width) --cell.width;
  while (cell.height > 1 &&
         1LL * rows * (cell.height + static_cast<int>(caption.high(room().em))) + 2LL * room().margin > layout.height)
    --cell.height;
  return cell;
}

Result<Image> contactSheet(const std::vector<SheetItem>& items, SheetLayout layout, std::vector<Message>* notes) {
  if (items.empty()) return badInput(say("A sheet needs at least one picture."));
  const int count = static_cast<int>(items.size());
  const int columns = layout.columns <= 0 || layout.columns > count ? count : layout.columns;
  int wide = 0, high = 0;
  for (const SheetItem& item : items) wide = std::max(wide, item.image.width), high = std::max(high, item.image.height);
  const Room room(wide, high, layout.joined);
  const double em = room.em;
  const int margin = room.margin, gap = room.gap;
  Lettering lettering;
  std::vector<Words> words;
  std::vector<int> tops{margin};  // of the rows, and the end of the last
  for (int i = 0; i < count; ++i) {
    words.push_back(wordsOf(lettering, items[static_cast<std::size_t>(i)], em, wide - em));
    const int strip = static_cast<int>(words.back().high(em));
    if (i % columns == 0) tops.push_back(0);
    const int top = tops[tops.size() - 2];
    tops.back() = std::max(tops.back(), top + high + strip);
  }
  const long long allWide = std::max<long long>(room.across(columns, wide), layout.width),
                  allHigh = std::max<long long>(1LL * tops.back() + margin, layout.height);
  if (wide == 0 || high == 0 || allWide > kMostPixels || allHigh > kMostPixels)
    return badInput(
        say("A sheet of {0}x{1} pixels is too large; take fewer or smaller pictures, at most 32768 pixels a side.",
            allWide, allHigh));
  Image sheet(static_cast<int>(allWide), static_cast<int>(allHigh), kPaper);
  const int left = margin + static_cast<int>(allWide - room.across(columns, wide)) / 2;
  for (int i = 0; i < count; ++i) {
    const SheetItem& item = items[static_cast<std::size_t>(i)];
    const int x = left + i % columns * (wide + gap), y = tops[static_cast<std::size_t>(i / columns)];
    sheet.paste(item.image, x + (wide - item.image.width) / 2, y + (high - item.image.height));
    const Pixel ink = item.marked ? kMark : kInk;
    if (item.marked)
      for (int v = 0; v < static_cast<int>(0.25 * em); ++v)
        for (int u = static_cast<int>(0.3 * em); u < wide - static_cast<int>(0.3 * em); ++u)
          sheet.set(x + u, y + high + v, kMark);
    double below = y + high + 1.55 * em;
    for (std::size_t k = 0; k < words[static_cast<std::size_t>(i)].lines.size(); ++k) {
      const std::string& line = words[static_cast<std::size_t>(i)].lines[k];
      double size = k == 0 ? em : em * kSmaller;
      const double width = lettering.width(line, size);
      if (width > wide) size *= wide / width;
      lettering.write(sheet, line, x + (wide - std::min<double>(wide, width)) / 2, below, size, ink);
      below += kLead * em * (k == 0 ? 0.95 : kSmaller);
    }
  }
  if (notes) *notes = lettering.takeNotes();
  return sheet;
}

}  // namespace karinui
