#include "design/pack.h"

#include <tuple>

#include "design/text/value_text.h"
#include "karinui/design/apply.h"

namespace karinui {

namespace {

Error damaged() { return storageError(say("A stored part of the document is damaged.")); }

// A field list as text inside the bytes: exact, and the same reader that scripts have.
template <class T>
void addText(Writer& writer, const T& value) {
  writer.add(writeValue(value));
}
template <class T>
void readText(Reader& reader, T& value) {
  if (!readValue(reader.text(), value)) reader.fail();
}

void add(Writer& w, const std::vector<EdgeSpan>& side) {
  w.add(std::uint64_t{side.size()});
  for (const EdgeSpan& s : side) w.add(s.piece.value).add(s.edge).add(s.from).add(s.to);
}
std::vector<EdgeSpan> readSide(Reader& r) {
  std::vector<EdgeSpan> side(r.count(32));
  for (EdgeSpan& s : side) {
    s.piece.value = r.number<std::uint64_t>();
    s.edge = r.text();
    s.from = r.number<double>(), s.to = r.number<double>();
  }
  return side;
}

// What a fabric's first byte says; files from before the curves hold 0 or 1.
constexpr std::uint8_t kSimcloth = 1, kCurves = 2;

void add(Writer& w, const Fabric& f) {
  w.add(f.name).add(static_cast<std::uint8_t>((f.law == Fabric::Law::Simcloth ? kSimcloth : 0) | kCurves));
  for (const double v :
       {f.weight, f.stretchWarp, f.stretchWeft, f.shear, f.bendWarp, f.bendWeft, f.compression, f.toeWarp, f.thickness,
        f.frictionBody, f.frictionCloth, f.toeWeft, f.stiffenWarp, f.stiffenWeft, f.shearStiffen})
    w.add(v);
}
Fabric readFabric(Reader& r) {
  Fabric f;
  f.name = r.text();
  const auto flags = r.number<std::uint8_t>();
  if (flags > (kSimcloth | kCurves)) r.fail();
  f.law = flags & kSimcloth ? Fabric::Law::Simcloth : Fabric::Law::Woven;
  for (double* v : {&f.weight, &f.stretchWarp, &f.stretchWeft, &f.shear, &f.bendWarp, &f.bendWeft, &f.compression,
                    &f.toeWarp, &f.thickness, &f.frictionBody, &f.frictionCloth})
    *v = r.number<double>();
  f.toeWeft = f.toeWarp;
  if (flags & kCurves)
    for (double* v : {&f.toeWeft, &f.stiffenWarp, &f.stiffenWeft, &f.shearStiffen}) *v = r.number<double>();
  if (!checkFabric(f)) r.fail();
  return f;
}

constexpr std::uint8_t kWrongToo = 0x80;  // beside the finish: the wrong side follows
void add(Writer& w, const Look& l) {
  w.add(static_cast<std::uint8_t>(static_cast<std::uint8_t>(l.finish) | (l.wrong ? kWrongToo : 0)));
  w.add(static_cast<std::uint8_t>(l.print));
  for (const Dye& dye : {l.colour, l.ink}) w.add(dye.red).add(dye.green).add(dye.blue);
  w.add(l.repeat).add(l.turn).add(l.photo);
  if (!l.wrong) return;
  w.add(static_cast<std::uint8_t>(l.wrong->print));
  for (const Dye& dye : {l.wrong->colour, l.wrong->ink}) w.add(dye.red).add(dye.green).add(dye.blue);
}
Dye readDye(Reader& r) {
  Dye dye;
  dye.red = r.number<std::uint8_t>(), dye.green = r.number<std::uint8_t>(), dye.blue = r.number<std::uint8_t>();
  return dye;
}
Look readLook(Reader& r) {
  Look l;
  const auto first = r.number<std::uint8_t>(), print = r.number<std::uint8_t>();
  const auto finish = static_cast<std::uint8_t>(first & ~kWrongToo);
  if (finish > static_cast<std::uint8_t>(Finish::Leather) || print > static_cast<std::uint8_t>(PrintKind::Photo))
    r.fail();
  l.finish = static_cast<Finish>(finish), l.print = static_cast<PrintKind>(print);
  l.colour = readDye(r), l.ink = readDye(r);
  l.repeat = r.number<double>(), l.turn = r.number<double>();
  l.photo = r.text();
  if (first & kWrongToo) {
    const auto wrongPrint = r.number<std::uint8_t>();
    if (wrongPrint > static_cast<std::uint8_t>(PrintKind::Photo)) r.fail();
    WrongSide& wrong = l.wrong.emplace();
    wrong.print = static_cast<PrintKind>(wrongPrint);
    wrong.colour = readDye(r), wrong.ink = readDye(r);
  }
  if (!checkLook(l)) r.fail();
  return l;
}

void add(Writer& w, const Underlay& u) {
  w.add(u.photo).add(u.wide).add(u.high).add(u.at).add(u.width).add(u.turn).add(u.strength);
  w.add(static_cast<std::uint8_t>(u.hidden));
}
Underlay readUnderlay(Reader& r) {
  Underlay u;
  u.photo = r.text();
  u.wide = r.number<int>(), u.high = r.number<int>();
  u.at = r.flat();
  u.width = r.number<double>(), u.turn = r.number<double>(), u.strength = r.number<double>();
  u.hidden = r.number<std::uint8_t>() != 0;
  if (u.wide < 1 || u.high < 1 || !checkUnderlay(u)) r.fail();
  return u;
}

void add(Writer& w, const Allowances& a) {
  w.add(std::uint64_t{a.kinds.size()});
  for (const auto& [kind, width] : a.kinds) w.add(static_cast<std::uint8_t>(kind)).add(width);
  w.add(std::uint64_t{a.edges.size()});
  for (const auto& [at, width] : a.edges) w.add(at.first.value).add(at.second).add(width);
  w.add(std::uint64_t{a.corners.size()});
  for (const auto& [at, kind] : a.corners) w.add(at.first.value).add(at.second).add(static_cast<std::uint8_t>(kind));
}
Allowances readAllowances(Reader& r) {
  Allowances a;
  const auto kind = [&]<class Kind>(Kind last) {
    const auto byte = r.number<std::uint8_t>();
    if (byte > static_cast<std::uint8_t>(last)) r.fail();
    return static_cast<Kind>(byte);
  };
  const auto width = [&] {
    const auto metres = r.number<double>();
    if (!(metres >= 0 && metres <= kWidestAllowance)) r.fail();
    return metres;
  };
  const auto at = [&] {
    const PieceId piece{r.number<std::uint64_t>()};
    return Allowances::At(piece, r.text());
  };
  for (std::size_t n = r.count(9); n > 0 && r.good(); --n) {
    const EdgeKind of = kind(EdgeKind::Fold);
    a.kinds[of] = width();
  }
  for (std::size_t n = r.count(24); n > 0 && r.good(); --n) {
    const Allowances::At edge = at();
    a.edges[edge] = width();
  }
  for (std::size_t n = r.count(17); n > 0 && r.good(); --n) {
    const Allowances::At corner = at();
    a.corners[corner] = kind(CornerKind::SquareAfter);
  }
  return a;
}

void add(Writer& w, const Fastenings& all) {
  w.add(std::uint64_t{all.size()});
  for (const auto& [name, own] : all) {
    w.add(name).add(static_cast<std::uint8_t>(own.kind));
    add(w, own.a), add(w, own.b);
    w.add(static_cast<std::uint8_t>(own.reversed)).add(static_cast<std::uint8_t>(own.fromStart));
    w.add(static_cast<std::uint8_t>(own.holesAlong)).add(std::uint64_t{own.at.size()});
    for (const double at : own.at) w.add(at);
    w.add(own.closed).add(own.zipped).add(own.inset).add(own.size).add(own.gap);
  }
}
Fastenings readFastenings(Reader& r) {
  Fastenings all;
  for (std::size_t n = r.count(80); n > 0 && r.good(); --n) {
    const std::string name = r.text();
    Fastening& own = all[name];
    own.kind = static_cast<FasteningKind>(r.number<std::uint8_t>());
    own.a = readSide(r), own.b = readSide(r);
    own.reversed = r.number<std::uint8_t>() != 0, own.fromStart = r.number<std::uint8_t>() != 0;
    own.holesAlong = r.number<std::uint8_t>() != 0;
    own.at.resize(r.count(8));
    for (double& at : own.at) at = r.number<double>();
    own.closed = r.number<int>(), own.zipped = r.number<double>(), own.inset = r.number<double>();
    own.size = r.number<double>(), own.gap = r.number<double>();
    if (!sound(own)) r.fail();
  }
  return all;
}

void add(Writer& w, const Grading& g) {
  w.add(std::uint64_t{g.sizes.size()});
  for (const std::string& size : g.sizes) w.add(size);
  w.add(std::uint64_t{g.base}).add(std::uint64_t{g.standing}).add(std::uint64_t{g.pieces.size()});
  for (const auto& [id, points] : g.pieces) w.add(id.value), addText(w, points);
}
Grading readGrading(Reader& r) {
  Grading g;
  g.sizes.resize(r.count(8));
  for (std::string& size : g.sizes) size = r.text();
  g.base = r.number<std::uint64_t>(), g.standing = r.number<std::uint64_t>();
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    const PieceId id{r.number<std::uint64_t>()};
    readText(r, g.pieces[id]);
  }
  return g;
}

// What the byte before the measures says; files from before there were dress forms hold 0 or 1.
constexpr std::uint8_t kMale = 1, kForm = 2, kChild = 4;

void addMeasured(Writer& w, const BodyChoice& body) {
  const Measurements& m = body.measurements;
  w.add(static_cast<std::uint8_t>((m.sex == Sex::Male    ? kMale
                                   : m.sex == Sex::Child ? kChild
                                                         : 0) |
                                  (body.form ? kForm : 0)));
  w.add(std::uint64_t{m.value.size()});
  for (const auto& [key, value] : m.value) w.add(key).add(value);
}
void readMeasured(Reader& r, BodyChoice& body) {
  Measurements& m = body.measurements;
  const auto flags = r.number<std::uint8_t>();
  m.sex = flags & kMale ? Sex::Male : flags & kChild ? Sex::Child : Sex::Female;
  body.form = (flags & kForm) != 0;
  for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
    const std::string key = r.text();
    m.value[key] = r.number<double>();
  }
}

