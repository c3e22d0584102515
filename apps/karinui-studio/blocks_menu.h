#pragma once
// Ready blocks as a menu: each item drafts one on the figure. GUI thread.
#include <functional>

#include "karinui/session/session.h"

class QMenu;

namespace karinui::studio {

// `numbers`: lets ease and length be typed first.
void fillBlocks(QMenu& menu, Session& session, std::function<void()> numbers);

}  // namespace karinui::studio
