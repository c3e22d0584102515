#pragma once
// How cloth looks: its surface, colour and print, as a form. What is chosen becomes an operation at once; the caller
// says which fabric or pieces it is about. GUI thread.
#include <QDoubleSpinBox>
#include <QWidget>
#include <algorithm>
#include <functional>
#include <vector>

#include "karinui/session/session.h"
#include "mixed_box.h"

class QComboBox;
class QLineEdit;
class QPushButton;

namespace karinui::studio {

class LengthBox;

class LookBoard : public QWidget {
  Q_OBJECT
 public:
  // `about`: an operation that names the fabric or the pieces and nothing else; nothing: there is none.
  LookBoard(Session& session, std::function<std::optional<SetLook>()> about);
  // `shift`: where its print begins, of a piece; nothing: of a fabric.
  void show(const Look& look, std::optional<Flat> shift = {});
  // Of several pieces: what differs is shown as a dash, and what is chosen is given to all.
  void show(std::vector<Look> looks, std::vector<Flat> shifts);

 private:
  void perform(const std::function<void(SetLook&)>& change);
  void paint(QPushButton& button, QLineEdit& box, std::optional<Dye> SetLook::*field);
  QWidget* dyeRow(const Message& name, QPushButton*& button, QLineEdit*& box, std::optional<Dye> SetLook::*field);
  Dye shownDye(std::optional<Dye> SetLook::*field) const { return dyeIn(shown_, field); }
  static Dye dyeIn(const Look& look, std::optional<Dye> SetLook::*field);
  static PrintKind wrongPrintIn(const Look& look) { return look.wrong ? look.wrong->print : PrintKind::None; }
  template <class Of>
  bool differs(const Of& of) const {  // from piece to piece
    return std::any_of(looks_.begin(), looks_.end(), [&](const Look& one) { return !(of(one) == of(shown_)); });
  }
  void askPhoto();

  Session& session_;
  std::function<std::optional<SetLook>()> about_;
  Look shown_;  // of the first
  std::vector<Look> looks_;
  bool filling_ = false;
  std::optional<Flat> shift_;  // of the first
  std::vector<Flat> shifts_;
  QComboBox *finish_, *print_, *wrongPrint_;
  QPushButton *colour_, *ink_, *photo_, *plain_, *wrong_, *wrongInk_;
  QLineEdit *colourTyped_, *inkTyped_, *wrongTyped_, *wrongInkTyped_;
  LengthBox *repeat_, *across_, *along_;
  MixedBox<QDoubleSpinBox>* turn_;
  QWidget *printRows_, *shiftRow_, *inkRow_, *wrongInkRow_;
};

}  // namespace karinui::studio
