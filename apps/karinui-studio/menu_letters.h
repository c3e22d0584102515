#pragma once
// One letter for each entry of a menu, underlined, that chooses it while the menu is open. In English it is one of the
// entry's own, in Japanese it stands behind the words, as (N), and is the same one. Where a menu has more entries than
// there are letters, some share one, which then goes from one of them to the next.
#include <QString>

class QAction;
class QMenu;

namespace karinui::studio {

inline constexpr const char* kEnglish = "english";  // of an action: what it is called in English

void giveLetters(QMenu& menu);              // to what it holds now, and what its menus hold
void keepLetters(QMenu& menu);              // each time before it is shown
QString withoutLetter(const QAction& one);  // its words alone

}  // namespace karinui::studio
