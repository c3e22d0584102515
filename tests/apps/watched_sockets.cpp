// Loaded before the C library (LD_PRELOAD), it writes down every socket that a program makes, and whom it speaks to, in
// the file KARINUI_SOCKETS.
#include <arpa/inet.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

void tell(const std::string& line) {
  const char* path = std::getenv("KARINUI_SOCKETS");
  const int file = path ? ::open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600) : -1;
  if (file < 0) return;
  (void)!::write(file, (line + "\n").data(), line.size() + 1);
  ::close(file);
}

std::string said(const sockaddr* address, socklen_t size) {
  char words[INET6_ADDRSTRLEN] = {};
  if (address->sa_family == AF_INET)
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, words, sizeof words);
  else if (address->sa_family == AF_INET6)
    ::inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr, words, sizeof words);
  else if (address->sa_family == AF_UNIX) {
    const auto* path = reinterpret_cast<const sockaddr_un*>(address)->sun_path;
    if (path[0] != '\0' || size <= sizeof(sa_family_t) + 1) return std::string("unix ") + path;
    return "unix @" + std::string(path + 1, size - sizeof(sa_family_t) - 1);  // a name that is no file's
  }
  return std::string("inet ") + words;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int socket(int domain, int type, int protocol) {
  tell(domain == AF_UNIX ? "socket unix" : domain == AF_INET || domain == AF_INET6 ? "socket inet" : "socket other");
  return real<int(int, int, int)>("socket")(domain, type, protocol);
}

int connect(int file, const sockaddr* address, socklen_t size) {
  tell("connect " + said(address, size));
  return real<int(int, const sockaddr*, socklen_t)>("connect")(file, address, size);
}

int bind(int file, const sockaddr* address, socklen_t size) {
  tell("bind " + said(address, size));
  return real<int(int, const sockaddr*, socklen_t)>("bind")(file, address, size);
}

int getaddrinfo(const char* node, const char* service, const addrinfo* hints, addrinfo** found) {
  tell(std::string("look up ") + (node ? node : ""));
  return real<int(const char*, const char*, const addrinfo*, addrinfo**)>("getaddrinfo")(node, service, hints, found);
}

}  // extern "C"
