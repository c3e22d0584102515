#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "karinui/view/image.h"

namespace karinui {
namespace {

Error diskSaid(const std::string& path, int why) {
  return storageError(say("The picture {0} could not be written: {1}.", path, std::strerror(why)));
}

}  // namespace

Done writePng(const std::string& path, const Image& image) {
  auto bytes = encodePng(image);
  if (!bytes) return bytes.error();
  // Beside the goal, so that the rename stays within one file system and is atomic.
  std::string fresh = path + ".XXXXXX";
  const int file = ::mkstemp(fresh.data());
  if (file < 0) return diskSaid(path, errno);
  const std::uint8_t* from = bytes->data();
  std::size_t left = bytes->size();
  int why = 0;
  while (left > 0 && why == 0) {
    const ssize_t put = ::write(file, from, left);
    if (put >= 0) {
      from += put;
      left -= static_cast<std::size_t>(put);
    } else if (errno != EINTR) {
      why = errno;
    }
  }
  if (why == 0 && ::fchmod(file, 0644) != 0) why = errno;  // mkstemp's file is for its owner only
  if (why == 0 && ::fsync(file) != 0) why = errno;
  if (::close(file) != 0 && why == 0) why = errno;
  if (why == 0 && std::rename(fresh.c_str(), path.c_str()) != 0) why = errno;
  if (why == 0) return {};
  ::unlink(fresh.c_str());
  return diskSaid(path, why);
}

}  // namespace karinui
