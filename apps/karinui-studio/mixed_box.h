#pragma once
// A box for a number that several things may have differently: it shows a dash then, and what is typed takes its place.
// GUI thread.
#include <QCheckBox>
#include <QLineEdit>
#include <QString>
#include <algorithm>
#include <set>

namespace karinui::studio {

inline QString mixedWord() { return QStringLiteral("–"); }

// Of QSpinBox or QDoubleSpinBox. A dash is the number one below the least.
template <class Box>
class MixedBox : public Box {
 public:
  void setMixed(bool mixed) {
    if (mixed != mixed_) {
      mixed_ = mixed;
      this->setSpecialValueText(mixed ? mixedWord() : QString());
      this->setMinimum(this->minimum() + (mixed ? -1 : 1));
    }
    if (mixed) this->setValue(this->minimum());
  }
  bool showsDash() const { return mixed_ && this->value() == this->minimum(); }

 protected:
  QValidator::State validate(QString& text, int& at) const override {
    if (mixed_ && text != mixedWord() && text.contains(mixedWord())) {
      text.remove(mixedWord());
      at = std::min(at, static_cast<int>(text.size()));
    }
    return Box::validate(text, at);
  }

 private:
  bool mixed_ = false;
};

// A tick that several things may have or not have: a dash then, and a click ticks it.
inline void showTicked(QCheckBox& box, const std::set<bool>& values) {
  box.setTristate(values.size() > 1);
  box.setCheckState(values.size() > 1 ? Qt::PartiallyChecked : values.contains(true) ? Qt::Checked : Qt::Unchecked);
}

}  // namespace karinui::studio
