#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>

#include "reader.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define KARINUI_SHADOW_MEMORY 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define KARINUI_SHADOW_MEMORY 1
#endif

namespace karinui::import {
namespace {

bool limit(__rlimit_resource what, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  return setrlimit(what, &both) == 0;
}

bool limit(__rlimit_resource what, rlim_t most) { return limit(what, most, most); }

}  // namespace

bool enterCell(const Limits& limits) {
#ifndef KARINUI_SHADOW_MEMORY  // sanitizers reserve terabytes of addresses
  if (!limit(RLIMIT_AS, limits.memoryBytes)) return false;
#endif
  // Where both limits are equal the kernel looks at the hard one first and sends SIGKILL: the parent could not tell a
  // file that takes too long from one that makes the reader fail. Above the soft limit it sends SIGXCPU.
  if (!limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1) || !limit(RLIMIT_CORE, 0) || !limit(RLIMIT_FSIZE, 0))
    return false;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0) return false;
  // Everything else, above all every way to open a file or a socket or to start a program, is answered "not allowed".
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EACCES));
  if (!filter) return false;
  bool done = true;
  for (const int call :
       {SCMP_SYS(read),         SCMP_SYS(write),       SCMP_SYS(lseek),         SCMP_SYS(fstat),
        SCMP_SYS(newfstatat),   SCMP_SYS(mmap),        SCMP_SYS(munmap),        SCMP_SYS(mremap),
        SCMP_SYS(mprotect),     SCMP_SYS(madvise),     SCMP_SYS(brk),           SCMP_SYS(futex),
        SCMP_SYS(exit),         SCMP_SYS(exit_group),  SCMP_SYS(rt_sigreturn),  SCMP_SYS(rt_sigprocmask),
        SCMP_SYS(rt_sigaction), SCMP_SYS(sigaltstack), SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday),
        SCMP_SYS(getrandom),    SCMP_SYS(getpid),      SCMP_SYS(gettid),        SCMP_SYS(tgkill),
        SCMP_SYS(sched_yield)})
    done = seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) == 0 && done;
  done = done && seccomp_load(filter) == 0;
  seccomp_release(filter);
  return done;
}

}  // namespace karinui::import
