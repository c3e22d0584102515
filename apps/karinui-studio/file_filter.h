#pragma once
// What a file dialog offers, from the table of formats. GUI thread.
#include <QString>

#include "karinui/exchange/formats.h"

namespace karinui::studio {

// "Bodies and patterns (*.obj *.svg)"
QString filterReading(const QString& words, FileContents contents);
QString filterWriting(const FileFormat& format);
// The chosen path with the format's ending.
QString withEnding(const QString& path, const FileFormat& format);

}  // namespace karinui::studio
