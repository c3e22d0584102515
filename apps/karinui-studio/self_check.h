#pragma once
// The studio working by itself: what it costs a person to wait, printed; and a picture of the window. GUI thread.
#include <QString>
#include <functional>
#include <optional>

#include "karinui/base/message.h"
#include "karinui/session/session.h"

class QApplication;

namespace karinui::studio {

class MainWindow;
// Plays a garment (a script or a document, which stays as it is; empty: two panels) in windows of 1600 x 1000, opens it
// again, turns, pulls, moves a point, changes fabric and figure, cuts; prints how long a person waits for each, by the
// clock and in processor time of all threads. 0, or 1 when there is no picture or no such garment.
int selfCheck(QApplication& app, const SessionOptions& options, const QString& garment);
// Waits until nothing is under way and the still picture is drawn, prints the last sentence the person was told, and
// keeps a picture of the whole window.
int keepPicture(QApplication& app, MainWindow& window, const QString& path);
// Why this display cannot draw the fitting; nothing: it can.
std::optional<Message> drawingTrouble();
// Handles events until it holds, looking after each picture and each thing that is new.
void until(MainWindow& window, const std::function<bool()>& holds);
// Handles events until the session is idle and the window drawn.
void comeToRest(MainWindow& window);

}  // namespace karinui::studio
