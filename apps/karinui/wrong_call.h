#pragma once
// A call that cannot be understood, in a sentence of our own: what is wrong, where, and what to do.
#include "commands.h"

namespace karinui::app {

Message wrongCall(const Program& program, const CLI::ParseError& trouble);

}  // namespace karinui::app
