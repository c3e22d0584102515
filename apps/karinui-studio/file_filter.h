#pragma once
// What a file dialog offers, from the table of formats, and where a person writes to. GUI thread.
#include <QStringList>

#include "karinui/exchange/formats.h"

class QWidget;

namespace karinui::studio {

// "Bodies and patterns (*.obj *.svg)"
QString filterReading(const QString& words, FileContents contents);
QString filterWriting(const FileFormat& format);
QStringList endingsOf(const FileFormat& format);
// The chosen path with the format's ending.
QString withEnding(const QString& path, const FileFormat& format);
// Asks where to write; empty: the person left the dialog. A name with none of the endings is given the first, and what
// is there by that name is asked about like one that was typed whole.
QString askToWrite(QWidget* window, const QString& title, const QString& proposed, const QString& filter,
                   const QStringList& endings);

}  // namespace karinui::studio
