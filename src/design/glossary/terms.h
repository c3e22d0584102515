#pragma once
// The tables of the glossary, one for each kind of term, each in the order of its identifiers. Built on first need; any
// thread.
#include <span>
#include <string_view>
#include <vector>

#include "karinui/base/message.h"

namespace karinui {

struct NamedTerm {
  std::string_view identifier;
  Message name;
};
using TermTable = std::span<const NamedTerm>;

TermTable measureTerms();
TermTable landmarkTerms();
TermTable partTerms();
TermTable levelTerms();
TermTable sizeTerms();

TermTable operationTerms();
TermTable fieldTerms();
TermTable valueTerms();

// Whether an edge was named by its number only: "e3", "e3_right", "edge_0".
bool isNumbered(std::string_view edge);

TermTable fabricTerms();
TermTable wordTerms();
TermTable fasteningTerms();  // those that are words for edges otherwise

}  // namespace karinui
