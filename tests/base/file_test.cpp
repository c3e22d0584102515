#include "karinui/base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <fstream>

// The linker (--wrap) leads the library's calls here first.
namespace {
int failingCalls = 0;  // the how manieth call from now on fails; 0: none
bool fails() { return failingCalls > 0 && --failingCalls == 0; }
int failed() { return errno = EIO, -1; }
}  // namespace
extern "C" {
int __real_mkostemp(char* name, int flags);
ssize_t __real_write(int file, const void* bytes, size_t count);
int __real_fsync(int file);
int __real_fchmod(int file, mode_t mode);
int __real_close(int file);
int __real_rename(const char* from, const char* to);
int __wrap_mkostemp(char* name, int flags) { return fails() ? failed() : __real_mkostemp(name, flags); }
ssize_t __wrap_write(int file, const void* bytes, size_t count) {
  return fails() ? failed() : __real_write(file, bytes, count);
}
int __wrap_fsync(int file) { return fails() ? failed() : __real_fsync(file); }
int __wrap_fchmod(int file, mode_t mode) { return fails() ? failed() : __real_fchmod(file, mode); }
int __wrap_close(int file) {
  const bool failing = fails();
  const int done = __real_close(file);
  return failing ? failed() : done;
}
int __wrap_rename(const char* from, const char* to) { return fails() ? failed() : __real_rename(from, to); }
}

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

// The n-th call to the system fails, for n = 1, 2, 3 … until the file was written: the old one is there, whole, and
// nothing beside it.
TEST_F(FileTest, WhicheverCallFailsTheOldFileStays) {
  ASSERT_TRUE(writeFile(folder / "a", "old"));
  const std::string bytes(300'000, 'n');
  int n = 0;
  for (bool written = false; !written;) {
    ASSERT_LT(++n, 50);
    SCOPED_TRACE("call " + std::to_string(n));
    failingCalls = n;
    const Done done = writeFile(folder / "a", bytes);
    written = failingCalls > 0;  // there was no n-th call
    failingCalls = 0;
    EXPECT_EQ(files(), 1u);
    if (written || done) {  // once it has its name, the folder's sync may fail
      EXPECT_TRUE(done);
      EXPECT_EQ(*readFile(folder / "a"), bytes);
      ASSERT_TRUE(writeFile(folder / "a", "old"));
      continue;
    }
    EXPECT_NE(text(done.error().what).find("cannot be written"), std::string::npos);
    EXPECT_EQ(*readFile(folder / "a"), "old");
  }
  EXPECT_GT(n, 6) << "made, written, synced, its mode, closed, named, the folder synced";
}

TEST_F(FileTest, AReadOnlyFolderIsSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_NE(text(writeFile(folder / "a", "1").error().what).find("read-only"), std::string::npos);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace karinui
