#pragma once
// What a hand does and feels, written while it happens (docs/format/recorded-hand.md): of each tick of the force loop
// that brings something new a pointer line with the device's own tip, which `karinui touch replay` plays again, and a
// line "felt" with proxy and force. Metres, newtons, seconds since it began. One thread.
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "karinui/haptics/stylus_pointer.h"

namespace karinui {

class HandRecording {
 public:
  // A new file, or in place of what is there. `settings`: which button is the main one, and the hand.
  static Result<std::unique_ptr<HandRecording>> begin(const std::filesystem::path& path,
                                                      const StylusSettings& settings = {});

  void tool(std::string_view name);               // what the hand holds from now on: "pull"
  void tick(const ServoTick& tick, Vec3 facing);  // in order; `facing`: unit, towards who looks
  double seconds() const { return written_ ? written_->seconds - *began_ : 0; }
  const std::filesystem::path& path() const { return path_; }
  Done end();  // refused: what could not be written, as on a full disk

 private:
  HandRecording(std::filesystem::path path, const StylusSettings& settings);
  std::filesystem::path path_;
  std::ofstream file_;
  StylusSettings settings_;
  std::string tool_;
  std::optional<double> began_;       // on the loop's clock
  std::optional<ServoTick> written_;  // the last one
};

}  // namespace karinui
