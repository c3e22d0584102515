#include "design/pack_values.h"

#include "karinui/design/apply.h"

namespace karinui {

namespace {

// What a fabric's first byte says; files from before the curves hold 0 or 1.
constexpr std::uint8_t kSimcloth = 1, kCurves = 2;
constexpr std::uint8_t kWrongToo = 0x80;  // beside a look's finish: the wrong side follows
// What the byte before the measures says; files from before there were dress forms hold 0 or 1.
constexpr std::uint8_t kMale = 1, kForm = 2, kChild = 4;
// What a report's first byte says; files from before the merged planes were reported hold 0 or 1.
constexpr std::uint8_t kSettled = 1, kMerged = 2;
constexpr std::uint32_t kNoColour = ~0u;

Dye readDye(Reader& r) {
  Dye dye;
  dye.red = r.number<std::uint8_t>(), dye.green = r.number<std::uint8_t>(), dye.blue = r.number<std::uint8_t>();
  return dye;
}

// What is done along edges, by piece and edge.
template <class Own, class Read>
void readEach(Reader& r, std::map<Allowances::At, Own>& all, const Read& read) {
  for (std::size_t n = r.count(32); n > 0 && r.good(); --n) {
    const PieceId piece{r.number<std::uint64_t>()};
    Own& own = all[{piece, r.text()}];
    read(own);
    if (!sound(own)) r.fail();
  }
}

}  // namespace

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

void add(Writer& w, const Look& l) {
  w.add(static_cast<std::uint8_t>(static_cast<std::uint8_t>(l.finish) | (l.wrong ? kWrongToo : 0)));
  w.add(static_cast<std::uint8_t>(l.print));
  for (const Dye& dye : {l.colour, l.ink}) w.add(dye.red).add(dye.green).add(dye.blue);
  w.add(l.repeat).add(l.turn).add(l.photo);
  if (!l.wrong) return;
  w.add(static_cast<std::uint8_t>(l.wrong->print));
  for (const Dye& dye : {l.wrong->colour, l.wrong->ink}) w.add(dye.red).add(dye.green).add(dye.blue);
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

void addElasticsAndHems(Writer& w, const Allowances& all) {
  w.add(std::uint64_t{all.elastics.size()});
  for (const auto& [at, own] : all.elastics) w.add(at.first.value).add(at.second).add(own.ratio).add(own.strength);
  w.add(std::uint64_t{all.hems.size()});
  for (const auto& [at, own] : all.hems) w.add(at.first.value).add(at.second).add(own.width).add(own.under);
}
void readElasticsAndHems(Reader& r, Allowances& all) {
  readEach(r, all.elastics, [&](Elastic& e) { e.ratio = r.number<double>(), e.strength = r.number<double>(); });
  readEach(r, all.hems, [&](Hem& h) { h.width = r.number<double>(), h.under = r.number<double>(); });
}

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
void readTrims(Reader& r, Allowances& all) {
  readEach(r, all.topstitches, [&](Topstitch& t) {
    t.offset = r.number<double>(), t.rows = r.number<std::int32_t>(), t.apart = r.number<double>();
    t.length = r.number<double>();
    if (const auto colour = r.number<std::uint32_t>(); colour != kNoColour) t.colour = colour;
  });
  readEach(r, all.pipings, [&](Piping& p) { p.thickness = r.number<double>(), p.fabric = r.text(); });
  readEach(r, all.bindings, [&](Binding& b) { b.width = r.number<double>(), b.fabric = r.text(); });
}

}  // namespace karinui
