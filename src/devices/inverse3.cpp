#include "karinui/devices/inverse3.h"

#include <poll.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>

#include "devices/json_scan.h"

namespace karinui {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Socket = asio::ip::tcp::socket;

namespace {

constexpr int kGreeting = 1000;   // milliseconds to wait for the service's answer, and for its inventory
constexpr int kReply = 3;         // milliseconds to wait for a reply in the loop
constexpr double kNominal = 7.5;  // N; the service's documents name 10 N as peak

// The service's axes (right, away, up) as ours (right, up, towards the user), and back.
Vec3 ours(Vec3 v) { return {v.x, v.z, -v.y}; }
Vec3 theirs(Vec3 v) { return {v.x, -v.z, v.y}; }

std::optional<Vec3> vectorIn(const JsonScan& state, std::string_view name) {
  const auto found = state.member(name);
  if (!found) return std::nullopt;
  const auto x = found->number("x"), y = found->number("y"), z = found->number("z");
  return x && y && z ? std::optional(Vec3{*x, *y, *z}) : std::nullopt;
}

std::uint32_t buttonsIn(const JsonScan& state) {
  std::uint32_t bits = state.flag("button", false) ? 1 : 0;
  if (const auto buttons = state.member("buttons"))
    for (const auto& [name, bit] : {std::pair("a", 1u), std::pair("b", 2u), std::pair("c", 4u)})
      if (buttons->flag(name, false)) bits |= bit;
  return bits;
}

}  // namespace

struct Inverse3::Inside {
  asio::io_context context;
  beast::websocket::stream<Socket> stream{context};
  beast::flat_static_buffer<1 << 16> buffer;
  std::string id;
  std::size_t which = 0;  // of the service's devices, and of its grips
  DeviceRecord record;
  HandSample hand;
  bool pending = false, lost = false;
  double missed = 0, patience = 0;  // seconds

  bool readable(int milliseconds) {
    if (stream.next_layer().available() > 0) return true;
    pollfd one{stream.next_layer().native_handle(), POLLIN, 0};
    return ::poll(&one, 1, milliseconds) > 0;
  }

  // Whether what was begun has ended in time; what has not is given up with the connection.
  bool finished() {
    context.restart();
    context.run_for(std::chrono::milliseconds(kGreeting));
    if (context.stopped()) return true;
    beast::error_code ignored;
    stream.next_layer().close(ignored);
    context.run();
    return false;
  }

  // A message that has come; false: the connection is lost.
  bool read() {
    buffer.clear();
    beast::error_code error;
    stream.read(buffer, error);
    return !error;
  }
  std::string_view message() const {
    const auto data = buffer.data();
    return {static_cast<const char*>(data.data()), data.size()};
  }

  void take(std::string_view text) {
    const JsonScan all(text);
    bool found = false;
    if (const auto list = all.member("inverse3"))
      list->each([&](const JsonScan& device) {
        const auto name = device.member("device_id");
        if (!name || !name->isString(id)) return true;
        const auto state = device.member("state");
        const auto place = state ? vectorIn(*state, "cursor_position") : std::nullopt;
        if (!place) return false;
        hand.tip.carry = ours(*place);
        if (const auto velocity = vectorIn(*state, "cursor_velocity")) hand.velocity = ours(*velocity);
        const auto status = device.member("status");
        hand.ready = !status || (status->flag("ready", true) && status->flag("calibrated", true));
        found = true;
        return false;
      });
    if (!found) hand.ready = false;
    std::size_t count = 0;
    for (const char* grips : {"verse_grip", "wireless_verse_grip"})
      if (const auto list = all.member(grips))
        list->each([&](const JsonScan& grip) {
          if (count++ != which) return true;
          const auto state = grip.member("state");
          if (!state) return false;
          if (const auto turn = state->member("orientation")) {
            const auto w = turn->number("w"), x = turn->number("x"), y = turn->number("y"), z = turn->number("z");
            if (w && x && y && z) {
              const Vec3 axis = ours({*x, *y, *z});
              hand.tip.w = *w, hand.tip.x = axis.x, hand.tip.y = axis.y, hand.tip.z = axis.z;
            }
          }
          hand.buttons = buttonsIn(*state);
          if (const auto hall = state->number("hall")) hand.trigger = *hall < 0 ? 0 : *hall > 1 ? 1 : *hall;
          return false;
        });
  }

