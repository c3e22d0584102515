#pragma once
// A run of edges found from one of them. Pure; any thread.
#include <vector>

#include "karinui/design/document.h"
#include "karinui/design/values.h"

namespace karinui {

// The unsewn edges that go on from `edge` on both of its sides and are called alike (neck_left, neck_right and neck):
// a whole neckline, waist or hem, in the outlines' own order. `edge` is one of an outline, by ids; sewn, it is alone.
std::vector<EdgeRef> runThrough(const Document& document, const EdgeRef& edge);

// Whether a run that goes all round, in order, is held together by nothing at some place, as a waist over a zip.
bool opensSomewhere(const Document& document, const std::vector<EdgeRef>& run);

// Whether all of them are hems: turned up, or called so and free.
bool areHems(const Document& document, const std::vector<EdgeRef>& edges);

}  // namespace karinui
