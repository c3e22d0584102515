#pragma once
// Haply Inverse3 (with a VerseGrip for orientation and buttons, where there is one) through the maker's service: JSON
// over a WebSocket on this machine, one state back for each force sent. Written from the service's documentation
// (3.5); not tried on hardware. The service lets the device go idle when nothing is sent.
#include <memory>

#include "karinui/base/result.h"
#include "karinui/touch/haptic_device.h"

namespace karinui {

class Inverse3 : public HapticDevice {
 public:
  static constexpr unsigned short kPort = 10001;
  static constexpr double kPatience = 0.020;  // seconds without a reply, then the device is not ready
  // An Inverse3 of the service on the loopback interface with the grip that goes with it, counted from 0 as the service
  // lists them. NotFound, with a sentence, where there is none.
  static Result<std::unique_ptr<Inverse3>> connect(unsigned short port = kPort, double patience = kPatience,
                                                   std::size_t which = 0);
  ~Inverse3() override;
  const DeviceRecord& record() const override;
  HandSample sample() override;
  void apply(const HandForce& force) override;
  void stop() override;

 private:
  Inverse3();
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace karinui
