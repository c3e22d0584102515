#pragma once
// What the garment can be written as, with what will come out shown before it is written. GUI thread.
#include <QDialog>
#include <optional>

#include "karinui/session/session.h"
#include "space_view.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QPlainTextEdit;
class QSlider;
class QStackedWidget;

namespace karinui::studio {

class LengthBox;

// Whether pieces that are each other's mirror image are drawn once. Keeps what was chosen last.
QCheckBox* pairsOnceBox();

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  ExportDialog(Session& session, SpaceView& view, QWidget* parent);
  ExportWish wish() const;
  const std::optional<Error>& trouble() const { return trouble_; }  // why there is nothing to write

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void showPage();
  Session& session_;
  SpaceView& view_;
  QComboBox* kind_;
  LengthBox* allowance_;
  QCheckBox* pairs_;
  QLabel *about_, *size_, *picture_, *number_;
  QSlider* page_;
  QStackedWidget* shown_;
  QPlainTextEdit* text_;
  QPushButton* save_;
  std::optional<PaperPages> paper_;
  std::optional<Error> trouble_;
};

}  // namespace karinui::studio
