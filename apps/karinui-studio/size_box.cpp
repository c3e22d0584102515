#include "size_box.h"

#include <QComboBox>
#include <algorithm>

#include "karinui/design/glossary.h"
#include "theme.h"

namespace karinui::studio {

void addSizes(QComboBox& box) {
  constexpr int kSeen = 20;
  box.setMaxVisibleItems(kSeen);
  for (const SizeSeries& series : sizeSeries()) {
    if (box.count() > 0) box.insertSeparator(box.count());
    for (const BuiltInSize& size : series.sizes)
      box.addItem(inWords(termSaid(Term::Size, size.name).value_or(say("{0}", size.name))),
                  QByteArray(size.name.data(), static_cast<int>(size.name.size())));
  }
}

void chooseSize(QComboBox& box, std::string_view size) {
  const int at = box.findData(QByteArray(size.data(), static_cast<int>(size.size())));
  box.setCurrentIndex(std::max(0, at));
}

std::string chosenSize(const QComboBox& box) { return box.currentData().toByteArray().toStdString(); }

}  // namespace karinui::studio
