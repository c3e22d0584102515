#pragma once
// The force-feedback device of the studio: which one is used and how, what it makes the fitting show. Settings are kept
// (QSettings). GUI thread; the force loop has its own (HapticDriver).
#include <QObject>
#include <QTimer>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "karinui/haptics/haptic_driver.h"
#include "karinui/haptics/other_hand.h"

class QPainter;
class QPointF;

namespace karinui {
class LedDevice;
class PoseSource;
}  // namespace karinui

namespace karinui::studio {

class SpaceView;

enum class DeviceKind { None, Mouse, Simulated, Inverse3, Touch };
const std::vector<Message>& deviceNames();  // in this order

struct DeviceSettings {
  DeviceKind kind = DeviceKind::None;
  DeviceKind other = DeviceKind::None;  // of the other hand: turns the body while its button is down
  double gain = 0.5;                    // of the true force
  double limit = 3;                     // N
  TouchLaws laws;
  double scale = 2;  // metres of the scene for a metre of the device
  PointerSample::Hand hand = PointerSample::Hand::Either;
  bool secondTurns = false;  // the second button turns the body; else it is the clutch
  bool operator==(const DeviceSettings&) const = default;
};

class ForceFeedback : public QObject {
  Q_OBJECT
 public:
  // Opens a device of a maker's, for the main hand or the other one.
  using Opener = std::function<Result<std::unique_ptr<HapticDevice>>(DeviceKind kind, bool other)>;

  ForceFeedback(Session& session, SpaceView& view);  // with the settings that were kept
  ~ForceFeedback() override;

  const DeviceSettings& settings() const { return settings_; }
  // Gain, limit and laws at once; another device, scale, hand or button begins the force anew. What is not there is
  // told, and none is used.
  void set(const DeviceSettings& settings);
  void setOpener(Opener opener) { opener_ = std::move(opener); }  // instead of the makers' own, for tests
  std::vector<std::pair<Message, Message>> look() const;          // device, what was found; up to two seconds

  bool there() const { return driver_ != nullptr; }
  QString name() const;
  const OtherHand* other() const { return other_.get(); }  // null: none
  ServoTick last() const { return driver_ ? driver_->last() : ServoTick(); }
  double limit() const;  // N that can come: the user's limit, and the device's
  static Message said(ServoState state);
  static Message said(ServoFault fault);  // why there is no force; empty: none
  void emergencyOff(bool off);
  bool isOff() const { return off_; }
  void setFocus(bool focus);
  void testFeel();
  void calibrate();  // the tip is in the middle of the view now
  // Writes what the hand does and feels into a file, until it is ended or the studio is.
  Done record(const std::filesystem::path& path);
  Done endRecording();
  const HandRecording* recording() const { return recording_.get(); }  // null: none

  // The mouse over the fitting; true: it leads the stylus, and is not for the session.
  bool pointed(PointerSample& sample);
  bool wheeled(double turns);  // true: it was depth
  void left();                 // the mouse left the view
  bool busy() const;           // the stylus has a gesture under way: other pointers had better wait
  std::optional<std::array<Vec3, 2>> arrow()
      const;  // the force on the hand, from the proxy; too small to be felt: none
  // The proxy as a ball, the arrow and its number: over everything, for cloth and body must not hide them.
  void paint(QPainter& painter, const std::function<QPointF(Vec3)>& at, const QRectF& room) const;

 signals:
  void fed();      // the session has something new
  void changed();  // settings, or emergency off
  void felt();     // the loop's state, or the force

 private:
  void begin();
  void beginMain();
  void beginOther();
  void turn();
  void turnBody(Vec3 led);  // metres of the scene: right, up
  Vec3 facing() const;
  Vec3 under(const PointerSample& sample) const;  // the place a mouse means
  void leave();
  void leadToPutDown();
  void keep() const;

  Session& session_;
  SpaceView& view_;
  DeviceSettings settings_;
  Opener opener_;
  std::unique_ptr<HandRecording> recording_;  // before the driver, which tells it
  std::unique_ptr<HapticDriver> driver_;
  std::unique_ptr<OtherHand> other_;
  PoseSource* mouse_ = nullptr;  // of the driver, where the mouse is the device
  LedDevice* led_ = nullptr;     // where it leads the simulated stylus
  QTimer clock_;
  bool off_ = false, mouseDown_ = false;
  // Where the mouse let go of what the simulated stylus holds, until it is put down there.
  struct PutDown {
    Vec3 at;
    std::chrono::steady_clock::time_point latest;
    int turns = 0;
    bool up = false;
  };
  std::optional<PutDown> putDown_;
  bool leaving_ = false;  // the stylus goes when nothing is left to put down
  // The mouse's depth: a plane that faces who looks goes through here, so much nearer to them.
  Vec3 through_;
  double depth_ = 0;
  std::optional<PointerSample> pointed_;
  ServoTick shown_;
};

}  // namespace karinui::studio
