#include "karinui/exchange/report.h"

#include <algorithm>

#include "names.h"
#include "pdf_canvas.h"
#include "report_plot.h"

namespace karinui {
namespace {

constexpr double kWide = 210, kHigh = 297, kPageMargin = 15, kGutter = 8;  // mm
constexpr double kLetters = 3.2, kLine = 5, kHeading = 4.2;
constexpr std::size_t kBeside = 3;

class Pages {
 public:
  Pages(const Report& report, Language language) : language_(language), canvas_(kWide, kHigh, report.title) {
    begin();
    line(cleanText(report.title), {kPageMargin, down_ + 4}, 7);
    down_ += 10;
    if (!report.under.empty()) line(text(report.under, language_), {kPageMargin, down_}, kLetters), down_ += kLine;
    down_ += 2;
    for (const ReportTable& table : report.summary) list(table);
    pictures(report.pictures);
    plots(report.plots);
    tables(report.tables);
    for (const ReportTable& table : report.lists) list(table);
    canvas_.end();
  }
  Result<std::string> finish() { return canvas_.finishPlain(); }

 private:
  void begin() {
    if (any_) canvas_.end();
    any_ = true;
    canvas_.begin(kWide, kHigh);
    canvas_.layer(PdfLayer::Page);
    canvas_.colour(0);
    down_ = kPageMargin;
  }
  void line(const std::string& words, Mm at, double size) { canvas_.words({at, size, true, words}, false); }
  // No wider than its room: a long word gets smaller letters.
  void fit(const std::string& words, Mm at, double room, bool right) {
    const double wide = canvas_.wide(words, kLetters);
    const double size = wide > room ? kLetters * room / wide : kLetters;
    line(words, right ? Mm{at.x + room - canvas_.wide(words, size), at.y} : at, size);
  }

  void pictures(const std::vector<ReportPicture>& all) {
    const double room = (kWide - 2 * kPageMargin - (kBeside - 1) * kGutter / 2) / kBeside;
    for (std::size_t first = 0; first < all.size(); first += kBeside) {
      const std::size_t last = std::min(all.size(), first + kBeside);
      double high = 0;
      for (std::size_t i = first; i < last; ++i)
        high = std::max(high, room * all[i].height / std::max(1, all[i].width));
      if (down_ + high + 8 > kHigh - kPageMargin) begin();
      for (std::size_t i = first; i < last; ++i) {
        const double left = kPageMargin + static_cast<double>(i - first) * (room + kGutter / 2);
        canvas_.picture({left, down_}, room, all[i].width, all[i].height, all[i].rgba);
        fit(text(all[i].caption, language_), {left, down_ + high + 3.5}, room, false);
      }
      down_ += high + 8;
    }
  }

  void plots(const std::vector<ReportPlot>& all) {
    for (const ReportPlot& plot : all) {
      if (down_ + plotHigh(plot) > kHigh - kPageMargin) begin();
      drawPlot(canvas_, plot, {kPageMargin, down_}, kWide - 2 * kPageMargin, language_);
      down_ += plotHigh(plot) + 3;
    }
  }

