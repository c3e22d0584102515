#pragma once
// What a program asks of its memory, once, when it starts.

namespace karinui {

// A drape takes and gives back the same large arrays at every step. Given back to the system, each page would have to
// be cleared anew, which takes a twentieth of the drape; up to 128 MB therefore stay with the program, in one place for
// all its threads.
void keepFreedMemory();

}  // namespace karinui
