// Everything of a document but its pieces.
#include <algorithm>
#include <iterator>

#include "design/pack_values.h"
#include "karinui/design/apply.h"

namespace karinui {

namespace {

void writeSeams(Writer& w, const std::map<SeamId, Seam>& seams) {
  w.add(std::uint64_t{seams.size()});
  for (const auto& [id, s] : seams) {
    w.add(id.value).add(s.name);
    add(w, s.a), add(w, s.b);
    w.add(static_cast<std::uint8_t>(s.reversed)).add(static_cast<std::uint8_t>(s.tie));
  }
}
void readSeams(Reader& r, std::map<SeamId, Seam>& seams) {
  for (std::size_t n = r.count(34); n > 0 && r.good(); --n) {
    Seam s;
    s.id.value = r.number<std::uint64_t>();
    s.name = r.text();
    s.a = readSide(r), s.b = readSide(r);
    s.reversed = r.number<std::uint8_t>() != 0;
    s.tie = static_cast<Seam::Tie>(r.number<std::uint8_t>());
    if (s.tie > Seam::Tie::Pleat) r.fail();
    seams[s.id] = std::move(s);
  }
}

// What every document has.
void writeFirst(Writer& w, const Document& d) {
  w.add(d.operations).add(d.body.size).add(d.body.mesh).add(d.body.hash);
  addMeasured(w, d.body);
  writeSeams(w, d.pattern.seams);
  w.add(std::uint64_t{d.fabrics.size()});
  for (const auto& [name, fabric] : d.fabrics) w.add(name), add(w, fabric);
  w.add(std::uint64_t{d.pins.size()});
  for (const auto& [id, places] : d.pins) w.add(id.value).all(places);
  w.add(d.settings.spacing).add(static_cast<std::uint8_t>(d.settings.collider)).add(d.settings.ease);
  w.add(static_cast<std::uint8_t>(d.drape.last.has_value()));
  if (d.drape.last) add(w, *d.drape.last);
  w.all(d.drape.force).add(std::uint64_t{d.drape.dirty.size()});
  for (const PieceId id : d.drape.dirty) w.add(id.value);
}
void readFirst(Reader& r, Document& d) {
  d.operations = r.number<std::uint32_t>();
  d.body.size = r.text(), d.body.mesh = r.text(), d.body.hash = r.text();
  readMeasured(r, d.body);
  readSeams(r, d.pattern.seams);
  for (std::size_t n = r.count(90); n > 0 && r.good(); --n) {
    const std::string name = r.text();
    d.fabrics[name] = readFabric(r);
  }
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    auto& places = d.pins[{r.number<std::uint64_t>()}];
    places.resize(r.count(16));
    for (Flat& p : places) p = r.flat();
  }
  d.settings.spacing = r.number<double>();
  d.settings.collider = r.number<std::uint8_t>() == 0 ? Settings::Collider::Field : Settings::Collider::Planes;
  d.settings.ease = r.number<double>();
  if (r.number<std::uint8_t>() != 0) d.drape.last = readReport(r);
  d.drape.force.resize(r.count(24));
  for (Vec3& f : d.drape.force) f = r.vec3();
  for (std::size_t n = r.count(8); n > 0 && r.good(); --n) d.drape.dirty.insert({r.number<std::uint64_t>()});
}

bool hasLooks(const Document& d) { return !d.looks.empty(); }
void writeLooks(Writer& w, const Document& d) {
  w.add(std::uint64_t{d.looks.fabrics.size()});
  for (const auto& [name, look] : d.looks.fabrics) w.add(name), add(w, look);
  w.add(std::uint64_t{d.looks.pieces.size()});
  for (const auto& [id, look] : d.looks.pieces) w.add(id.value), add(w, look);
}
void readLooks(Reader& r, Document& d) {
  for (std::size_t n = r.count(40); n > 0 && r.good(); --n) {
    const std::string name = r.text();
    d.looks.fabrics[name] = readLook(r);
  }
  for (std::size_t n = r.count(40); n > 0 && r.good(); --n) {
    const PieceId id{r.number<std::uint64_t>()};
    d.looks.pieces[id] = readLook(r);
  }
}

bool hasVariables(const Document& d) { return !d.variables.empty(); }
void writeVariables(Writer& w, const Document& d) {
  w.add(std::uint64_t{d.variables.size()});
  for (const auto& [name, formula] : d.variables) w.add(name).add(formula);
}
void readVariables(Reader& r, Document& d) {
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    const std::string name = r.text();
    d.variables[name] = r.text();
  }
}

bool hasFinish(const Document& d) { return !d.allowances.plain() || !d.cutting.empty() || !d.eases.empty(); }
void writeFinish(Writer& w, const Document& d) {
  add(w, d.allowances);
  w.add(std::uint64_t{d.cutting.size()});
  for (const auto& [id, cutting] : d.cutting)
    w.add(id.value).add(cutting.count).add(static_cast<std::uint8_t>(cutting.pairs));
  w.add(std::uint64_t{d.eases.size()});
  for (const auto& [id, ease] : d.eases) w.add(id.value).add(ease);
}
void readFinish(Reader& r, Document& d) {
  d.allowances = readAllowances(r);
  for (std::size_t n = r.count(13); n > 0 && r.good(); --n) {
    Cutting& cutting = d.cutting[{r.number<std::uint64_t>()}];
    cutting.count = r.number<int>(), cutting.pairs = r.number<std::uint8_t>() != 0;
    if (cutting.count < 1 || cutting.count > kMostCut) r.fail();
  }
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    const SeamId id{r.number<std::uint64_t>()};
    if (!((d.eases[id] = r.number<double>()) > 0)) r.fail();
  }
}

