#include "paper.h"

#include <QPainter>
#include <QPrinter>
#include <cmath>

#include "theme.h"

namespace karinui::studio {

namespace {

QImage windowOf(const PaperPages& pages, std::size_t page, double pixelsPerMetre, QRect window) {
  const std::vector<std::uint32_t> rows =
      pages.draw(page, pixelsPerMetre, window.x(), window.y(), window.width(), window.height());
  return QImage(reinterpret_cast<const uchar*>(rows.data()), window.width(), window.height(), 4 * window.width(),
                QImage::Format_RGB32)
      .copy();
}

}  // namespace

QImage pagePicture(const PaperPages& pages, std::size_t page, QSize room) {
  const Flat size = pages.size(page);
  const double scale = std::min((room.width() - 12) / size.u, (room.height() - 12) / size.v);
  const QSize paper(std::max(1, static_cast<int>(size.u * scale)), std::max(1, static_cast<int>(size.v * scale)));
  QImage image(paper + QSize(12, 12), QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  for (int i = 5; i >= 1; --i)
    painter.fillRect(QRect(QPoint(6, 6), paper).adjusted(-i, -i + 2, i, i), QColor(0, 0, 0, 14));
  painter.drawImage(6, 6, windowOf(pages, page, scale, QRect(QPoint(), paper)));
  return image;
}

Result<std::size_t> printPages(const PaperPages& pages, QPrinter& printer, const std::function<bool(double)>& goOn) {
  constexpr int kBand = 1024;            // rows drawn at once: a sheet of two metres fits into no memory
  constexpr double kFinest = 600;        // dots an inch; finer helps no line
  constexpr double kCloseEnough = 5e-4;  // metres
  printer.setFullPage(true);
  // One large sheet is a page of its own size, where the printer takes any.
  const auto paperFor = [&](std::size_t page) -> Done {
    const Flat size = pages.size(page);
    const QSizeF now = printer.pageLayout().fullRect(QPageLayout::Millimeter).size() / 1000;
    if (now.width() + kCloseEnough >= size.u && now.height() + kCloseEnough >= size.v) return {};
    printer.setPageSize(
        QPageSize(QSizeF(size.u * 1000, size.v * 1000), QPageSize::Millimeter, {}, QPageSize::FuzzyMatch));
    const QSizeF is = printer.pageLayout().fullRect(QPageLayout::Millimeter).size() / 1000;
    if (is.width() + kCloseEnough >= size.u && is.height() + kCloseEnough >= size.v) return {};
    return refused(
        say("The printer's paper is {0} × {1}, and this page needs {2} × {3}; choose larger paper or A4 sheets.",
            lengthText(is.width()).toStdString(), lengthText(is.height()).toStdString(),
            lengthText(size.u).toStdString(), lengthText(size.v).toStdString()));
  };
  std::size_t first = 0, end = pages.count();
  if (printer.printRange() == QPrinter::PageRange) {
    first = static_cast<std::size_t>(std::max(printer.fromPage(), 1) - 1);
    end = std::min(end, static_cast<std::size_t>(std::max(printer.toPage(), 1)));
  }
  if (first >= end)
    return refused(say("The pattern has {0} {0|page|pages}; there is no page {1}.", pages.count(), first + 1));
  for (std::size_t page = first; page < end; ++page)
    if (Done done = paperFor(page); !done) return done.error();
  (void)paperFor(first);
  const double dots = printer.resolution() / 0.0254, fine = std::min(dots, kFinest / 0.0254);
  QPainter painter;
  if (!painter.begin(&printer)) return storageError(say("The printer does not answer."));
  for (std::size_t page = first; page < end; ++page) {
    if (page > first) printer.newPage();
    const Flat size = pages.size(page);
    const int wide = static_cast<int>(std::ceil(size.u * fine)), high = static_cast<int>(std::ceil(size.v * fine));
    for (int top = 0; top < high; top += kBand) {
      const double done = static_cast<double>(page - first) + static_cast<double>(top) / high;
      if (!goOn(done / static_cast<double>(end - first))) {
        printer.abort();
        return cancelled();
      }
      const int rows = std::min(kBand, high - top);
      const QImage band =
          windowOf(pages, page, fine, QRect(0, top, wide, rows)).convertToFormat(QImage::Format_Grayscale8);
      painter.drawImage(QRectF(0, top * dots / fine, wide * dots / fine, rows * dots / fine), band);
    }
  }
  if (!painter.end()) return storageError(say("The printer does not answer."));
  return end - first;
}

}  // namespace karinui::studio
