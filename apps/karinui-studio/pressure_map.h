#pragma once
// What cloth presses on the body with, worked out on a thread of its own: it takes tenths of a second. Only the
// garments asked about last are kept. GUI thread.
#include <QObject>
#include <QThreadPool>
#include <map>
#include <memory>
#include <vector>

#include "karinui/session/garment_snapshot.h"

namespace karinui::studio {

class PressureMap : public QObject {
  Q_OBJECT
 public:
  using Values = std::shared_ptr<const std::vector<float>>;  // see pressureOnBody()

  explicit PressureMap(QObject* parent = nullptr);
  ~PressureMap() override;  // waits for what is being worked out
  // Null until it is ready. The first call begins it, or, while another is worked out, waits for ready() to ask again.
  Values of(const SnapshotPtr& garment);
  // Forgets every garment but these.
  void keepOnly(const std::vector<SnapshotPtr>& garments);
  bool busy() const { return busy_; }

 signals:
  void ready();

 private:
  QThreadPool thread_;
  std::map<SnapshotPtr, Values> known_;
  bool busy_ = false;
};

}  // namespace karinui::studio