  // As wide as the page; each column as wide as what is in it, as far as there is room.
  void list(const ReportTable& table) {
    constexpr double kBetween = 4, kRoom = kWide - 2 * kPageMargin;
    std::vector<double> wide(table.columns.size());
    const auto measured = [&](const std::vector<Message>& cells) {
      for (std::size_t i = 0; i < std::min(cells.size(), wide.size()); ++i)
        wide[i] = std::max(wide[i], canvas_.wide(text(cells[i], language_), kLetters) + kBetween);
    };
    measured(table.columns);
    for (const auto& cells : table.rows)
      if (cells.size() >= wide.size()) measured(cells);
    double sum = 0;
    for (const double w : wide) sum += w;
    for (double& w : wide) w *= std::min(1.0, kRoom / sum);
    if (down_ + kHeading + 4 * kLine > kHigh - kPageMargin) begin();
    line(text(table.heading, language_), {kPageMargin, down_ + 3}, kHeading);
    down_ += kHeading + 4.5;
    const auto drawn = [&](const std::vector<Message>& cells) {
      double left = kPageMargin;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i + 1 == cells.size() && cells.size() < wide.size()) {
          spread(text(cells[i], language_), left);
          return;
        }
        fit(text(cells[i], language_), {left, down_}, wide[i] - kBetween / 2, false);
        left += wide[i];
      }
      down_ += kLine;
    };
    const auto head = [&] {
      drawn(table.columns);
      canvas_.moveTo({kPageMargin, down_ - 3}), canvas_.lineTo({kWide - kPageMargin, down_ - 3}),
          canvas_.stroke(0.15, false);
    };
    head();
    for (const auto& cells : table.rows) {
      if (down_ + kLine > kHigh - kPageMargin) begin(), head();
      drawn(cells);
    }
    down_ += 5;
  }
  // From `left` to the margin, in as many lines as it takes; words are kept whole where there are spaces.
  void spread(std::string words, double left) {
    const double room = kWide - kPageMargin - left;
    while (!words.empty()) {
      std::size_t end = words.size();
      while (end > 1 && canvas_.wide(words.substr(0, end), kLetters) > room) {
        const std::size_t space = words.rfind(' ', end - 1);
        end = space == std::string::npos || space == 0 ? end - 1 : space;
        while (end > 1 && (static_cast<unsigned char>(words[end]) & 0xC0) == 0x80) --end;
      }
      if (down_ + kLine > kHigh - kPageMargin) begin();
      line(words.substr(0, end), {left, down_}, kLetters), down_ += kLine;
      words.erase(0, std::min(words.size(), words[std::min(end, words.size() - 1)] == ' ' ? end + 1 : end));
    }
  }

  // Both columns are filled evenly: each table goes where there is more room left.
  void tables(const std::vector<ReportTable>& all) {
    const double room = (kWide - 2 * kPageMargin - kGutter) / 2;
    double at[2] = {down_ + 2, down_ + 2};
    for (const ReportTable& table : all) {
      const double high =
          kHeading + 7 + kLine * static_cast<double>(table.rows.size() + (table.columns.empty() ? 0 : 1));
      std::size_t side = at[1] < at[0] ? 1 : 0;
      if (at[side] + std::min(high, kHigh / 2) > kHigh - kPageMargin) begin(), at[0] = at[1] = down_, side = 0;
      const double left = kPageMargin + static_cast<double>(side) * (room + kGutter);
      double& down = at[side];
      line(text(table.heading, language_), {left, down + 3}, kHeading);
      down += kHeading + 4.5;
      if (!table.columns.empty()) row(table.columns, left, down, room), down += kLine;
      canvas_.moveTo({left, down - 3}), canvas_.lineTo({left + room, down - 3}), canvas_.stroke(0.15, false);
      for (const auto& cells : table.rows) {
        if (down + kLine > kHigh - kPageMargin) {
          begin();
          at[0] = at[1] = down_;
          down = down_;
        }
        row(cells, left, down, room), down += kLine;
      }
      down += 3;
      down_ = std::max(at[0], at[1]);
    }
  }
  // The first cell has the room that the others leave.
  void row(const std::vector<Message>& cells, double left, double down, double room) {
    if (cells.empty()) return;
    const double each = cells.size() == 2 ? room * 0.4 : room * 0.19;
    const double first = room - each * static_cast<double>(cells.size() - 1);
    fit(text(cells[0], language_), {left, down}, first - 2, false);
    for (std::size_t i = 1; i < cells.size(); ++i)
      fit(text(cells[i], language_), {left + first + each * static_cast<double>(i - 1), down}, each - 1, true);
  }

  Language language_;
  PdfCanvas canvas_;
  bool any_ = false;
  double down_ = kPageMargin;
};

}  // namespace

Result<std::string> writeReport(const Report& report, Language language) { return Pages(report, language).finish(); }

}  // namespace karinui
