#pragma once
// One measure of a figure: typed in a box, or turned with a slider while the figure follows. GUI thread.
#include <QWidget>
#include <optional>

#include "karinui/base/message.h"

class QSlider;

namespace karinui::studio {

class LengthBox;

class MeasureRow : public QWidget {
  Q_OBJECT
 public:
  explicit MeasureRow(const Message& name);
  std::optional<double> stated() const;                    // metres; nothing: it follows from the others
  const std::string& formula() const { return formula_; }  // empty: a number
  LengthBox& box() { return *box_; }
  // What was stated, and what the figure measures there; tells nobody, and leaves a slider in hand alone.
  void show(std::optional<double> stated, const std::string& formula, double measured);
  void showMeasured(double measured);  // only to be read: the body is as it is

 signals:
  void turned();   // still in hand
  void set();      // let go, or typed
  void entered();  // the pointer or the keys came here

 private:
  bool eventFilter(QObject* who, QEvent* event) override;
  LengthBox* box_;
  std::string formula_;
  QSlider* slider_;
};

}  // namespace karinui::studio
