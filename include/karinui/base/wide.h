#pragma once
// Loops over plain arrays are compiled for each width of vector unit and chosen when the program starts. Every width
// gives the same bits: each output is the same few operations, none contracted, and sums run over kLanes lanes.
#include <cstddef>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define KARINUI_SANITIZED
#endif
#endif
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define KARINUI_WIDE __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#elif defined(__clang__) && defined(__x86_64__) && defined(__linux__) && !defined(KARINUI_SANITIZED)
#define KARINUI_WIDE __attribute__((target_clones("default", "avx2")))
#else
#define KARINUI_WIDE
#endif

// Before a loop: what it writes lies apart from what it reads.
#if defined(__GNUC__) && !defined(__clang__)
#define KARINUI_APART _Pragma("GCC ivdep")
#else
#define KARINUI_APART
#endif

namespace karinui {

inline constexpr std::size_t kLanes = 16;  // floats side by side; rows of arrays are padded to it

}  // namespace karinui
