#pragma once
// A service as Haply documents it (3.5): a real WebSocket server on the loopback interface; a full inventory on
// connect, then one state for every message. A simulated hand holds the device.
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "karinui/touch/simulated_hand.h"

namespace karinui {

// The service speaks (right, away, up).
class SimulatedInverse3 {
 public:
  using Socket = boost::asio::ip::tcp::socket;
  std::atomic<bool> silent{false};  // does not answer any more
  std::atomic<bool> hangUp{false};  // closes the connection
  std::atomic<bool> calibrated{true};
  bool plugged = true;
  std::atomic<int> messages{0};
  std::atomic<bool> wrong{false};  // a message that is not as documented
  std::atomic<double> mostForce{0}, work{0}, lastForce{0};

  // `aim` in its own axes, by seconds of 1 ms a message.
  explicit SimulatedInverse3(std::function<Vec3(double)> aim, bool isPlugged = true)
      : plugged(isPlugged),
        aim_(std::move(aim)),
        acceptor_(context_, {boost::asio::ip::address_v4::loopback(), 0}),
        port_(acceptor_.local_endpoint().port()),
        thread_([this] { serve(); }) {}
  ~SimulatedInverse3() {
    ended_ = true;
    boost::beast::error_code ignored;
    Socket knock(context_);
    knock.connect({boost::asio::ip::address_v4::loopback(), port_}, ignored);
    {
      const std::lock_guard lock(mutex_);
      if (serving_) serving_->shutdown(Socket::shutdown_both, ignored);
    }
    thread_.join();
  }
  unsigned short port() const { return port_; }

 private:
  nlohmann::json vector(Vec3 v) const { return {{"x", v.x}, {"y", v.y}, {"z", v.z}}; }
  nlohmann::json state(const SimulatedHand& hand, bool full) const {
    nlohmann::json device{{"device_id", "04AB"},
                          {"state",
                           {{"cursor_position", vector(hand.place())},
                            {"cursor_velocity", vector(hand.velocity())},
                            {"angular_position", {{"a0", 1}, {"a1", 2}, {"a2", 3}}},
                            {"control_mode", "force"}}},
                          {"status", {{"calibrated", calibrated.load()}, {"ready", true}, {"power_supply", true}}}};
    if (full) device["config"] = {{"type", "inverse3"}, {"handedness", "left"}, {"device_info", {{"id", "x \" y"}}}};
    nlohmann::json other = device;
    other["device_id"] = "FFFF";
    other["state"]["cursor_position"] = vector({9, 9, 9});
    nlohmann::json all{{"inverse3", nlohmann::json::array()},
                       {"verse_grip",
                        {{{"device_id", "61"},
                          {"state",
                           {{"orientation", {{"w", 0.6}, {"x", 0}, {"y", 0}, {"z", 0.8}}},
                            {"buttons", {{"a", true}, {"b", false}, {"c", true}}},
                            {"hall", 0.25}}}}}}};
    if (plugged) all["inverse3"] = {device, other};
    if (full) all["session_id"] = 3;
    return all;
  }
  void serve() {
    while (!ended_) {
      boost::beast::error_code error;
      Socket socket(context_);
      acceptor_.accept(socket, error);
      if (ended_ || error) return;
      boost::beast::websocket::stream<Socket> stream(std::move(socket));
      {
        const std::lock_guard lock(mutex_);
        serving_ = &stream.next_layer();
      }
      stream.accept(error);
      SimulatedHand hand(aim_(0));
      double now = 0;
      std::string line = state(hand, true).dump();
      stream.write(boost::asio::buffer(line), error);
      while (!error && !ended_ && !hangUp) {
        boost::beast::flat_buffer buffer;
        stream.read(buffer, error);
        if (error) break;
        const auto told = nlohmann::json::parse(boost::beast::buffers_to_string(buffer.data()), nullptr, false);
        Vec3 force;
        try {
          const auto& command = told.at("inverse3").at(0);
          const auto& f = command.at("commands").at("set_cursor_force").at("vector");
          force = {f.at("x").get<double>(), f.at("y").get<double>(), f.at("z").get<double>()};
          if (command.at("device_id") != "04AB") wrong = true;
        } catch (const nlohmann::json::exception&) {
          wrong = true;
        }
        lastForce = length(force);
        ++messages;
        mostForce = std::max(mostForce.load(), length(force));
        hand.step(aim_(now), force, 0.001);
        now += 0.001;
        work = hand.work();
        if (silent) continue;
        line = state(hand, false).dump();
        stream.write(boost::asio::buffer(line), error);
      }
      const std::lock_guard lock(mutex_);
      serving_ = nullptr;
    }
  }
  std::function<Vec3(double)> aim_;
  boost::asio::io_context context_;
  boost::asio::ip::tcp::acceptor acceptor_;
  unsigned short port_;
  std::atomic<bool> ended_{false};
  std::mutex mutex_;
  Socket* serving_ = nullptr;
  std::thread thread_;
};

}  // namespace karinui
