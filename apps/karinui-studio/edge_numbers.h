#pragma once
// What is put on the chosen edge by number: a point, a notch, a dart. GUI thread.
#include <QWidget>

#include "karinui/session/session.h"

namespace karinui::studio {

class LengthBox;

class EdgeNumbers : public QWidget {
  Q_OBJECT
 public:
  explicit EdgeNumbers(Session& session);

 private:
  const Edge* edge() const;  // null: none chosen
  EdgeRef ref() const;
  double share() const;
  Operation split() const;
  Operation join() const;
  Operation notch() const;
  Operation dart() const;

  Session& session_;
  // With the formulas that the boxes hold: the place as a share of the edge's length.
  Operation withFormulas(Operation operation, bool width) const;
  LengthBox *along_, *width_, *depth_;
  std::string alongFormula_, widthFormula_;  // empty: a number
};

}  // namespace karinui::studio
