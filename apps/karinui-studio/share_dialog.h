#pragma once
// Before a pattern is given away: which names others will read in it. GUI thread.
#include <QDialog>

#include "karinui/design/share.h"

class QCheckBox;
class QLabel;
class QPlainTextEdit;

namespace karinui::studio {

class ShareDialog : public QDialog {
  Q_OBJECT
 public:
  ShareDialog(const Document& document, QWidget* parent);
  SharedNames names() const;

 private:
  void refresh();
  QCheckBox* neutral_;
  QLabel* told_;
  QPlainTextEdit* read_;
};

}  // namespace karinui::studio
