#pragma once
// What a program asks of its memory, and what it says when there is none left.
#include <new>

#include "karinui/base/result.h"

namespace karinui {

// What `work` returns; where memory runs out in it, that error. `work` must leave whole what it had begun to change.
// Throws std::bad_alloc where there is not even room for the sentence. Pure, any thread.
template <class Work>
auto withinMemory(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
  }
  return outOfMemory();
}

// A drape takes and gives back the same large arrays at every step. Given back to the system, each page would have to
// be cleared anew, which takes a twentieth of the drape; up to 128 MB therefore stay with the program, in one place for
// all its threads.
void keepFreedMemory();

}  // namespace karinui
