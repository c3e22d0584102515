#include "board_images.h"

#include <algorithm>
#include <cmath>

#include "karinui/scene/icon.h"

namespace karinui::room {

namespace {

constexpr Pixel kBoard{247, 243, 236, 240}, kRim{190, 178, 160, 255}, kInk{40, 36, 32, 255}, kFaint{150, 142, 132, 255},
    kAccent{176, 68, 30, 255}, kChosen{244, 218, 200, 255}, kHot{228, 220, 208, 255}, kRefused{170, 40, 30, 255},
    kAdvice{150, 90, 10, 255};

// How far outside a rounded box a place is, pixels; negative inside.
double outside(double x, double y, double left, double top, double right, double bottom, double radius) {
  const double cx = (left + right) / 2, cy = (top + bottom) / 2;
  const double dx = std::fabs(x - cx) - (right - left) / 2 + radius,
               dy = std::fabs(y - cy) - (bottom - top) / 2 + radius;
  return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - radius;
}

void blend(Image& image, int x, int y, Pixel ink, double share) {
  if (share <= 0) return;
  Pixel p = image.at(x, y);
  for (std::size_t c = 0; c < 4; ++c)
    p[c] = static_cast<std::uint8_t>(std::lround(p[c] + (ink[c] - p[c]) * std::min(1.0, share)));
  image.set(x, y, p);
}

void fillBox(Image& image, double left, double top, double right, double bottom, double radius, Pixel ink) {
  const int x0 = std::max(0, static_cast<int>(left) - 1), x1 = std::min(image.width, static_cast<int>(right) + 2);
  const int y0 = std::max(0, static_cast<int>(top) - 1), y1 = std::min(image.height, static_cast<int>(bottom) + 2);
  for (int y = y0; y < y1; ++y) {
    // What lies a pixel inside needs no measuring: a board is written anew for each number on it.
    const double in = y + 0.5 < top + radius || y + 0.5 > bottom - radius ? std::max(1.0, radius) : 1.0;
    const bool across = y + 0.5 >= top + 1 && y + 0.5 <= bottom - 1;
    const int from = std::max(x0, static_cast<int>(std::ceil(left + in))),
              to = across ? std::min(x1, static_cast<int>(std::floor(right - in))) : from;
    for (int x = x0; x < x1; ++x)
      if (x >= from && x < to)
        image.set(x, y, ink);
      else
        blend(image, x, y, ink, 0.5 - outside(x + 0.5, y + 0.5, left, top, right, bottom, radius));
  }
}

// A plate with a rim, all of the picture.
Image plate(int width, int height, double radius) {
  Image image(width, height, {kBoard[0], kBoard[1], kBoard[2], 0});
  fillBox(image, 0.5, 0.5, width - 0.5, height - 0.5, radius, kRim);
  fillBox(image, 2, 2, width - 2, height - 2, radius - 1.5, kBoard);
  return image;
}

void drawIcon(Image& image, std::string_view name, double left, double top, double side, Pixel ink) {
  const Icon* drawn = icon(name);
  if (!drawn) return;
  const double scale = side / 24, half = std::max(0.8, 0.85 * scale);
  for (const IconStroke& stroke : drawn->strokes) {
    std::vector<Flat> points;
    for (const Flat p : stroke.points) points.push_back({left + p.u * scale, top + p.v * scale});
    if (points.empty()) continue;
    double lowX = 1e9, lowY = 1e9, highX = -1e9, highY = -1e9;
    for (const Flat p : points)
      lowX = std::min(lowX, p.u), lowY = std::min(lowY, p.v), highX = std::max(highX, p.u),
      highY = std::max(highY, p.v);
    for (int y = std::max(0, static_cast<int>(lowY - half - 1)); y < std::min<double>(image.height, highY + half + 2);
         ++y)
      for (int x = std::max(0, static_cast<int>(lowX - half - 1)); x < std::min<double>(image.width, highX + half + 2);
           ++x) {
        const Flat here{x + 0.5, y + 0.5};
        double away = 1e9;
        bool inside = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
          const Flat a = points[i], b = points[(i + 1) % points.size()];
          if (stroke.filled && (a.v > here.v) != (b.v > here.v) &&
              here.u < a.u + (here.v - a.v) / (b.v - a.v) * (b.u - a.u))
            inside = !inside;
          if (i + 1 == points.size() && !stroke.filled && points.size() > 1) break;
          const Flat side1 = b - a;
          const double ss = dot(side1, side1), t = ss > 0 ? std::clamp(dot(here - a, side1) / ss, 0.0, 1.0) : 0;
          away = std::min(away, distance(here, a + side1 * t));
        }
        blend(image, x, y, ink, inside ? 1 : half + 0.5 - away);
      }
  }
}

}  // namespace

void liftClear(Board& board, const std::vector<Board>& others) {
  const double wide = length(board.across), high = length(board.upward);
  if (!(wide > 0 && high > 0)) return;
  const Vec3 right = board.across * (1 / wide), up = board.upward * (1 / high);
  for (std::size_t again = 0; again <= others.size(); ++again) {
    double most = 0;
    for (const Board& other : others) {
      const Vec3 from =
          board.corner + (board.across + board.upward) * 0.5 - other.corner - (other.across + other.upward) * 0.5;
      if (std::fabs(dot(from, right)) >= (wide + length(other.across)) / 2) continue;
      const double between = (high + length(other.upward)) / 2, above = dot(from, up);
      if (std::fabs(above) < between * 0.999) most = std::max(most, between - above);
    }
    if (most <= 0) return;
    board.corner += up * most;
  }
}

