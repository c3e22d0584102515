#include "karinui/devices/simulated_inverse3.h"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "karinui/touch/haptic_device.h"

namespace karinui {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Socket = asio::ip::tcp::socket;
using Json = nlohmann::json;

namespace {

const char *const kId = "04AB", *const kSecond = "FFFF";

Json vector(Vec3 v) { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }

}  // namespace

struct SimulatedInverse3::Inside {
  std::function<Vec3(double)> aim;
  bool plugged;
  HandModel model;
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor{context, {asio::ip::address_v4::loopback(), 0}};
  mutable std::mutex mutex;  // of all below
  mutable std::condition_variable changed;
  bool ended = false, silent = false, hangsUp = false, calibrated = true;
  Grip grip;
  Seen seen;
  Socket* serving = nullptr;
  std::thread thread;

  template <class T>
  T locked(const T& value) const {
    const std::lock_guard lock(mutex);
    return value;
  }

  Json state(const SimulatedHand& hand, bool full) const {
    const std::lock_guard lock(mutex);
    Json device{{"device_id", kId},
                {"state",
                 {{"cursor_position", vector(hand.place())},
                  {"cursor_velocity", vector(hand.velocity())},
                  {"angular_position", {{"a0", 1}, {"a1", 2}, {"a2", 3}}},
                  {"control_mode", "force"}}},
                {"status", {{"calibrated", calibrated}, {"ready", true}, {"power_supply", true}}}};
    if (full) device["config"] = {{"type", "inverse3"}, {"handedness", "left"}, {"device_info", {{"id", "x \" y"}}}};
    Json other = device;  // a second one, which rests
    other["device_id"] = kSecond;
    other["state"]["cursor_position"] = vector({9, 9, 9});
    Json all{{"inverse3", Json::array()},
             {"verse_grip",
              {{{"device_id", "61"},
                {"state",
                 {{"orientation", {{"w", grip.w}, {"x", grip.x}, {"y", grip.y}, {"z", grip.z}}},
                  {"buttons",
                   {{"a", (grip.buttons & 1) != 0}, {"b", (grip.buttons & 2) != 0}, {"c", (grip.buttons & 4) != 0}}},
                  {"hall", grip.hall}}}}}}};
    if (plugged) all["inverse3"] = {device, other};
    if (full) all["session_id"] = 3;
    return all;
  }

  // What one message asks for.
  Vec3 forceIn(const Json& told) {
    try {
      const Json& command = told.at("inverse3").at(0);
      const Json& f = command.at("commands").at("set_cursor_force").at("vector");
      if (command.at("device_id") == kId)
        return {f.at("x").get<double>(), f.at("y").get<double>(), f.at("z").get<double>()};
      if (command.at("device_id") == kSecond && f.at("x") == 0 && f.at("y") == 0 && f.at("z") == 0) return {};
    } catch (const Json::exception&) {
    }
    const std::lock_guard lock(mutex);
    seen.wrong = true;
    return {};
  }

  void serve() {
    while (!locked(ended)) {
      beast::error_code error;
      Socket socket(context);
      acceptor.accept(socket, error);
      if (error || locked(ended)) return;
      beast::websocket::stream<Socket> stream(std::move(socket));
      {
        const std::lock_guard lock(mutex);
        serving = &stream.next_layer();
      }
      stream.accept(error);
      if (!error) stream.next_layer().set_option(asio::ip::tcp::no_delay(true), error);
      SimulatedHand hand(aim(0), model);
      double now = 0;
      std::string line = state(hand, true).dump();
      if (!error) stream.write(asio::buffer(line), error);
      while (!error && !locked(ended) && !locked(hangsUp)) {
        beast::flat_buffer buffer;
        stream.read(buffer, error);
        if (error) break;
        const Vec3 force = forceIn(Json::parse(beast::buffers_to_string(buffer.data()), nullptr, false));
        hand.step(aim(now), force, kServoTick);
        now += kServoTick;
        {
          const std::lock_guard lock(mutex);
          ++seen.messages;
          seen.lastForce = length(force);
          seen.mostForce = std::max(seen.mostForce, seen.lastForce);
          seen.work = hand.work();
        }
        changed.notify_all();
        if (locked(silent)) continue;
        line = state(hand, false).dump();
        stream.write(asio::buffer(line), error);
      }
      const std::lock_guard lock(mutex);
      serving = nullptr;
    }
  }
};

SimulatedInverse3::SimulatedInverse3(std::function<Vec3(double)> aim, bool plugged, const HandModel& model)
    : inside_(std::make_unique<Inside>()) {
  inside_->aim = std::move(aim);
  inside_->plugged = plugged;
  inside_->model = model;
  inside_->thread = std::thread([this] { inside_->serve(); });
}

SimulatedInverse3::~SimulatedInverse3() {
  Inside& in = *inside_;
  beast::error_code ignored;
  {
    const std::lock_guard lock(in.mutex);
    in.ended = true;
    if (in.serving) in.serving->shutdown(Socket::shutdown_both, ignored);
  }
  Socket knock(in.context);  // so that it does not wait for a client any more
  knock.connect({asio::ip::address_v4::loopback(), port()}, ignored);
  in.thread.join();
}

unsigned short SimulatedInverse3::port() const { return inside_->acceptor.local_endpoint().port(); }

void SimulatedInverse3::setGrip(const Grip& grip) {
  const std::lock_guard lock(inside_->mutex);
  inside_->grip = grip;
}
void SimulatedInverse3::fallSilent() {
  const std::lock_guard lock(inside_->mutex);
  inside_->silent = true;
}
void SimulatedInverse3::hangUp() {
  const std::lock_guard lock(inside_->mutex);
  inside_->hangsUp = true;
}
void SimulatedInverse3::setCalibrated(bool calibrated) {
  const std::lock_guard lock(inside_->mutex);
  inside_->calibrated = calibrated;
}
SimulatedInverse3::Seen SimulatedInverse3::seen() const { return inside_->locked(inside_->seen); }

bool SimulatedInverse3::wait(const std::function<bool(const Seen&)>& so, double seconds) const {
  std::unique_lock lock(inside_->mutex);
  return inside_->changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return so(inside_->seen); });
}

}  // namespace karinui
