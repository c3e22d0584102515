#pragma once
// Keys over the fitting and over the pattern, as the session's hand without a pointer understands them. GUI thread.
#include <QKeyEvent>
#include <QString>
#include <optional>

#include "karinui/session/session.h"

namespace karinui::studio {

std::optional<KeyStroke> strokeOf(const QKeyEvent& event);
// Enter works the cloth while the fingertip is shown, whatever it is a shortcut for elsewhere.
bool isForFingertip(QEvent* event, const Session& session);

}  // namespace karinui::studio
