#include "karinui/exchange/report.h"

#include <algorithm>
#include <numeric>

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
      const bool named =
          std::any_of(table.columns.begin(), table.columns.end(), [](const Message& m) { return !m.empty(); });
      if (named) drawn(table.columns);
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
  // From `left` to the margin, in as many lines as it takes.
  void spread(const std::string& words, double left) {
    const auto wide = [&](std::string_view part) { return canvas_.wide(std::string(part), kLetters); };
    for (const std::string& part : brokenInto(words, kWide - kPageMargin - left, wide)) {
      if (down_ + kLine > kHigh - kPageMargin) begin();
      line(part, {left, down_}, kLetters), down_ += kLine;
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
      const std::vector<double> wide = widths(table, room);
      if (!table.columns.empty()) row(table.columns, wide, left, down, room);
      canvas_.moveTo({left, down - 3}), canvas_.lineTo({left + room, down - 3}), canvas_.stroke(0.15, false);
      for (const auto& cells : table.rows) {
        if (down + kLine > kHigh - kPageMargin) {
          begin();
          at[0] = at[1] = down_;
          down = down_;
        }
        row(cells, wide, left, down, room);
      }
      down += 3;
      down_ = std::max(at[0], at[1]);
    }
  }
  // Of the cells behind the first: as wide as what is in them.
  std::vector<double> widths(const ReportTable& table, double room) const {
    constexpr double kBetween = 3, kMost = 0.65;
    std::vector<double> wide;
    const auto measured = [&](const std::vector<Message>& cells) {
      wide.resize(std::max(wide.size(), cells.size()), 0);
      for (std::size_t i = 1; i < cells.size(); ++i)
        wide[i] = std::max(wide[i], canvas_.wide(text(cells[i], language_), kLetters) + kBetween);
    };
    measured(table.columns);
    for (const auto& cells : table.rows) measured(cells);
    const double sum = std::accumulate(wide.begin(), wide.end(), 0.0);
    for (double& own : wide) own *= std::min(1.0, kMost * room / std::max(sum, 1e-9));
    return wide;
  }
  // The first cell has the room that the others leave, in as many lines as it takes. `down` goes on below the row.
  void row(const std::vector<Message>& cells, const std::vector<double>& wide, double left, double& down, double room) {
    if (cells.empty()) return;
    double right = left + room;
    for (std::size_t i = cells.size(); i-- > 1;) {
      right -= wide[i];
      fit(text(cells[i], language_), {right, down}, wide[i], true);
    }
    const auto measure = [&](std::string_view part) { return canvas_.wide(std::string(part), kLetters); };
    const auto lines = brokenInto(text(cells[0], language_), right - left - 1, measure);
    for (const std::string& part : lines) line(part, {left, down}, kLetters), down += kLine;
    if (lines.empty()) down += kLine;
  }

  Language language_;
  PdfCanvas canvas_;
  bool any_ = false;
  double down_ = kPageMargin;
};

}  // namespace

Result<std::string> writeReport(const Report& report, Language language) { return Pages(report, language).finish(); }

}  // namespace karinui