std::vector<std::string> broken(Lettering& lettering, const std::string& utf8, double pixels, double letterPixels) {
  std::vector<std::string> lines;
  std::string line, word;
  const auto wide = [&](const std::string& s) { return lettering.width(s, letterPixels) > pixels; };
  const auto flush = [&] {
    if (!line.empty() && wide(line + word)) {
      while (line.ends_with(' ')) line.pop_back();
      lines.push_back(std::exchange(line, {}));
      while (word.starts_with(' ')) word.erase(0, 1);
    }
    line += std::exchange(word, {});
  };
  for (std::size_t i = 0; i < utf8.size();) {
    std::size_t bytes = 1;
    while (i + bytes < utf8.size() && (static_cast<unsigned char>(utf8[i + bytes]) & 0xc0) == 0x80) ++bytes;
    const std::string letter = utf8.substr(i, bytes);
    i += bytes;
    if (letter == "\n") {
      flush();
      lines.push_back(std::exchange(line, {}));
    } else if (letter == " ") {
      flush();
      word = " ";
    } else if (bytes >= 3 && letter != "、" && letter != "。" && letter != "」" && letter != "ー") {
      flush();
      word = letter;
    } else {
      word += letter;
    }
  }
  flush();
  if (!line.empty()) lines.push_back(line);
  return lines;
}

template <class Make>
ImagePtr BoardImages::kept(const std::string& key, Make&& make) {
  Kept& found = kept_[key];
  if (!found.image) found.image = std::make_shared<const Image>(make());
  found.used = true;
  return found.image;
}

void BoardImages::tidy() {
  std::erase_if(kept_, [](const auto& one) { return !one.second.used; });
  for (auto& one : kept_) one.second.used = false;
}

ImagePtr BoardImages::panel(const SceneMenu& panel, int pixelsWide, Language language) {
  const double wide = length(panel.across), high = length(panel.upward), scale = pixelsWide / wide;
  const int pixelsHigh = std::clamp(static_cast<int>(std::lround(high * scale)), 1, 4096);
  std::string key = "panel " + std::to_string(pixelsWide) + "x" + std::to_string(pixelsHigh);
  for (const SceneMenu::Button& b : panel.buttons)
    key += "|" + b.icon + "|" + text(b.label, language) + (b.hot ? "h" : "") + (b.chosen ? "c" : "") +
           (b.enabled ? "" : "d");
  return kept(key, [&] {
    const double unit = panel.buttons.empty() ? pixelsWide : panel.buttons.front().height * scale;
    Image image = plate(pixelsWide, pixelsHigh, std::min(14.0, unit * 0.22));
    for (const SceneMenu::Button& b : panel.buttons) {
      const double left = b.left * scale, right = (b.left + b.width) * scale;
      const double bottom = (high - b.bottom) * scale, top = bottom - b.height * scale;
      Pixel ink = !b.enabled ? kFaint : b.chosen ? kAccent : kInk;
      if (b.chosen || (b.hot && b.enabled))
        fillBox(image, left, top, right, bottom, unit * 0.16, b.hot ? kHot : kChosen);
      if (b.chosen && b.hot) fillBox(image, left + 3, top + 3, right - 3, bottom - 3, unit * 0.14, kChosen);
      const std::string caption = text(b.label, language);
      double letter = b.icon.empty() ? unit * 0.36 : unit * 0.23;
      const double most = (right - left) * 0.94;
      if (const double w = lettering_.width(caption, letter); w > most) letter *= most / w;
      const double at = (left + right - lettering_.width(caption, letter)) / 2;
      if (!b.icon.empty())
        drawIcon(image, b.icon, (left + right) / 2 - unit * 0.27, top + unit * 0.09, unit * 0.54, ink);
      lettering_.write(image, caption, at, b.icon.empty() ? (top + bottom) / 2 + letter * 0.36 : bottom - unit * 0.1,
                       letter, ink);
    }
    return image;
  });
}

ImagePtr BoardImages::word(const std::string& utf8, int letterPixels) {
  return kept("word " + std::to_string(letterPixels) + utf8, [&] {
    const int width = static_cast<int>(lettering_.width(utf8, letterPixels) + letterPixels * 0.8);
    Image image = plate(std::max(width, letterPixels), static_cast<int>(letterPixels * 1.5), letterPixels * 0.4);
    lettering_.write(image, utf8, letterPixels * 0.4, letterPixels * 1.1, letterPixels, kInk);
    return image;
  });
}

ImagePtr BoardImages::sentences(const std::vector<Line>& lines, int pixelsWide, int letterPixels) {
  std::string key = "lines " + std::to_string(pixelsWide) + " " + std::to_string(letterPixels);
  for (const Line& line : lines) key += "|" + std::to_string(static_cast<int>(line.tone)) + line.text;
  return kept(key, [&] {
    struct Row {
      std::string text;
      Tone tone;
    };
    std::vector<Row> rows;
    const double margin = letterPixels * 0.7;
    for (const Line& line : lines)
      for (std::string& part : broken(lettering_, line.text, pixelsWide - 2 * margin, letterPixels))
        rows.push_back({std::move(part), line.tone});
    const double row = letterPixels * 1.4;
    Image image = plate(pixelsWide, static_cast<int>(2 * margin + row * static_cast<double>(rows.size()) - 0.3 * row),
                        letterPixels * 0.5);
    for (std::size_t i = 0; i < rows.size(); ++i)
      lettering_.write(image, rows[i].text, margin, margin + row * static_cast<double>(i) + letterPixels * 0.82,
                       letterPixels,
                       rows[i].tone == Tone::Refused  ? kRefused
                       : rows[i].tone == Tone::Advice ? kAdvice
                                                      : kInk);
    return image;
  });
}

}  // namespace karinui::room
