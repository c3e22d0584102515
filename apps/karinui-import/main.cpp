// karinui-import FORMAT MEMORY SECONDS POINTS TRIANGLES: reads body files and photographs handed over on descriptor 0,
// answers on descriptor 1 as in exchange/import_wire.h. Not meant to be called by hand; started by readBody and
// readPrint for each file.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "reader.h"

namespace {

using namespace karinui;
using namespace karinui::import;

std::string readAll(int from) {
  std::string all;
  std::vector<char> buffer(1 << 20);
  for (;;) {
    const ssize_t n = ::read(from, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return all;
    all.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

void answer(const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(1, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(1);
    at += n, size -= static_cast<std::size_t>(n);
  }
}

// The parent wrote these lengths, but it costs nothing to check them.
bool take(std::string_view& from, std::string& part) {
  std::uint64_t size = 0;
  if (from.size() < sizeof size) return false;
  std::memcpy(&size, from.data(), sizeof size);
  from.remove_prefix(sizeof size);
  if (from.size() < size) return false;
  part = std::string(from.substr(0, size));
  from.remove_prefix(size);
  return true;
}

Reading readHandedOver(const std::string& format, const Limits& limits) {
  std::string body;
  std::map<std::string, std::string> sideFiles;
  {
    const std::string all = readAll(0);
    std::string_view rest(all);
    std::string name;
    if (!take(rest, name) || !take(rest, body)) _exit(1);
    while (!rest.empty())
      if (!take(rest, name) || !take(rest, sideFiles[name])) _exit(1);
  }
  if (format == "obj" || format == "ply") return readPolygons(body, format, limits);
  if (format == "picture") return readPicture(body, limits);
  return readGltf(body, format == "glb", sideFiles, limits);
}

}  // namespace

int main(int count, char** words) {
  if (count != 6) return 2;
  const Limits limits{std::strtoull(words[2], nullptr, 10), std::strtoull(words[3], nullptr, 10),
                      std::strtoull(words[4], nullptr, 10), std::strtoull(words[5], nullptr, 10)};
  if (!enterCell(limits)) return 3;
  Reading reading;
  try {
    reading = readHandedOver(words[1], limits);
  } catch (const std::bad_alloc&) {
    reading = {}, reading.refused = wire::Reason::Memory;
  } catch (...) {
    reading = {}, reading.refused = wire::Reason::Unreadable;
  }
  wire::Reply reply;
  if (reading.refused == wire::Reason::None && !reading.needs.empty()) {
    reply.kind = wire::Kind::Needs;
    reply.points = reading.needs.size();
    answer(&reply, sizeof reply);
    for (const std::string& name : reading.needs) {
      const std::uint64_t size = name.size();
      answer(&size, sizeof size);
      answer(name.data(), size);
    }
  } else if (reading.refused == wire::Reason::None && reading.width > 0) {
    reply.kind = wire::Kind::Picture;
    reply.points = reading.width, reply.faces = reading.height;
    answer(&reply, sizeof reply);
    answer(reading.rgb.data(), reading.rgb.size());
  } else if (reading.refused == wire::Reason::None) {
    reply.kind = wire::Kind::Mesh;
    reply.points = reading.mesh.points.size();
    reply.faces = reading.mesh.faces.size();
    answer(&reply, sizeof reply);
    answer(reading.mesh.points.data(), reply.points * sizeof(Vec3));
    answer(reading.mesh.faces.data(), reply.faces * sizeof(Triangle));
  } else {
    reply.reason = reading.refused, reply.points = reading.line;
    answer(&reply, sizeof reply);
  }
  _exit(0);  // the libraries' farewells could still trip over what they have read
}
