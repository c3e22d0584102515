// Mannequins that programs share by a folder.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "karinui/body/sizes.h"
#include "karinui/design/apply.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

class FigureFiles : public ::testing::Test {
 protected:
  FigureFiles() {
    if (const char* set = std::getenv("KARINUI_FIGURES")) before_ = set;
    std::string name = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    use(folder_);
  }
  ~FigureFiles() override {
    use(before_);
    fs::remove_all(folder_);
  }

  static void use(const fs::path& folder) { ::setenv("KARINUI_FIGURES", folder.c_str(), 1); }

  // As a program that has none yet asks for it.
  BodyPtr asked() {
    made_ = false;
    Workers workers(1);
    const Token token([&](double, const Message&) { made_ = true; });
    BodyChoice choice;
    choice.measurements = *builtInSize("jis9ar");
    const auto body = Bodies().find(choice, MemoryBlobs(), workers, token);
    EXPECT_TRUE(body);
    return body ? *body : nullptr;
  }

  std::vector<fs::path> files() const { return {fs::directory_iterator(folder_), fs::directory_iterator()}; }

  fs::path folder_, before_;
  bool made_ = false;
};

TEST_F(FigureFiles, AreReadInPlaceOfMakingAFigure) {
  const BodyPtr made = asked();
  ASSERT_TRUE(made && made_);
  ASSERT_EQ(files().size(), 1u);
  const BodyPtr read = asked();
  EXPECT_FALSE(made_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->hash(), made->hash());
  EXPECT_EQ(read->measured().value, made->measured().value);
  EXPECT_EQ(read->chartNumbers(), made->chartNumbers());
}

TEST_F(FigureFiles, ThatAreDamagedAreMadeAnew) {
  const BodyPtr made = asked();
  ASSERT_EQ(files().size(), 1u);
  const fs::path file = files().front();
  for (const long at : {5000L, -1L}) {
    const auto size = static_cast<long>(fs::file_size(file));
    if (at < 0) {
      fs::resize_file(file, static_cast<std::uintmax_t>(size / 2));
    } else {
      std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
      bytes.seekp(at);
      bytes.put('\x7f');
    }
    const BodyPtr again = asked();
    EXPECT_TRUE(made_) << at;
    ASSERT_TRUE(again);
    EXPECT_EQ(again->hash(), made->hash());
  }
  asked();
  EXPECT_FALSE(made_) << "what was damaged is kept anew";
}

TEST_F(FigureFiles, ThatCannotBeWrittenAreNoError) {
  use("/proc/nowhere");
  EXPECT_TRUE(asked());
  EXPECT_TRUE(made_);
}

}  // namespace
}  // namespace karinui