bool hasElasticsOrHems(const Document& d) { return !d.allowances.elastics.empty() || !d.allowances.hems.empty(); }
bool hasGrading(const Document& d) { return !d.grading.empty(); }
bool hasFastenings(const Document& d) { return !d.allowances.fastenings.empty(); }

bool hasPose(const Document& d) { return !d.body.pose.empty() || !d.drape.rested.empty(); }
void writePose(Writer& w, const Document& d) {
  w.add(d.body.own).add(std::uint64_t{d.body.pose.size()});
  for (const auto& [joint, a] : d.body.pose)
    w.add(static_cast<std::uint8_t>(joint)).add(a.flex).add(a.abduct).add(a.turn);
  w.add(std::uint64_t{d.drape.rested.size()});
  for (const RestedInPose& rested : d.drape.rested) {
    w.add(rested.garment).add(std::uint64_t{rested.forms.size()});
    for (const auto& [id, form] : rested.forms) w.add(id.value);  // the forms are parts of their own
  }
}
void readPose(Reader& r, Document& d) {
  d.body.own = r.text();
  for (std::size_t n = r.count(25); n > 0 && r.good(); --n) {
    const auto joint = r.number<std::uint8_t>();
    if (joint >= kJoints) r.fail();
    JointAngles& a = d.body.pose[static_cast<Joint>(joint)];
    a.flex = r.number<double>(), a.abduct = r.number<double>(), a.turn = r.number<double>();
  }
  if (!withinLimits(d.body.pose)) r.fail();
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    RestedInPose& rested = d.drape.rested.emplace_back();
    rested.garment = r.text();
    for (std::size_t k = r.count(8); k > 0 && r.good(); --k) rested.forms[{r.number<std::uint64_t>()}] = nullptr;
  }
  if (d.drape.rested.size() > kMostRested) r.fail();
}

bool hasTrims(const Document& d) { return d.allowances.trimmed(); }

bool hasUnderlays(const Document& d) { return !d.underlays.empty(); }
void writeUnderlays(Writer& w, const Document& d) {
  w.add(std::uint64_t{d.underlays.size()});
  for (const auto& [name, underlay] : d.underlays) w.add(name), add(w, underlay);
}
void readUnderlays(Reader& r, Document& d) {
  for (std::size_t n = r.count(64); n > 0 && r.good(); --n) {
    const std::string name = r.text();
    d.underlays[name] = readUnderlay(r);
  }
}

bool hasShifts(const Document& d) { return !d.looks.shifts.empty(); }
void writeShifts(Writer& w, const Document& d) {
  w.add(std::uint64_t{d.looks.shifts.size()});
  for (const auto& [id, shift] : d.looks.shifts) w.add(id.value).add(shift);
}
void readShifts(Reader& r, Document& d) {
  for (std::size_t n = r.count(24); n > 0 && r.good(); --n) {
    const PieceId id{r.number<std::uint64_t>()};
    d.looks.shifts[id] = r.flat();
  }
}

// Parts in the order in which the format got them. A document ends with the last that it has something in, so that
// one without the newer ones is packed, and hashed, as before there were any.
struct LaterPart {
  bool (*has)(const Document&);
  void (*write)(Writer&, const Document&);
  void (*read)(Reader&, Document&);
};
constexpr LaterPart kLaterParts[] = {
    {hasLooks, writeLooks, readLooks},
    {hasVariables, writeVariables, readVariables},
    {hasFinish, writeFinish, readFinish},
    {hasElasticsOrHems, [](Writer& w, const Document& d) { addElasticsAndHems(w, d.allowances); },
     [](Reader& r, Document& d) { readElasticsAndHems(r, d.allowances); }},
    {hasGrading, [](Writer& w, const Document& d) { add(w, d.grading); },
     [](Reader& r, Document& d) { d.grading = readGrading(r); }},
    {hasFastenings, [](Writer& w, const Document& d) { add(w, d.allowances.fastenings); },
     [](Reader& r, Document& d) { d.allowances.fastenings = readFastenings(r); }},
    {hasPose, writePose, readPose},
    {hasTrims, [](Writer& w, const Document& d) { addTrims(w, d.allowances); },
     [](Reader& r, Document& d) { readTrims(r, d.allowances); }},
    {hasUnderlays, writeUnderlays, readUnderlays},
    {hasShifts, writeShifts, readShifts}};

}  // namespace

std::string packRest(const Document& document) {
  Writer w;
  writeFirst(w, document);
  const auto last = std::find_if(std::rbegin(kLaterParts), std::rend(kLaterParts),
                                 [&](const LaterPart& part) { return part.has(document); });
  for (auto part = std::begin(kLaterParts); part != last.base(); ++part) part->write(w, document);
  return w.taken();
}

Result<Document> unpackRest(std::string_view bytes) {
  Reader r(bytes);
  Document document;
  readFirst(r, document);
  for (const LaterPart& part : kLaterParts)
    if (r.good() && !r.finished()) part.read(r, document);
  if (!r.finished()) return damaged();
  return document;
}

}  // namespace karinui