  void send(Vec3 force) {
    std::array<char, 320> line;
    char *at = line.data(), *const end = at + line.size();
    bool fits = true;
    const auto words = [&](std::string_view text) {
      fits = fits && text.size() <= static_cast<std::size_t>(end - at);
      if (fits) at = std::copy(text.begin(), text.end(), at);
    };
    // With a point in every locale, which printf has not.
    const auto number = [&](std::string_view key, double value) {
      words(key);
      const auto [to, error] = std::to_chars(at, end, value, std::chars_format::fixed, 6);
      fits = fits && error == std::errc();
      at = to;
    };
    const Vec3 f = theirs(force);
    words("{\"inverse3\":[{\"device_id\":\""), words(id);
    words("\",\"commands\":{\"set_cursor_force\":{\"vector\":{");
    number("\"x\":", f.x), number(",\"y\":", f.y), number(",\"z\":", f.z);
    words("}}}}]}");
    if (!fits) return;
    beast::error_code error;
    stream.write(asio::buffer(line.data(), static_cast<std::size_t>(at - line.data())), error);
    if (error) lost = true;
    pending = !error;
  }
};

Inverse3::Inverse3() : inside_(std::make_unique<Inside>()) {}
Inverse3::~Inverse3() {
  beast::error_code ignored;
  if (inside_) inside_->stream.next_layer().close(ignored);
}
const DeviceRecord& Inverse3::record() const { return inside_->record; }

Result<std::unique_ptr<Inverse3>> Inverse3::connect(unsigned short port, double patience, std::size_t which) {
  std::unique_ptr<Inverse3> device(new Inverse3);
  Inside& in = *device->inside_;
  in.patience = patience;
  in.which = which;
  const Error none = notFound(
      say("No Haply service answers on port {0} of this machine. Start the Inverse service and try again.", int(port)));
  beast::error_code error;
  in.stream.next_layer().connect({asio::ip::address_v4::loopback(), port}, error);
  if (error) return none;
  in.stream.next_layer().set_option(asio::ip::tcp::no_delay(true), error);
  // What answers but does not greet is no Haply service.
  in.stream.async_handshake("localhost:" + std::to_string(port), "/", [&](beast::error_code e) { error = e; });
  if (!in.finished() || error) return none;
  in.stream.async_read(in.buffer, [&](beast::error_code e, std::size_t) { error = e; });
  if (!in.finished() || error) return none;
  const auto inventory = nlohmann::json::parse(in.message(), nullptr, false);
  const auto list = inventory.is_object() ? inventory.find("inverse3") : inventory.end();
  const bool any = inventory.is_object() && list != inventory.end() && list->is_array() && !list->empty();
  if (any && which > 0 && list->size() <= which)
    return notFound(say("The Haply service knows of no second Inverse3. Is it plugged in and powered?"));
  if (!any || !(*list)[which].is_object() || !(*list)[which].value("device_id", nlohmann::json()).is_string())
    return notFound(say("The Haply service knows of no Inverse3. Is it plugged in and powered?"));
  const auto& mine = (*list)[which];
  in.id = mine["device_id"].get<std::string>();
  constexpr std::size_t kLongestId = 64;
  if (in.id.size() > kLongestId || in.id.find_first_of("\"\\") != std::string::npos)
    return badInput(say("The Haply service names a device in a way that cannot be used."));
  in.record.name = "Haply Inverse3 " + in.id;
  in.record.freedomIn = inventory.contains("verse_grip") || inventory.contains("wireless_verse_grip") ? 6 : 3;
  in.record.freedomOut = 3;
  in.record.force = kNominal;
  in.record.stiffness = 800;
  in.record.damping = 8;
  in.record.workspace.include({-0.15, 0, -0.2});
  in.record.workspace.include({0.15, 0.3, 0.1});
  if (const auto config = mine.find("config"); config != mine.end() && config->is_object())
    if (const auto hand = config->find("handedness"); hand != config->end() && hand->is_string())
      in.record.hand = *hand == "left"    ? DeviceRecord::Hand::Left
                       : *hand == "right" ? DeviceRecord::Hand::Right
                                          : DeviceRecord::Hand::Either;
  in.take(in.message());
  return device;
}

HandSample Inverse3::sample() {
  Inside& in = *inside_;
  if (!in.pending && !in.lost) in.send({});  // there is no state without a command
  if (in.pending && !in.lost) {
    if (!in.readable(kReply)) {
      in.missed += kReply * 1e-3;
    } else if (in.read()) {
      in.pending = false;
      in.missed = 0;
      in.take(in.message());
    } else {
      in.lost = true;
    }
  }
  if (in.lost || in.missed >= in.patience) in.hand.ready = false;
  return in.hand;
}

void Inverse3::apply(const HandForce& force) {
  if (!inside_->pending && !inside_->lost) inside_->send(force.force);
}

void Inverse3::stop() {
  Inside& in = *inside_;
  if (!in.lost) in.send({});  // also where a reply is still missing: it is not waited for
  in.lost = true;
  beast::error_code ignored;
  in.stream.next_layer().shutdown(Socket::shutdown_both, ignored);
}

}  // namespace karinui