// What a report's first byte says; files from before the merged planes were reported hold 0 or 1.
constexpr std::uint8_t kSettled = 1, kMerged = 2;

void add(Writer& w, const SettleReport& s) {
  w.add(static_cast<std::uint8_t>((s.settled ? kSettled : 0) | (s.merged ? kMerged : 0)));
  w.add(s.why.pattern).add(std::uint64_t{s.why.values.size()});
  for (const Message::Value& value : s.why.values) w.add(text(value));
  for (const double v : {s.residual, s.step, s.penetration, s.seamGap, s.strain.mean, s.strain.p99, s.strain.max,
                         s.cpuSeconds, s.wallSeconds, s.peakMegabytes})
    w.add(std::isfinite(v) ? v : -1.0);
  w.add(std::uint64_t{s.steps}).add(std::uint64_t{s.solves});
  if (s.merged)
    for (const std::size_t v :
         {s.merged->facesBefore, s.merged->planesAfter, s.merged->testsDone, s.merged->testsSaved})
      w.add(std::uint64_t{v});
}
SettleReport readReport(Reader& r) {
  SettleReport s;
  const auto flags = r.number<std::uint8_t>();
  s.settled = (flags & kSettled) != 0;
  s.why.pattern = r.text();
  for (std::size_t n = r.count(8); n > 0 && r.good(); --n) s.why.values.emplace_back(r.text());
  for (double* v : {&s.residual, &s.step, &s.penetration, &s.seamGap, &s.strain.mean, &s.strain.p99, &s.strain.max,
                    &s.cpuSeconds, &s.wallSeconds, &s.peakMegabytes})
    *v = r.number<double>();
  s.steps = r.number<std::uint64_t>(), s.solves = r.number<std::uint64_t>();
  if (flags & kMerged) {
    MergeReport& m = s.merged.emplace();
    for (std::size_t* v : {&m.facesBefore, &m.planesAfter, &m.testsDone, &m.testsSaved}) *v = r.number<std::uint64_t>();
  }
  return s;
}

