#pragma once
// The garments that stand side by side in one picture.
#include <string>
#include <vector>

#include "karinui/session/view_cut.h"
#include "karinui/view/line_up.h"
#include "open_document.h"

namespace karinui::app {

// One of these beside the garment that is open: other documents, all its sizes, or fabrics ("cotton silk"). None: it
// stands alone.
struct ComparisonWish {
  std::vector<std::string> beside;
  bool sizes = false;
  std::string fabrics;
  bool any() const { return !beside.empty() || sizes || !fabrics.empty(); }
};
struct Compared {
  std::vector<LineUp::Figure> figures;  // one that stands alone has no name
  std::vector<SceneFrame> frames;
  double mapTop = 0;  // of the map's scale; 0: the frames' own
};
// Sizes and fabrics are brought to rest: long. What does not hang at rest is told, and said below its picture.
Result<Compared> compared(OpenDocument& opened, const ComparisonWish& wish, const ViewCut& cut, Map map);

// Columns of a sheet of so many figures: rows of like length, eight at most.
int columnsOf(std::size_t figures);

// A garment of an open document as a map shows it, without what is cut away.
struct SeenGarment {
  SceneFrame frame;
  double mapTop = 0;  // as above
};
Result<SeenGarment> seen(OpenDocument& opened, const Document& document, const ViewCut& cut, Map map);

}  // namespace karinui::app
