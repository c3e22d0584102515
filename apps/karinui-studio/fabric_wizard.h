#pragma once
// A fabric of one's own, measured on a kitchen table: the readings are typed, and what they come to stands beside the
// nearest fabric of the shop at once. Several readings are separated by spaces or semicolons. GUI thread.
#include <QDialog>
#include <optional>
#include <vector>

#include "karinui/cloth/measured_fabric.h"
#include "karinui/session/session.h"

class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace karinui::studio {

class FabricWizard : public QDialog {
  Q_OBJECT
 public:
  FabricWizard(Session& session, QWidget* parent);  // goes when it is closed

 signals:
  void added(const QString& name);  // the step that adds the fabric was asked for

 private:
  struct Reading {  // a line to type into; what is read, times `unit`, is SI
    QLineEdit* line;
    double unit;
    bool length;  // "10cm" is understood, too
  };
  QLineEdit* add(QFormLayout& form, const Message& label, double unit, const char* unitText, const char* usual = "");
  Result<std::vector<double>> read(const QLineEdit* line) const;
  Result<TableReadings> readings() const;
  void workOut();
  void readPhotographs();  // of a disc: its drape is typed into the line
  void accept() override;

  Session& session_;
  std::vector<Reading> lines_;
  QLineEdit *name_, *swatchLength_, *swatchWidth_, *mass_, *thickness_, *stripLength_, *stripWidth_, *weight_, *ruler_,
      *scales_, *angleError_, *drape_;
  std::array<QLineEdit*, kGrains> overhang_, angle_, hung_;
  QLabel* result_;
  QPushButton* accept_;
  std::optional<MeasuredFabric> measured_;
};

}  // namespace karinui::studio