constexpr std::uint32_t kNoColour = ~0u;

void addTrims(Writer& w, const Allowances& all) {
  w.add(std::uint64_t{all.topstitches.size()});
  for (const auto& [at, own] : all.topstitches) {
    w.add(at.first.value).add(at.second).add(own.offset).add(static_cast<std::int32_t>(own.rows)).add(own.apart);
    w.add(own.length).add(own.colour.value_or(kNoColour));
  }
  w.add(std::uint64_t{all.pipings.size()});
  for (const auto& [at, own] : all.pipings) w.add(at.first.value).add(at.second).add(own.thickness).add(own.fabric);
  w.add(std::uint64_t{all.bindings.size()});
  for (const auto& [at, own] : all.bindings) w.add(at.first.value).add(at.second).add(own.width).add(own.fabric);
}

}  // namespace

std::string packPiece(const Piece& p) {
  Writer w;
  w.add(p.id.value).add(p.name);
  addText(w, p.outline), addText(w, p.holes), addText(w, p.lines), addText(w, p.marks);
  w.add(p.grain).add(p.fabric).add(p.layer).add(static_cast<std::uint8_t>(p.frozen)).add(p.mirrorOf.value);
  w.add(p.pose.w).add(p.pose.x).add(p.pose.y).add(p.pose.z).add(p.pose.carry);
  if (!p.interfacing.empty()) w.add(p.interfacing);  // pieces without are packed as before there was any
  return w.taken();
}

