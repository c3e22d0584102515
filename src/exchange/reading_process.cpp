#include "exchange/reading_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>

#include "exchange/import_wire.h"
#include "karinui/base/file.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest = 1e6;  // no coordinate of any unit lies beyond a kilometre in millimetres

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

bool writeAll(int to, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(to, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, size -= static_cast<std::size_t>(n);
  }
  return true;
}

struct HandedOver {
  std::string name, bytes;
};

Error noProcess() {
  return storageError(say("The reader of body files could not be started ({0}).", std::strerror(errno)));
}

// The files, laid one after the other in memory that has no name anywhere.
Result<Descriptor> inMemory(const std::vector<HandedOver>& files) {
  Descriptor memory(::memfd_create("body", MFD_CLOEXEC));
  if (!memory) return noProcess();
  for (const HandedOver& file : files) {
    const std::uint64_t nameSize = file.name.size(), size = file.bytes.size();
    if (!writeAll(memory.get(), &nameSize, sizeof nameSize) || !writeAll(memory.get(), file.name.data(), nameSize) ||
        !writeAll(memory.get(), &size, sizeof size) || !writeAll(memory.get(), file.bytes.data(), size))
      return noProcess();
  }
  ::lseek(memory.get(), 0, SEEK_SET);
  return memory;
}

// A started karinui-import. Whatever happens, it does not outlive this object.
class Child {
 public:
  static Result<Child> start(const fs::path& helper, const std::string& format, const BodyReadLimits& limits,
                             const Descriptor& input) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return noProcess();
    Descriptor from(ends[0]), to(ends[1]);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input.get(), 0);
    posix_spawn_file_actions_adddup2(&actions, to.get(), 1);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions, 3);
    std::vector<std::string> words{helper.string(),
                                   format,
                                   std::to_string(limits.memoryBytes),
                                   std::to_string(limits.seconds),
                                   std::to_string(limits.points),
                                   std::to_string(limits.triangles)};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    char* noEnvironment[] = {nullptr};
    pid_t pid = -1;
    const int failed = posix_spawn(&pid, helper.c_str(), &actions, nullptr, arguments.data(), noEnvironment);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
      errno = failed;
      return noProcess();
    }
    return Child(pid, std::move(from));
  }
  Child(Child&& other) noexcept : pid_(std::exchange(other.pid_, -1)), from_(std::move(other.from_)) {}
  Child& operator=(Child&&) = delete;
  ~Child() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    wait();
  }

  // Everything it says until it is silent for good.
  Result<std::string> listen(const BodyReadLimits& limits, const Token& token) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(limits.seconds);
    const std::size_t atMost = sizeof(wire::Reply) + limits.points * 3 * sizeof(double) + limits.triangles * 12;
    std::string said;
    std::vector<char> buffer(1 << 16);
    for (;;) {
      if (token.cancelled()) return cancelled();
      if (std::chrono::steady_clock::now() >= deadline)
        return badInput(
            say("Reading the file took longer than {0} {0|second|seconds} and was stopped.", limits.seconds));
      pollfd waiting{from_.get(), POLLIN, 0};
      const int ready = ::poll(&waiting, 1, 50);
      if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
      const ssize_t n = ::read(from_.get(), buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      said.append(buffer.data(), static_cast<std::size_t>(n));
      if (said.size() > atMost) return badInput(say("The file holds more than {0} triangles.", limits.triangles));
    }
    const int status = wait();
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
      return badInput(say("Reading the file took longer than {0} {0|second|seconds} and was stopped.", limits.seconds));
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      return badInput(say("The file is damaged: reading it made the reader fail. Nothing was taken from it."));
    return said;
  }

 private:
  Child(pid_t pid, Descriptor from) : pid_(pid), from_(std::move(from)) {}
  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }
  pid_t pid_;
  Descriptor from_;
};

// `line`: of the file, where it is known.
Error refusal(wire::Reason reason, const BodyReadLimits& limits, std::uint64_t line = 0) {
  switch (reason) {
    case wire::Reason::Index:
      return badInput(
          say("In line {0} a face names a point that is not there. Save the body anew where it was made.", line));
    case wire::Reason::Cut:
      return badInput(
          say("The file breaks off in line {0}, in the middle of a point or a face. Copy it again, or save it anew "
              "where it was made.",
              line));
    case wire::Reason::NoSurface:
      if (line > 0)
        return badInput(
            say("The file ends with line {0} and holds no face: it was cut off, or is no surface. Copy it again, or "
                "save the body as a mesh of triangles.",
                line));
      return badInput(say("The file holds no surface, not a single triangle; save the body as a mesh of triangles."));
    case wire::Reason::TooLarge:
      return badInput(say("The file holds more than {0} {0|point|points} or {1} {1|triangle|triangles}.", limits.points,
                          limits.triangles));
    case wire::Reason::Memory:
      return badInput(say("Reading the file needs more than {0} MB of memory.", limits.memoryBytes >> 20));
    case wire::Reason::TooDeep:
      return badInput(say("The parts of the file are nested more than 64 deep or within themselves."));
    case wire::Reason::Unsupported:
      return badInput(say("The file keeps its surface in a way that cannot be read here; save it as plain triangles."));
    default:
      return badInput(say("The file is damaged or is not what its name says; save it anew where it was made."));
  }
}

