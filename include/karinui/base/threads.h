#pragma once
// How many threads a program uses that was told no number.

namespace karinui {

// The environment's KARINUI_THREADS, from 1 to 256; where it says nothing of the kind, as many as there are processors.
int usualThreads();

}  // namespace karinui