Result<Piece> unpackPiece(std::string_view bytes) {
  Reader r(bytes);
  Piece p;
  p.id.value = r.number<std::uint64_t>();
  p.name = r.text();
  readText(r, p.outline), readText(r, p.holes), readText(r, p.lines), readText(r, p.marks);
  p.grain = r.flat();
  p.fabric = r.text();
  p.layer = r.number<int>();
  p.frozen = r.number<std::uint8_t>() != 0;
  p.mirrorOf.value = r.number<std::uint64_t>();
  p.pose.w = r.number<double>(), p.pose.x = r.number<double>(), p.pose.y = r.number<double>(),
  p.pose.z = r.number<double>();
  p.pose.carry = r.vec3();
  if (r.good() && !r.finished() && (p.interfacing = r.text()).empty()) r.fail();
  if (!r.finished() || !p.id || !checkName(p.name)) return damaged();
  return p;
}

std::string packForm(const Form& form) {
  Writer w;
  w.all(form.flat).all(form.space).all(form.faces);
  return w.taken();
}

Result<std::shared_ptr<const Form>> unpackForm(std::string_view bytes) {
  Reader r(bytes);
  auto form = std::make_shared<Form>();
  form->flat.resize(r.count(16));
  for (Flat& p : form->flat) p = r.flat();
  form->space.resize(r.count(24));
  for (Vec3& p : form->space) p = r.vec3();
  form->faces.resize(r.count(12));
  for (Triangle& t : form->faces) t = r.triangle(form->flat.size());
  if (!r.finished() || form->flat.size() != form->space.size()) return damaged();
  return std::shared_ptr<const Form>(std::move(form));
}

