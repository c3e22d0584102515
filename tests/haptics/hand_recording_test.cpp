// A recorded hand is played again at the same garment and feels the same; what it felt stands beside it.
#include "karinui/haptics/hand_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "haptics/operations.h"
#include "haptics/virtual_stylus.h"
#include "karinui/base/file.h"
#include "karinui/devices/pose_source.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

class HandRecordings : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::temp_directory_path() / ("karinui_hand_" + std::to_string(::getpid()));
};

constexpr double kRest = 2;  // seconds in which the force is armed
using OnTick = std::function<void(const ServoTick&)>;

// The hand of `device` at a mannequin for so many seconds.
void work(HapticDevice& device, double seconds, const OnTick& onTick) {
  Session session(cheapSession(std::make_shared<Bodies>()));
  give(session, {"body size=jis9ar"});
  SteppedDriver driver(session, device);
  for (long k = 0; k < std::lround(seconds / SteppedDriver::kTick); ++k) {
    onTick(driver.tick());
    if (k % 16 == 0) driver.publish();
  }
}

TEST_F(HandRecordings, AreFeltTheSameWhenTheyArePlayedAgain) {
  Vec3 skin;
  {
    Session session(cheapSession(std::make_shared<Bodies>()));
    give(session, {"body size=jis9ar"});
    skin = onFront(session, 1, 0);
  }
  // Rests 3 cm before the skin, then goes 8 mm into it, along it with its button down, and out again.
  const auto aim = [&](double t) {
    const double in = std::clamp((t - 2.5) / 0.4, 0.0, 1.0) - std::clamp((t - 4) / 0.4, 0.0, 1.0);
    return skin + Vec3{0.01 * std::clamp(t - 3, 0.0, 1.0), 0, 0.03 - 0.038 * in};
  };
  SimulatedDevice hand(aim, simulatedRecord(), {0.2, 300, 8});
  const fs::path path = folder_ / "hand.txt";
  const auto recording = HandRecording::begin(path);
  ASSERT_TRUE(recording) << text(recording.error().what);
  std::vector<double> felt;  // newtons each millisecond
  std::size_t ticks = 0;
  double began = -1;
  work(hand, 5, [&](const ServoTick& tick) {
    ServoTick now = tick;
    if (now.seconds > 3.1 && now.seconds < 3.9) now.hand.buttons |= 1;
    if (now.seconds < kRest) return;
    if (began < 0) began = now.seconds;
    (*recording)->tool(now.seconds < 3.5 ? "select" : "cut");
    (*recording)->tick(now, {0, 0, 1});
    felt.push_back(length(now.out.force));
    ++ticks;
  });
  ASSERT_TRUE((*recording)->end());
  EXPECT_NEAR((*recording)->seconds(), 3, 0.03);
  EXPECT_GT(*std::max_element(felt.begin(), felt.end()), 1) << "it was felt";

  const std::string lines = *readFile(path);
  std::istringstream in(lines);
  std::size_t pointers = 0, said = 0;
  std::vector<std::string> phases, tools;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first == "#") continue;
    if (first == "tool") {
      tools.push_back(line);
    } else if (first == "felt") {
      std::array<double, 11> all{};
      for (double& one : all) words >> one;
      ASSERT_TRUE(words) << line;
      const auto k = static_cast<std::size_t>(std::lround(all[0] / SteppedDriver::kTick));
      ASSERT_LT(k, felt.size());
      EXPECT_NEAR(std::hypot(all[7], all[8], all[9]), felt[k], 2e-4);
      ++said;
    } else {
      const auto sample = parsePointerSample(line);
      ASSERT_TRUE(sample) << line;
      if (phases.empty() || phases.back() != first) phases.push_back(first);
      ++pointers;
    }
  }
  EXPECT_THAT(phases, testing::ElementsAre("hover", "press", "drag", "release", "hover"));
  EXPECT_THAT(tools, testing::ElementsAre("tool select", "tool cut"));
  EXPECT_EQ(pointers, said);
  EXPECT_LT(pointers, ticks) << "a hand that rests writes little";
  EXPECT_GT(pointers, 100u);

  auto again = ScriptedDevice::read(lines, simulatedRecord(), SteppedDriver::kTick, kRest);
  ASSERT_TRUE(again) << text(again.error().what);
  std::size_t k = 0;
  double most = 0, off = 0;
  work(*again, 5, [&](const ServoTick& tick) {
    if (tick.seconds < kRest || k >= felt.size()) return;
    const double newtons = length(tick.out.force);
    off = std::max(off, std::fabs(newtons - felt[k++]));
    most = std::max(most, newtons);
  });
  EXPECT_NEAR(most, *std::max_element(felt.begin(), felt.end()), 0.05);
  EXPECT_LT(off, 0.1);
}

TEST_F(HandRecordings, AreRefusedWhereNothingCanBeWritten) {
  const auto nowhere = HandRecording::begin(folder_ / "none" / "hand.txt");
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(text(nowhere.error().what), testing::HasSubstr("cannot be recorded in"));
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const auto full = HandRecording::begin("/dev/full");
  EXPECT_FALSE(full);
}

}  // namespace
}  // namespace karinui
