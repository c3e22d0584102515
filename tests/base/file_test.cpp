#include "karinui/base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <fstream>

namespace karinui {
namespace {

class FileTest : public testing::Test {
 protected:
  FileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "karinui-file-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~FileTest() override { std::filesystem::remove_all(folder); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
  }
  std::filesystem::path folder;
};

TEST_F(FileTest, WritesAllAndReadsItBack) {
  const std::string bytes("one\0two\n", 8);
  ASSERT_TRUE(writeFile(folder / "a", bytes));
  EXPECT_EQ(*readFile(folder / "a"), bytes);
  ASSERT_TRUE(writeFile(folder / "a", ""));
  EXPECT_EQ(*readFile(folder / "a"), "");
  EXPECT_EQ(files(), 1u) << "nothing is left beside it";
}

TEST_F(FileTest, KeepsThePermissionsAndTheLink) {
  ASSERT_TRUE(writeFile(folder / "a", "1"));
  std::filesystem::permissions(folder / "a", std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::create_symlink("a", folder / "link");
  ASSERT_TRUE(writeFile(folder / "link", "2"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(*readFile(folder / "a"), "2");
  struct stat there {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 0777, 0600u);
}

TEST_F(FileTest, TheOwnersFileIsTheOwnersAlone) {
  ASSERT_TRUE(writeFile(folder / "all", "1"));
  ASSERT_TRUE(writeFile(folder / "own", "1", Readers::Owner));
  struct stat there {};
  ASSERT_EQ(::stat((folder / "all").c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 0777, 0644u);
  ASSERT_EQ(::stat((folder / "own").c_str(), &there), 0);
  EXPECT_EQ(there.st_mode & 0777, 0600u);
}

TEST_F(FileTest, RefusesWithTheReason) {
  const auto why = [](const Done& done) { return done ? std::string("written") : text(done.error().what); };
  EXPECT_NE(why(writeFile(folder / "no" / "a", "1")).find("no such folder"), std::string::npos);
  EXPECT_NE(why(writeFile(folder, "1")).find("is a folder"), std::string::npos);
  EXPECT_NE(why(writeFile(folder / std::string(300, 'x'), "1")).find("too long"), std::string::npos);
  EXPECT_NE(why(writeFile("", "1")).find("missing"), std::string::npos);
  EXPECT_FALSE(readFile(folder));
  EXPECT_EQ(readFile(folder / "none").error().kind, Error::Kind::NotFound);
  ASSERT_TRUE(writeFile(folder / "big", std::string(1000, 'x')));
  EXPECT_FALSE(readFile(folder / "big", 999));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(readFile(folder / "pipe"));
}

TEST_F(FileTest, AFullDiskLeavesTheOldFile) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const Done done = writeFile("/dev/full", "bytes");
  ASSERT_FALSE(done);
  EXPECT_NE(text(done.error().what).find("disk is full"), std::string::npos);
}

TEST_F(FileTest, AReadOnlyFolderIsSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_NE(text(writeFile(folder / "a", "1").error().what).find("read-only"), std::string::npos);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace karinui