std::string packRest(const Document& d) {
  Writer w;
  w.add(d.operations).add(d.body.size).add(d.body.mesh).add(d.body.hash);
  addMeasured(w, d.body);
  w.add(std::uint64_t{d.pattern.seams.size()});
  for (const auto& [id, s] : d.pattern.seams) {
    w.add(id.value).add(s.name);
    add(w, s.a), add(w, s.b);
    w.add(static_cast<std::uint8_t>(s.reversed)).add(static_cast<std::uint8_t>(s.tie));
  }
  w.add(std::uint64_t{d.fabrics.size()});
  for (const auto& [name, fabric] : d.fabrics) w.add(name), add(w, fabric);
  w.add(std::uint64_t{d.pins.size()});
  for (const auto& [id, places] : d.pins) w.add(id.value).all(places);
  w.add(d.settings.spacing).add(static_cast<std::uint8_t>(d.settings.collider)).add(d.settings.ease);
  w.add(static_cast<std::uint8_t>(d.drape.last.has_value()));
  if (d.drape.last) add(w, *d.drape.last);
  w.all(d.drape.force).add(std::uint64_t{d.drape.dirty.size()});
  for (const PieceId id : d.drape.dirty) w.add(id.value);
  const bool shifted = !d.looks.shifts.empty(), traced = !d.underlays.empty() || shifted;
  const bool trimmed = d.allowances.trimmed() || traced;
  const bool posed = !d.body.pose.empty() || !d.drape.rested.empty() || trimmed;
  const bool fastened = !d.allowances.fastenings.empty() || posed, graded = !d.grading.empty() || fastened;
  const bool finishing = !d.allowances.empty() || !d.cutting.empty() || !d.eases.empty() || graded;
  if (!d.looks.empty() || !d.variables.empty() || finishing) {  // files of before they were kept end here
    w.add(std::uint64_t{d.looks.fabrics.size()});
    for (const auto& [name, look] : d.looks.fabrics) w.add(name), add(w, look);
    w.add(std::uint64_t{d.looks.pieces.size()});
    for (const auto& [id, look] : d.looks.pieces) w.add(id.value), add(w, look);
  }
  if (!d.variables.empty() || finishing)
    w.add(std::uint64_t{d.variables.size()});  // documents without are packed as before them
  for (const auto& [name, formula] : d.variables) w.add(name).add(formula);
  if (finishing) {
    add(w, d.allowances);
    w.add(std::uint64_t{d.cutting.size()});
    for (const auto& [id, cutting] : d.cutting)
      w.add(id.value).add(cutting.count).add(static_cast<std::uint8_t>(cutting.pairs));
    w.add(std::uint64_t{d.eases.size()});
    for (const auto& [id, ease] : d.eases) w.add(id.value).add(ease);
    if (const auto& [elastics, hems] = std::tie(d.allowances.elastics, d.allowances.hems);
        !elastics.empty() || !hems.empty() || graded) {
      w.add(std::uint64_t{elastics.size()});
      for (const auto& [at, own] : elastics) w.add(at.first.value).add(at.second).add(own.ratio).add(own.strength);
      w.add(std::uint64_t{hems.size()});
      for (const auto& [at, own] : hems) w.add(at.first.value).add(at.second).add(own.width).add(own.under);
    }
  }
  if (graded) add(w, d.grading);
  if (fastened) add(w, d.allowances.fastenings);
  if (posed) {
    w.add(d.body.own).add(std::uint64_t{d.body.pose.size()});
    for (const auto& [joint, a] : d.body.pose)
      w.add(static_cast<std::uint8_t>(joint)).add(a.flex).add(a.abduct).add(a.turn);
    w.add(std::uint64_t{d.drape.rested.size()});
    for (const RestedInPose& rested : d.drape.rested) {
      w.add(rested.garment).add(std::uint64_t{rested.forms.size()});
      for (const auto& [id, form] : rested.forms) w.add(id.value);  // the forms are parts of their own
    }
  }
  if (trimmed) addTrims(w, d.allowances);
  if (traced) {
    w.add(std::uint64_t{d.underlays.size()});
    for (const auto& [name, underlay] : d.underlays) w.add(name), add(w, underlay);
  }
  if (shifted) {
    w.add(std::uint64_t{d.looks.shifts.size()});
    for (const auto& [id, shift] : d.looks.shifts) w.add(id.value).add(shift);
  }
  return w.taken();
}

