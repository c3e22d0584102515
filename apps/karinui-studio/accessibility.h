#pragma once
// What a screen reader hears of the fitting and of the flat pattern. Changed names and descriptions are not enough:
// Orca 43 with Qt 6.4 cannot read them. What takes the focus is always told, so the place under the fingertip is a part
// of its view that takes it, anew each time its words change. GUI thread.
#include <QString>
#include <QWidget>

namespace karinui::studio {

// From now on views have a place under the fingertip for those who hear the screen. Before the first of them is made.
void letViewsSpeak();
// Says it as what is now under the fingertip of this view; nothing to say: the view itself has the focus again.
void announce(QWidget* view, const QString& words);

}  // namespace karinui::studio
