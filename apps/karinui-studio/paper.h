#pragma once
// The paper pattern's pages as pictures, and on a printer at true size. GUI thread.
#include <QImage>
#include <functional>

#include "karinui/exchange/sheet.h"

class QPrinter;

namespace karinui::studio {

// As large as it fits into `room`, with a thin shadow round it.
QImage pagePicture(const PaperPages& pages, std::size_t page, QSize room);

// Every page, or those the printer was asked for, on a sheet of its own size or of the printer's where that is larger;
// how many. Refuses paper that is too small. `goOn` is told how much is done, 0 to 1; false stops it.
Result<std::size_t> printPages(const PaperPages& pages, QPrinter& printer, const std::function<bool(double)>& goOn);

}  // namespace karinui::studio