Error damagedReply() { return refusal(wire::Reason::Unreadable, {}); }

Result<TriangleMesh> checkedMesh(std::string_view body, const wire::Reply& reply, const BodyReadLimits& limits) {
  if (reply.points > limits.points || reply.faces > limits.triangles) return refusal(wire::Reason::TooLarge, limits);
  if (reply.points == 0 || reply.faces == 0) return refusal(wire::Reason::NoSurface, limits);
  static_assert(sizeof(Vec3) == 24 && sizeof(Triangle) == 12);
  const std::size_t pointBytes = reply.points * sizeof(Vec3), faceBytes = reply.faces * sizeof(Triangle);
  if (body.size() != pointBytes + faceBytes) return damagedReply();
  TriangleMesh mesh;
  mesh.points.resize(reply.points);
  mesh.faces.resize(reply.faces);
  std::memcpy(static_cast<void*>(mesh.points.data()), body.data(), pointBytes);
  std::memcpy(static_cast<void*>(mesh.faces.data()), body.data() + pointBytes, faceBytes);
  for (const Triangle& f : mesh.faces)
    for (std::uint32_t i : f)
      if (i >= mesh.points.size()) return badInput(say("A triangle of the file names a point that is not there."));
  for (Vec3 p : mesh.points) {
    if (!finite(p)) return badInput(say("The file holds coordinates that are not numbers."));
    if (std::fabs(p.x) > kFarthest || std::fabs(p.y) > kFarthest || std::fabs(p.z) > kFarthest)
      return badInput(say("The file holds coordinates beyond {0}; no body is that large.", kFarthest));
  }
  return mesh;
}

bool bareName(const std::string& name) {
  return !name.empty() && name.size() <= wire::kLongestName && name != "." && name != ".." &&
         name.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos;
}

// The side files that the child asks for, if they lie beside the file under a plain name.
Result<std::vector<std::string>> sideNames(std::string_view body, const wire::Reply& reply) {
  if (reply.points == 0 || reply.points > wire::kMostSideFiles) return damagedReply();
  std::vector<std::string> names;
  for (std::uint64_t i = 0; i < reply.points; ++i) {
    std::uint64_t size = 0;
    if (body.size() < sizeof size) return damagedReply();
    std::memcpy(&size, body.data(), sizeof size);
    body.remove_prefix(sizeof size);
    if (size > body.size()) return damagedReply();
    std::string name(body.substr(0, size));
    body.remove_prefix(size);
    if (!bareName(name))
      return badInput(
          say("The file wants to read something that does not lie beside it under a plain name. Not done."));
    names.push_back(std::move(name));
  }
  return names;
}

// The head of what the child said, and what follows it.
std::optional<wire::Reply> headOf(std::string_view& said) {
  wire::Reply reply;
  if (said.size() < sizeof reply) return std::nullopt;
  std::memcpy(&reply, said.data(), sizeof reply);
  said.remove_prefix(sizeof reply);
  return reply.magic == wire::kMagic ? std::optional(reply) : std::nullopt;
}

// `folder`: where side files may lie.
Result<TriangleMesh> meshIn(std::string bytes, const std::string& format, const fs::path& folder,
                            const fs::path& helper, const BodyReadLimits& limits, const Token& token) {
  std::size_t bytesLeft = limits.fileBytes - bytes.size();
  std::vector<HandedOver> files;
  files.push_back({"body", std::move(bytes)});
  for (const bool second : {false, true}) {
    const auto input = inMemory(files);
    if (!input) return input.error();
    auto child = Child::start(helper, format, limits, *input);
    if (!child) return child.error();
    const auto said = child->listen(limits, token);
    if (!said) return said.error();
    auto reply = meshReply(*said, limits);
    if (!reply) return reply.error();
    if (auto* mesh = std::get_if<TriangleMesh>(&*reply)) return std::move(*mesh);
    if (second) return damagedReply();
    for (std::string& name : std::get<std::vector<std::string>>(*reply)) {
      auto side = readPlainFile(folder / name, bytesLeft, false);
      if (!side) return side.error();
      bytesLeft -= side->size();
      files.push_back({std::move(name), std::move(*side)});
    }
  }
  return damagedReply();
}

}  // namespace

