#pragma once
// A plot of a report, drawn on a page.
#include "karinui/exchange/report.h"
#include "pdf_canvas.h"

namespace karinui {

double plotHigh(const ReportPlot& plot);  // mm, with the room below it
// With its upper left corner at `corner`, `wide` mm across.
void drawPlot(PdfCanvas& canvas, const ReportPlot& plot, Mm corner, double wide, Language language);

}  // namespace karinui
