#pragma once
// Keys over the fitting and over the pattern, as the session's hand without a pointer understands them. GUI thread.
#include <QKeyEvent>
#include <QString>
#include <QWidget>
#include <optional>

#include "karinui/session/session.h"

namespace karinui::studio {

std::optional<KeyStroke> strokeOf(const QKeyEvent& event);
// Enter works the cloth while the fingertip is shown, whatever it is a shortcut for elsewhere.
bool isForFingertip(QEvent* event, const Session& session);
// Says it to those who hear the screen, as what the focused widget has to say now.
void announce(QWidget* speaker, const QString& words);

}  // namespace karinui::studio
