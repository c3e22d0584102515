#pragma once
// The paper pattern's pages as pictures, and on a printer at true size. GUI thread.
#include <QImage>

#include "karinui/exchange/sheet.h"

class QPrinter;

namespace karinui::studio {

// As large as it fits into `room`, with a thin shadow round it.
QImage pagePicture(const PaperPages& pages, std::size_t page, QSize room);

// Every page on a sheet of its own size, or of the printer's where that is larger. Refuses paper that is too small.
Done printPages(const PaperPages& pages, QPrinter& printer);

}  // namespace karinui::studio
