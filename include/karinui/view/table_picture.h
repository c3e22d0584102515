#pragma once
// The flat pattern on the cutting table as a picture, without a screen and without OpenGL. Pure; any thread.
#include <vector>

#include "karinui/scene/table_frame.h"
#include "karinui/view/image.h"

namespace karinui {

struct TablePictureOptions {
  int width = 1200, height = 1600;  // pixels, 16 … 8192 each
  Language language = Language::English;
};

// The whole table with a margin, drawn as on the printed sheet: lettering as large as it is printed, seams in their
// colours, a ruler below. Scans lie under all else. Refuses an empty table. `notes` (may be null) gets what could not
// be written.
Result<Image> drawTable(const TableFrame& frame, const TablePictureOptions& options = {},
                        std::vector<Message>* notes = nullptr);

}  // namespace karinui
