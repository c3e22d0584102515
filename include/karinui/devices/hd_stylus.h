#pragma once
// 3D Systems Touch and Phantom through the maker's library, libHD, loaded when it is asked for: nothing of it is needed
// to build. Our own declarations of its C interface. UNTESTED ON HARDWARE; tests prove the calls and their order before
// a library of our own.
#include <memory>

#include "karinui/base/result.h"
#include "karinui/touch/haptic_device.h"

namespace karinui {

class HdStylus : public HapticDevice {
 public:
  // The default device. NotFound, with a sentence, where the library or the device is not there.
  static Result<std::unique_ptr<HdStylus>> open(const std::string& library = "libHD.so");
  static bool libraryThere(const std::string& library = "libHD.so");
  ~HdStylus() override;
  const DeviceRecord& record() const override;
  HandSample sample() override;                 // the newest its own scheduler has seen
  void apply(const HandForce& force) override;  // for its next tick; gone after 20 of them without another
  void stop() override;

 private:
  HdStylus();
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace karinui
