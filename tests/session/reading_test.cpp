// A garment that may be read and not written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "design/workroom.h"
#include "karinui/session/session.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

// Root may write everything; a person who is not root may not.
class AsAPerson {
 public:
  AsAPerson() : was_(geteuid()) {
    if (was_ == 0) done_ = seteuid(65534) == 0;
  }
  ~AsAPerson() {
    if (was_ == 0 && done_) done_ = seteuid(was_) == 0;
  }
  bool is() const { return geteuid() != 0; }

 private:
  uid_t was_;
  bool done_ = false;
};

TEST(OpenedForReading, AStepIsRefusedWithTheWayOut) {
  const fs::path folder = fs::path(testing::TempDir()) / ("karinui_reading_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path path = folder / "locked.karinui";
  {
    Workroom room;
    auto file = DocumentFile::create(path);
    ASSERT_TRUE(file) << text(file.error().what);
    ASSERT_TRUE(room.play(*file, "rectangle name=patch width=10cm height=10cm\n"));
  }
  fs::permissions(path, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                              fs::perms::others_exec | fs::perms::group_read | fs::perms::group_exec);
  {
    Session session{SessionOptions()};
    const AsAPerson person;
    if (!person.is()) GTEST_SKIP() << "nobody else can be";
    session.open(path);
    session.finish();
    ASSERT_TRUE(session.readOnly());
    ASSERT_EQ(session.snapshot().document.pattern.pieces.size(), 1u);
    session.takeNotices();
    session.perform(op("rename piece=patch to=other"));
    session.finish();
    const auto told = session.takeNotices();
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].kind, Notice::Kind::Refused);
    EXPECT_THAT(text(told[0].what), testing::HasSubstr("keep a copy to work on it"));
    session.command(Command::SelectAll);
    EXPECT_EQ(session.selection().pieces.size(), 1u) << "it may be looked at";
  }
  fs::permissions(folder, fs::perms::owner_all);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace karinui
