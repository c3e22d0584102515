#include "karinui/haptics/haptic_driver.h"

namespace karinui {

namespace {

ServoSettings withClutch(ServoSettings servo, std::uint32_t buttons) {
  servo.clutchButtons |= buttons;
  return servo;
}

constexpr double kTestDepth = 0.01, kTestHalf = 0.5;  // metres
constexpr double kTestClick = 0.5;                    // seconds before the end

TouchScene testScene(Vec3 at) {
  TouchScene scene;
  const Vec3 middle = at - Vec3{0, kTestDepth, 0}, u{kTestHalf, 0, 0}, v{0, 0, kTestHalf};
  for (const auto& facet : {facetOf(middle - u - v, middle - u + v, middle + u + v, false),
                            facetOf(middle - u - v, middle + u + v, middle + u - v, false)})
    scene.facets.push_back(*facet);
  scene.centre = at;
  scene.radius = kTestHalf;
  return scene;
}

}  // namespace

HapticDriver::HapticDriver(std::unique_ptr<HapticDevice> device, const HapticSettings& settings)
    : device_(std::move(device)),
      placed_(*device_, settings.placement, settings.clutchButtons,
              settings.stylus.hand == PointerSample::Hand::Left    ? DeviceRecord::Hand::Left
              : settings.stylus.hand == PointerSample::Hand::Right ? DeviceRecord::Hand::Right
                                                                   : device_->record().hand),
      pointer_(settings.stylus),
      feeds_(settings.feeds),
      servo_(placed_, withClutch(settings.servo, settings.clutchButtons), settings.realTime) {}

bool HapticDriver::update(Session& session, Vec3 facing, bool mayFeed) {
  bool fed = false;
  const auto feed = [&](const std::optional<PointerSample>& sample) {
    if (!sample || !feeds_ || !mayFeed) return;
    session.feed(*sample);
    fed = true;
  };
  for (ServoTick tick; servo_.takeTick(tick);) {
    led_ = tick.hand.led;
    feed(pointer_.of(tick, facing));
    if (pointer_.takeLost() && feeds_ && mayFeed) session.command(Command::Cancel), fed = true;
  }
  feed(pointer_.rest());
  const ServoTick now = servo_.last();
  if (!now.hand.ready) return fed;
  const Vec3 tip = now.hand.tip.carry;
  if (testEnds_ > 0) {
    auto scene = std::make_unique<TouchScene>(testScene(testAt_));
    scene->clicks = session.touchScene(testAt_).clicks;
    const double left = testEnds_ - Servo::clock();
    if (left <= 0) testEnds_ = 0;
    if (left < kTestClick) ++scene->clicks;
    servo_.publish(std::move(scene));
  } else {
    servo_.publish(std::make_unique<TouchScene>(session.touchScene(tip)));
  }
  return fed;
}

Vec3 HapticDriver::takeLed() {
  const Vec3 since = led_ - ledTaken_;
  ledTaken_ = led_;
  return since;
}

void HapticDriver::testFeel(double seconds) {
  testAt_ = servo_.last().hand.tip.carry;
  testEnds_ = Servo::clock() + seconds;
}

}  // namespace karinui
