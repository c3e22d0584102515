#include "karinui/haptics/haptic_driver.h"

#include <chrono>

namespace karinui {

namespace {

constexpr std::chrono::milliseconds kPeriod(8);  // from scene to scene

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
      longestPause_(settings.longestPause),
      servo_(placed_, withClutch(settings.servo, settings.clutchButtons), settings.realTime),
      publisher_([this] { publishScenes(); }) {}

HapticDriver::~HapticDriver() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ends_.notify_all();
  publisher_.join();
}

void HapticDriver::publishScenes() {
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, kPeriod, [this] { return ended_; })) {
    const double now = Servo::clock();
    if (!source_.garment || now - taken_ > longestPause_) continue;
    const TouchSource source = source_;
    const Test test = test_;
    lock.unlock();
    const ServoTick tick = servo_.last();
    if (tick.hand.ready) {
      const auto proxy = tick.touching ? std::optional(tick.proxy) : std::nullopt;
      auto scene = std::make_unique<TouchScene>(test.ends > now ? testScene(test.at)
                                                                : source.sceneAt(tick.hand.tip.carry, proxy));
      scene->clicks = source.handling.clicks;
      if (test.ends > now && test.ends - now < kTestClick) ++scene->clicks;
      servo_.publish(std::move(scene));
    }
    lock.lock();
  }
}

bool HapticDriver::update(Session& session, Vec3 facing, bool mayFeed) {
  bool fed = false;
  const auto feed = [&](const std::optional<PointerSample>& sample) {
    if (!sample || !feeds_ || !mayFeed) return;
    session.feed(*sample);
    fed = true;
  };
  for (ServoTick tick; servo_.takeTick(tick);) {
    led_ = tick.hand.led;
    if (recording_) recording_->tool(info(session.tool()).name), recording_->tick(tick, facing);
    feed(pointer_.of(tick, facing));
    if (pointer_.takeLost() && feeds_ && mayFeed) session.command(Command::Cancel), fed = true;
  }
  feed(pointer_.rest());
  TouchSource source = session.touchSource();
  const std::lock_guard lock(mutex_);
  std::swap(source_, source);
  taken_ = Servo::clock();
  return fed;
}

Vec3 HapticDriver::takeLed() {
  const Vec3 since = led_ - ledTaken_;
  ledTaken_ = led_;
  return since;
}

void HapticDriver::testFeel(double seconds) {
  const Vec3 at = servo_.last().hand.tip.carry;
  const std::lock_guard lock(mutex_);
  test_ = {Servo::clock() + seconds, at};
}

}  // namespace karinui
