#pragma once
// The studio working by itself: what it costs a person to wait, printed; and a picture of the window. GUI thread.
#include <QString>

class QApplication;

namespace karinui::studio {

class MainWindow;
// Opens a small garment, turns, drags, cuts and settles it; prints the latencies. 0, or 1 when there is no picture.
int selfCheck(QApplication& app, MainWindow& window);
// Waits until nothing is under way and the still picture is drawn, then keeps one of the whole window.
int keepPicture(QApplication& app, MainWindow& window, const QString& path);
// Handles events until the session is idle and the window drawn.
void comeToRest(MainWindow& window);

}  // namespace karinui::studio
