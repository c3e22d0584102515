#include "karinui/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

namespace karinui {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

Error cannotWrite(const std::filesystem::path& path, int why) {
  const std::string name = path.string();
  switch (why) {
    case ENOENT:
    case ENOTDIR:
      return storageError(say("\"{0}\" cannot be written: there is no such folder. Make it first.", name));
    case EACCES:
    case EPERM:
    case EROFS:
      return storageError(say("\"{0}\" cannot be written: this place is read-only for you. Choose another.", name));
    case ENOSPC:
    case EDQUOT:
      return storageError(
          say("\"{0}\" cannot be written: the disk is full. Nothing was changed; make room first.", name));
    case EISDIR:
      return storageError(say("\"{0}\" cannot be written: it is a folder. Give a file's name.", name));
    case ENAMETOOLONG:
      return storageError(say("\"{0}\" cannot be written: the name is too long.", name));
    default:
      return storageError(say("\"{0}\" cannot be written: {1}.", name, std::strerror(why)));
  }
}

int writeAll(int file, std::string_view bytes) {  // 0, or the errno
  while (!bytes.empty()) {
    const ssize_t done = ::write(file, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
  return ::fsync(file) == 0 ? 0 : errno;
}

// Those of a new file, or of the file that is replaced.
mode_t permissions(const std::filesystem::path& path, Readers readers) {
  struct stat there {};
  if (::stat(path.c_str(), &there) == 0) return there.st_mode & 07777;
  return readers == Readers::Owner ? 0600 : 0644;
}

}  // namespace

Result<std::string> readFile(const std::filesystem::path& path, std::size_t most) {
  const std::string name = path.string();
  // Not blocking, so that a pipe without a writer is refused below rather than waited for.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file) {
    if (errno == ENOENT || errno == ENOTDIR) return notFound(say("There is no file “{0}”.", name));
    return storageError(say("\"{0}\" cannot be read: {1}.", name, std::strerror(errno)));
  }
  struct stat there {};
  if (::fstat(file.number(), &there) != 0 || !S_ISREG(there.st_mode))
    return badInput(say("\"{0}\" is not a plain file.", name));
  if (static_cast<std::size_t>(there.st_size) > most)
    return badInput(say("\"{0}\" is too large: {1} MB, at most {2} MB are read.", name,
                        static_cast<std::size_t>(there.st_size) >> 20, most >> 20));
  std::string bytes(static_cast<std::size_t>(there.st_size), '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got = ::read(file.number(), bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return storageError(say("\"{0}\" cannot be read: {1}.", name, std::strerror(errno)));
    if (got == 0) break;  // it became shorter meanwhile
    have += static_cast<std::size_t>(got);
  }
  bytes.resize(have);
  return bytes;
}

Done writeFile(const std::filesystem::path& path, std::string_view bytes, Readers readers) {
  std::error_code ignored;
  if (path.empty()) return storageError(say("A file's name is missing."));
  if (std::filesystem::is_directory(path, ignored)) return cannotWrite(path, EISDIR);
  // Writing through a link replaces the file it points to, not the link.
  const std::filesystem::path target =
      std::filesystem::is_symlink(path, ignored) ? std::filesystem::weakly_canonical(path, ignored) : path;
  if (std::filesystem::exists(target, ignored) && ::access(target.c_str(), W_OK) != 0) return cannotWrite(path, errno);
  // A device or a pipe has no old content to protect and must not be replaced by a file.
  if (std::filesystem::exists(target, ignored) && !std::filesystem::is_regular_file(target, ignored)) {
    const Descriptor file(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file) return cannotWrite(path, errno);
    const int why = writeAll(file.number(), bytes);
    return why == 0 || why == EINVAL || why == EROFS ? Done{} : Done{cannotWrite(path, why)};
  }
  const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  std::string temporary = (folder / ".karinui-XXXXXX").string();
  Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (!file) return cannotWrite(path, errno);
  int why = writeAll(file.number(), bytes);
  if (why == 0 && ::fchmod(file.number(), permissions(target, readers)) != 0) why = errno;
  if (!file.close() && why == 0) why = errno;
  if (why == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) why = errno;
  if (why != 0) {
    ::unlink(temporary.c_str());
    return cannotWrite(path, why);
  }
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory) ::fsync(directory.number());  // the new name survives a power cut too; some file systems refuse it
  return {};
}

Error inFile(const std::filesystem::path& file, Error error) {
  if (error.kind != Error::Kind::Cancelled) error.what = say("{0}: {1}", file.filename().string(), error.what);
  return error;
}

}  // namespace karinui
