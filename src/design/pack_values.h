#pragma once
// The values of a document as bytes, each with what reads it again.
#include "design/pack.h"
#include "design/text/value_text.h"

namespace karinui {

inline Error damaged() { return storageError(say("A stored part of the document is damaged.")); }

// A field list as text inside the bytes: exact, and the same reader that scripts have.
template <class T>
void addText(Writer& writer, const T& value) {
  writer.add(writeValue(value));
}
template <class T>
void readText(Reader& reader, T& value) {
  if (!readValue(reader.text(), value)) reader.fail();
}

void add(Writer& w, const std::vector<EdgeSpan>& side);
std::vector<EdgeSpan> readSide(Reader& r);
void add(Writer& w, const Fabric& fabric);
Fabric readFabric(Reader& r);
void add(Writer& w, const Look& look);
Look readLook(Reader& r);
void add(Writer& w, const Underlay& underlay);
Underlay readUnderlay(Reader& r);
void add(Writer& w, const Allowances& all);  // their widths and corners
Allowances readAllowances(Reader& r);
void addElasticsAndHems(Writer& w, const Allowances& all);
void readElasticsAndHems(Reader& r, Allowances& all);
void addTrims(Writer& w, const Allowances& all);
void readTrims(Reader& r, Allowances& all);
void add(Writer& w, const Fastenings& all);
Fastenings readFastenings(Reader& r);
void add(Writer& w, const Grading& grading);
Grading readGrading(Reader& r);
void addMeasured(Writer& w, const BodyChoice& body);
void readMeasured(Reader& r, BodyChoice& body);
void add(Writer& w, const SettleReport& report);
SettleReport readReport(Reader& r);

}  // namespace karinui
