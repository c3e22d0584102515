#pragma once
// scratch
#include <cstdio>
#include <ctime>
struct Tick {
  static double now() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
  }
  struct Sum {
    const char* n;
    double s = 0;
    long c = 0;
    Sum(const char* m) : n(m) { all()[count()++] = this; }
    static Sum** all() {
      static Sum* a[64];
      return a;
    }
    static int& count() {
      static int c = 0;
      return c;
    }
    static void tell(const char* w) {
      for (int i = 0; i < count(); ++i) {
        auto& u = *all()[i];
        if (u.c) fprintf(stderr, "TICK %s %-10s %8.1f ms n=%ld each %.3f\n", w, u.n, u.s * 1e3, u.c, u.s * 1e3 / u.c);
        u.s = 0;
        u.c = 0;
      }
    }
  };
  Sum& u;
  double t0 = now();
  Tick(Sum& v) : u(v) {}
  ~Tick() {
    u.s += now() - t0;
    u.c++;
  }
};
#define TICK(name)                         \
  static Tick::Sum tick_sum_##name(#name); \
  Tick tick_##name(tick_sum_##name)