Result<MeshReply> meshReply(std::string_view said, const BodyReadLimits& limits) {
  const auto reply = headOf(said);
  if (!reply) return damagedReply();
  if (reply->kind == wire::Kind::Mesh) {
    auto mesh = checkedMesh(said, *reply, limits);
    if (!mesh) return mesh.error();
    return MeshReply(std::move(*mesh));
  }
  if (reply->kind != wire::Kind::Needs) return refusal(reply->reason, limits, reply->points);
  auto names = sideNames(said, *reply);
  if (!names) return names.error();
  return MeshReply(std::move(*names));
}

Result<PrintPixels> pictureReply(std::string_view said, std::size_t mostPixels) {
  const auto wrong = [&](wire::Reason why) {
    return why == wire::Reason::TooLarge
               ? badInput(
                     say("The photograph has more than {0} million pixels; make it smaller.", mostPixels / 1'000'000))
               : badInput(say("This is no photograph that can be read, or a damaged one; PNG and JPEG can."));
  };
  const auto reply = headOf(said);
  if (!reply) return wrong(wire::Reason::Unreadable);
  if (reply->kind != wire::Kind::Picture) return wrong(reply->reason);
  if (reply->points == 0 || reply->faces == 0 || reply->points > 65535 || reply->faces > 65535 ||
      reply->points * reply->faces > mostPixels || said.size() != 3 * reply->points * reply->faces)
    return wrong(wire::Reason::Unreadable);
  return PrintPixels{static_cast<int>(reply->points), static_cast<int>(reply->faces), {said.begin(), said.end()}};
}

Result<std::string> readPlainFile(const fs::path& path, std::size_t atMost, bool followLinks) {
  const std::string name = path.filename().string();
  // O_NONBLOCK: a named pipe must not make us wait for a writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | (followLinks ? 0 : O_NOFOLLOW)));
  if (!file && errno == ENOENT) return notFound(say("There is no file {0}.", name));
  struct stat about {};
  if (!file || ::fstat(file.get(), &about) != 0)
    return storageError(say("{0} cannot be read ({1}).", name, std::strerror(errno)));
  if (!S_ISREG(about.st_mode)) return badInput(say("{0} is not a file.", name));
  if (static_cast<std::uint64_t>(about.st_size) > atMost)
    return badInput(say("{0} is larger than {1} MB.", name, atMost >> 20));
  std::string bytes(static_cast<std::size_t>(about.st_size), '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t n = ::read(file.get(), bytes.data() + have, bytes.size() - have);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return storageError(say("{0} cannot be read ({1}).", name, std::strerror(errno)));
    if (n == 0) break;
    have += static_cast<std::size_t>(n);
  }
  bytes.resize(have);
  return bytes;
}

Result<fs::path> importHelper(const fs::path& asked) {
  if (!asked.empty()) return asked;
  std::error_code trouble;
  const fs::path here = fs::read_symlink("/proc/self/exe", trouble).parent_path();
  for (const fs::path& candidate : {here / "karinui-import", here / "../libexec/karinui/karinui-import"})
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  return notFound(say("The reader of body files, karinui-import, is not installed beside this program."));
}

Result<PrintPixels> readPictureInOtherProcess(const fs::path& path, const fs::path& helper, std::size_t mostPixels,
                                              const Token& token) {
  BodyReadLimits limits;
  limits.fileBytes = 64u << 20;
  limits.points = mostPixels;
  limits.triangles = 0;
  auto bytes = readPlainFile(path, limits.fileBytes, true);
  if (!bytes) return bytes.error();
  std::vector<HandedOver> files;
  files.push_back({"picture", std::move(*bytes)});
  const auto input = inMemory(files);
  if (!input) return input.error();
  auto child = Child::start(helper, "picture", limits, *input);
  if (!child) return child.error();
  const auto said = child->listen(limits, token);
  if (!said) return inFile(path, said.error());
  auto pixels = pictureReply(*said, mostPixels);
  if (!pixels) return inFile(path, pixels.error());
  return pixels;
}

Result<TriangleMesh> readInOtherProcess(const fs::path& path, const std::string& format, const fs::path& helper,
                                        const BodyReadLimits& limits, const Token& token) {
  auto main = readPlainFile(path, limits.fileBytes, true);
  if (!main) return main.error();
  if (main->empty()) return badInput(say("{0} is empty.", path.filename().string()));
  auto mesh = meshIn(std::move(*main), format, path.parent_path(), helper, limits, token);
  if (!mesh) return inFile(path, mesh.error());
  return mesh;
}

}  // namespace karinui
