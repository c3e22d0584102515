#pragma once
// The studio working by itself: what it costs a person to wait, printed; and a picture of the window. GUI thread.
#include <QString>
#include <optional>

#include "karinui/base/message.h"

class QApplication;

namespace karinui::studio {

class MainWindow;
// Opens a small garment, turns, drags, cuts and settles it; prints the latencies. 0, or 1 when there is no picture.
int selfCheck(QApplication& app, MainWindow& window);
// Waits until nothing is under way and the still picture is drawn, prints the last sentence the person was told, and
// keeps a picture of the whole window.
int keepPicture(QApplication& app, MainWindow& window, const QString& path);
// Why this display cannot draw the fitting; nothing: it can.
std::optional<Message> drawingTrouble();
// Handles events until the session is idle and the window drawn.
void comeToRest(MainWindow& window);

}  // namespace karinui::studio