Result<Document> unpackRest(std::string_view bytes) {
  Reader r(bytes);
  Document d;
  d.operations = r.number<std::uint32_t>();
  d.body.size = r.text(), d.body.mesh = r.text(), d.body.hash = r.text();
  readMeasured(r, d.body);
  for (std::size_t n = r.count(34); n > 0 && r.good(); --n) {
    Seam s;
    s.id.value = r.number<std::uint64_t>();
    s.name = r.text();
    s.a = readSide(r), s.b = readSide(r);
    s.reversed = r.number<std::uint8_t>() != 0;
    s.tie = static_cast<Seam::Tie>(r.number<std::uint8_t>());
    if (s.tie > Seam::Tie::Pleat) r.fail();
    d.pattern.seams[s.id] = std::move(s);
  }
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
  if (!r.finished() && r.good()) {
    for (std::size_t n = r.count(40); n > 0 && r.good(); --n) {
      const std::string name = r.text();
      d.looks.fabrics[name] = readLook(r);
    }
    for (std::size_t n = r.count(40); n > 0 && r.good(); --n) {
      const PieceId id{r.number<std::uint64_t>()};
      d.looks.pieces[id] = readLook(r);
    }
  }
  if (r.good() && !r.finished())
    for (std::size_t n = r.count(16); n > 0 && r.good(); --n) {
      const std::string name = r.text();
      d.variables[name] = r.text();
    }
  if (r.good() && !r.finished()) {
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
  const auto each = [&](auto& all, auto read) {
    for (std::size_t n = r.count(32); n > 0 && r.good(); --n) {
      const PieceId piece{r.number<std::uint64_t>()};
      auto& own = all[{piece, r.text()}];
      read(own);
      if (!sound(own)) r.fail();
    }
  };
  if (r.good() && !r.finished()) {
    each(d.allowances.elastics, [&](Elastic& e) { e.ratio = r.number<double>(), e.strength = r.number<double>(); });
    each(d.allowances.hems, [&](Hem& h) { h.width = r.number<double>(), h.under = r.number<double>(); });
  }
  if (r.good() && !r.finished()) d.grading = readGrading(r);
  if (r.good() && !r.finished()) d.allowances.fastenings = readFastenings(r);
  if (r.good() && !r.finished()) {
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
  if (r.good() && !r.finished()) {
    each(d.allowances.topstitches, [&](Topstitch& t) {
      t.offset = r.number<double>(), t.rows = r.number<std::int32_t>(), t.apart = r.number<double>();
      t.length = r.number<double>();
      if (const auto colour = r.number<std::uint32_t>(); colour != kNoColour) t.colour = colour;
    });
    each(d.allowances.pipings, [&](Piping& p) { p.thickness = r.number<double>(), p.fabric = r.text(); });
    each(d.allowances.bindings, [&](Binding& b) { b.width = r.number<double>(), b.fabric = r.text(); });
  }
  if (r.good() && !r.finished())
    for (std::size_t n = r.count(64); n > 0 && r.good(); --n) {
      const std::string name = r.text();
      d.underlays[name] = readUnderlay(r);
    }
  if (r.good() && !r.finished())
    for (std::size_t n = r.count(24); n > 0 && r.good(); --n) {
      const PieceId id{r.number<std::uint64_t>()};
      d.looks.shifts[id] = r.flat();
    }
  if (!r.finished()) return damaged();
  return d;
}

}  // namespace karinui
