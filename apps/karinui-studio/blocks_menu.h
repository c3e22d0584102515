#pragma once
// Ready blocks as a menu: each item drafts one on the figure. GUI thread.
#include "karinui/session/session.h"

class QMenu;

namespace karinui::studio {

void fillBlocks(QMenu& menu, Session& session);

}  // namespace karinui::studio
