#pragma once
// How a pattern would be made up: on the figure, or flat with the seams that are proposed. GUI thread.
#include <QImage>
#include <QWidget>
#include <vector>

#include "karinui/design/values.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui::studio {

class MakeUpView : public QWidget {
  Q_OBJECT
 public:
  explicit MakeUpView(QWidget* parent = nullptr);
  void show(SnapshotPtr garment, QImage onFigure);
  void setFlat(bool flat);
  Message emptySaid() const;                // instead of a picture; empty: there is one
  void choose(std::vector<EdgeRef> edges);  // shown in the flat pattern
  QSize sizeHint() const override { return {520, 560}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  SnapshotPtr garment_;
  TableLayout layout_;
  QImage onFigure_;
  std::vector<EdgeRef> chosen_;
  bool flat_ = false;
};

}  // namespace karinui::studio
