#pragma once
// What a typed length does to the chosen edge: which end stays, whether the neighbours keep their lengths, and whether
// the other half is changed too. GUI thread.
#include <QWidget>

#include "karinui/session/session.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace karinui::studio {

class LengthChoice : public QWidget {
  Q_OBJECT
 public:
  explicit LengthChoice(Session& session);
  void refresh();                         // the chosen edge, or the garment, is another
  SetLength length(double metres) const;  // of the chosen edge
  Operation length(const std::string& formula, double metres) const;

 private:
  std::string formula() const;
  const Piece* piece() const;  // null: no edge of an outline is chosen
  Session& session_;
  QComboBox* keep_;
  QCheckBox *neighbours_, *partners_;
  QLabel *both_, *given_;
  std::pair<PieceId, std::string> shown_;
};

}  // namespace karinui::studio
