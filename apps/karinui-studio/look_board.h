#pragma once
// How cloth looks: its surface, colour and print, as a form. What is chosen becomes an operation at once; the caller
// says which fabric or pieces it is about. GUI thread.
#include <QWidget>
#include <functional>

#include "karinui/session/session.h"

class QComboBox;
class QDoubleSpinBox;
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

 private:
  void perform(const std::function<void(SetLook&)>& change);
  void paint(QPushButton& button, QLineEdit& box, const Dye& dye);
  QWidget* dyeRow(const Message& name, QPushButton*& button, QLineEdit*& box, std::optional<Dye> SetLook::*field);
  Dye shownDye(std::optional<Dye> SetLook::*field) const;
  void askPhoto();

  Session& session_;
  std::function<std::optional<SetLook>()> about_;
  Look shown_;
  bool filling_ = false;
  std::optional<Flat> shift_;
  QComboBox *finish_, *print_, *wrongPrint_;
  QPushButton *colour_, *ink_, *photo_, *plain_, *wrong_, *wrongInk_;
  QLineEdit *colourTyped_, *inkTyped_, *wrongTyped_, *wrongInkTyped_;
  LengthBox *repeat_, *across_, *along_;
  QDoubleSpinBox* turn_;
  QWidget *printRows_, *shiftRow_, *inkRow_, *wrongInkRow_;
};

}  // namespace karinui::studio
