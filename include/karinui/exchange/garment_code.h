#pragma once
// Patterns of GarmentCode (its `*_specification.json`): panels with straight, quadratic, cubic and circular edges,
// where each stands around the body, and what is stitched to what. Centimetres there (or what properties.units_in_meter
// says), metres here. Pure functions on text; any thread.
//
// Right side out: GarmentCode's panels run counter-clockwise seen from the fabric's right side, so a panel that runs
// clockwise on its own paper is turned over, and its pose turns it back. Hence every outline here is counter-clockwise
// and an ordinary stitch is a seam with `reversed`, as GarmentCode's own rule has it (the end of one edge meets the
// start of the other). Older files do not keep that rule; where most stitches contradict it, the ends that lie nearer
// in space meet.
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// Pieces are numbered in the file's panel_order (else by name), seams in the order of its stitches.
// An edge takes its label as name where that is usable and its own, else "edge_N", N its place in the panel.
Result<Pattern> readGarmentCode(std::string_view json);

// Edges are split where a seam begins or ends within them, since a stitch there joins whole edges. What the format
// cannot hold is left out: holes, internal lines, marks, grain, fabric. A draped piece stands flat, in the plane
// nearest to it.
Result<std::string> writeGarmentCode(const Pattern& pattern);

}  // namespace karinui
