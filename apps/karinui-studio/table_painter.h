#pragma once
// Paints a TableFrame in the theme's colours. Strokes and the pieces' names keep their size on the screen; the frame's
// other lettering is as large as it is printed, and left out where that is too small to be read. GUI thread.
#include <QPainter>

#include "karinui/scene/table_frame.h"

namespace karinui::studio {

// How the table lies in a widget.
struct TableOnScreen {
  Flat middle;         // the table's place in the middle of the widget
  double scale = 500;  // pixels a metre
  QSizeF size;         // of the widget
  QPointF at(Flat table) const;
  Flat table(const QPointF& screen) const;
};

void paintTable(QPainter& painter, const TableFrame& frame, const TableOnScreen& screen);
// What is chosen among the edges, over all that is painted otherwise.
void paintChosenEdges(QPainter& painter, const TableFrame& frame, const TableOnScreen& screen);

}  // namespace karinui::studio
