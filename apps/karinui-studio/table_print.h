#pragma once
// The print of a piece's cloth on the cutting table, at true scale and along the grain, pale: lines and words stay to
// be read. As the shader of the views draws it (src/view/shaders.cpp). GUI thread.
#include <QPainterPath>
#include <array>
#include <memory>

#include "table_painter.h"

namespace karinui::studio {

// A picture whose upper left, upper right and lower left corners lie there on the screen. However small it is drawn, no
// thin line of it is lost.
void paintPicture(QPainter& painter, const std::shared_ptr<const PrintImage>& picture,
                  const std::array<QPointF, 3>& corners);

// Within `shape`, which is the piece on the screen. Nothing where the print is too small to be seen.
void paintPrint(QPainter& painter, const TablePiece& piece, const QPainterPath& shape, const TableOnScreen& screen);

}  // namespace karinui::studio
