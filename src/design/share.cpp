#include "karinui/design/share.h"

#include <algorithm>

#include "design/unnamed.h"
#include "karinui/design/steps_of.h"

namespace karinui {

namespace {

constexpr double kBetween = 0.05;  // metres between two pieces of the row

// The pieces without their forms, which are the body's shape, and in a row, for where they stood was on the body.
Pattern inARow(Pattern pattern) {
  double at = 0;
  for (auto& [id, piece] : pattern.pieces) {
    const FlatBox box = boxOf(piece->outline.flattened(1e-4));
    Piece flat = *piece;
    flat.form = nullptr;
    flat.pose = {};
    flat.pose.carry = {at - box.low.u, -box.low.v, 0};
    at += box.size().u + kBetween;
    piece = std::make_shared<const Piece>(std::move(flat));
  }
  return pattern;
}

// The same sizes, told from the one that stands.
Grading fromTheStanding(Grading grading) {
  for (auto& [id, points] : grading.pieces)
    for (GradePoint& point : points) {
      const Flat stands = point.by[grading.standing];
      for (Flat& by : point.by) by = by - stands;
    }
  grading.base = grading.standing;
  return grading;
}

SetFabric described(const std::string& name, const Fabric& fabric) {
  SetFabric op = stepOf(fabric);
  op.name = name;
  op.like = preset(name) ? name : std::string(presets().front().name);
  return op;
}

SetLook described(const Look& look) {
  SetLook op;
  op.plain = true;
  op.finish = look.finish, op.colour = look.colour, op.print = look.print, op.ink = look.ink;
  op.repeat = Length{look.repeat}, op.turn = Angle{look.turn};
  op.photo = look.photo;
  if (look.wrong) op.wrong = look.wrong->colour, op.wrongPrint = look.wrong->print, op.wrongInk = look.wrong->ink;
  return op;
}

bool sewn(const Pattern& pattern, const Allowances::At& edge) {
  const auto on = [&](const std::vector<EdgeSpan>& side) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& s) { return s.piece == edge.first && s.edge == edge.second; });
  };
  return std::any_of(pattern.seams.begin(), pattern.seams.end(),
                     [&](const auto& s) { return on(s.second.a) || on(s.second.b); });
}

// Widths and corners of edges, and what is done along them.
void addFinishing(const Document& document, std::vector<Operation>& steps) {
  const Allowances& all = document.allowances;
  const auto edge = [&](const Allowances::At& at) {
    return std::vector<EdgeRef>{{PieceRef(document.find(at.first)->name), at.second}};
  };
  const auto allowanceOf = [&](const Allowances::At& at) {
    SetAllowance op;
    op.edges = edge(at);
    op.symmetric = Choice::No;
    return op;
  };
  for (const auto& [kind, width] : all.kinds) {
    SetAllowance op;
    op.kind = kind, op.width = Length{width};
    steps.push_back(std::move(op));
  }
  for (const auto& [at, own] : all.elastics) {
    SewElastic op;
    op.edges = edge(at), op.ratio = own.ratio, op.strength = own.strength, op.symmetric = Choice::No;
    steps.push_back(std::move(op));
  }
  for (const auto& [at, own] : all.hems) {
    if (sewn(document.pattern, at)) continue;
    TurnHem op;
    op.edges = edge(at), op.width = Length{own.width}, op.under = Length{own.under}, op.symmetric = Choice::No;
    steps.push_back(std::move(op));
    SetAllowance plain = allowanceOf(at);  // its widths and corners follow as they are
    plain.plain = true;
    steps.push_back(std::move(plain));
  }
  for (const auto& [at, own] : all.topstitches) {
    SewTopstitch op;
    op.edges = edge(at), op.rows = own.rows, op.apart = Length{own.apart}, op.length = Length{own.length};
    if (findEdge(*document.find(at.first), at.second)) op.offset = Length{own.offset};
    if (const auto rgb = own.colour)
      op.colour = Dye{static_cast<std::uint8_t>(*rgb >> 16), static_cast<std::uint8_t>(*rgb >> 8),
                      static_cast<std::uint8_t>(*rgb)};
    op.symmetric = Choice::No;
    steps.push_back(std::move(op));
  }
  for (const auto& [at, own] : all.pipings)
    steps.push_back(SewPiping{edge(at), Length{own.thickness}, own.fabric, false, Choice::No});
  for (const auto& [at, own] : all.bindings)
    if (!sewn(document.pattern, at))
      steps.push_back(BindEdges{edge(at), Length{own.width}, own.fabric, false, Choice::No});
  for (const auto& [at, width] : all.edges) {
    SetAllowance op = allowanceOf(at);
    op.width = Length{width};
    steps.push_back(std::move(op));
  }
  for (const auto& [at, kind] : all.corners) {
    SetAllowance op = allowanceOf(at);
    op.start = kind;
    steps.push_back(std::move(op));
  }
}

// Buttons, zips and what else garments are closed with.
void addFastenings(const Document& document, std::vector<Operation>& steps) {
  const auto named = [&](const std::vector<EdgeSpan>& side) {
    std::vector<EdgeRef> refs;
    for (const EdgeSpan& span : side)
      refs.push_back({PieceRef(document.find(span.piece)->name), span.edge, span.from, span.to});
    return refs;
  };
  for (const auto& [name, own] : document.allowances.fastenings) {
    const double whole = length(document.pattern, own.a);
    const double before = own.at.front() * whole, behind = (1 - own.at.back()) * whole;
    Fasten op;
    op.name = name, op.kind = own.kind, op.a = named(own.a), op.b = named(own.b);
    op.reversed = own.reversed ? Choice::Yes : Choice::No;
    op.from = own.fromStart ? Fasten::From::Start : Fasten::From::End;
    op.first = Length{own.fromStart ? before : behind};
    if (own.kind == FasteningKind::Zip) {
      op.length = Length{lengthOf(document.pattern, own)};
      op.closedLength = Length{own.zipped * *op.length};
    } else {
      op.last = Length{own.fromStart ? behind : before};
      op.count = static_cast<int>(own.at.size()), op.closed = own.closed, op.inset = Length{own.inset};
    }
    if (own.kind == FasteningKind::Button || own.kind == FasteningKind::Snap) op.size = Length{own.size};
    if (own.kind == FasteningKind::Tie) op.gap = Length{own.gap};
    op.holes = own.holesAlong ? Fasten::Holes::Along : Fasten::Holes::Across;
    steps.push_back(std::move(op));
  }
}

bool samePaper(const Piece& a, const Piece& b) {
  return a.outline == b.outline && a.holes == b.holes && a.lines == b.lines && a.marks == b.marks &&
         length(a.grain - b.grain) < 1e-12 && a.fabric == b.fabric && a.interfacing == b.interfacing &&
         a.layer == b.layer;
}

// What the new document has otherwise, piece by piece.
std::vector<Message> differences(const Document& before, const Document& now) {
  std::vector<Message> notes;
  for (const auto& [id, piece] : before.pattern.pieces) {
    const Piece* made = now.pieceNamed(piece->name);
    if (!made || !samePaper(*piece, *made))
      notes.push_back(say("“{0}” is not quite as in the document; look at it before it is given away.", piece->name));
  }
  if (before.pattern.seams.size() != now.pattern.seams.size() ||
      before.allowances.hems.size() != now.allowances.hems.size())
    notes.push_back(say("Some seams or hems are not as in the document; look at it before it is given away."));
  return notes;
}

// The same error, of the file that was asked for in place of the one beside it.
Message named(Message said, const std::filesystem::path& part, const std::filesystem::path& to) {
  for (Message::Value& value : said.values) {
    if (auto* inner = std::get_if<Message>(&value)) {
      *inner = named(std::move(*inner), part, to);
      continue;
    }
    std::string& word = std::get<std::string>(value);
    if (word == part.string()) word = to.string();
    if (word == part.filename().string()) word = to.filename().string();
  }
  return said;
}

}  // namespace

std::vector<Operation> sharedSteps(const Document& document) {
  std::vector<Operation> steps;
  const Settings usual;
  if (document.settings != usual) {
    ChangeSettings op;
    op.spacing = Length{document.settings.spacing}, op.ease = Length{document.settings.ease};
    op.collider = document.settings.collider;
    steps.push_back(std::move(op));
  }
  for (const auto& [name, fabric] : document.fabrics) steps.push_back(described(name, fabric));
  Document known;
  known.fabrics = document.fabrics;
  for (Operation& step : stepsOf(inARow(document.pattern), known, fromTheStanding(document.grading)))
    steps.push_back(std::move(step));
  for (const auto& [id, piece] : document.pattern.pieces)
    if (!piece->interfacing.empty()) steps.push_back(FuseInterfacing{{PieceRef(piece->name)}, piece->interfacing});
  for (const auto& [name, look] : document.looks.fabrics) {
    SetLook op = described(look);
    op.fabric = name;
    steps.push_back(std::move(op));
  }
  for (const auto& [id, look] : document.looks.pieces) {
    SetLook op = described(look);
    op.pieces = {PieceRef(document.find(id)->name)};
    steps.push_back(std::move(op));
  }
  for (const auto& [id, shift] : document.looks.shifts) {
    SetLook op;
    op.pieces = {PieceRef(document.find(id)->name)}, op.shift = shift;
    steps.push_back(std::move(op));
  }
  addFinishing(document, steps);
  addFastenings(document, steps);
  for (const auto& [id, cutting] : document.cutting) {
    SetQuantity op;
    op.pieces = {PieceRef(document.find(id)->name)}, op.count = cutting.count, op.pairs = cutting.pairs;
    steps.push_back(std::move(op));
  }
  // Seams need not have names; the steps that sew them come in the order of their ids.
  std::map<SeamId, SeamId> now;
  auto next = document.pattern.seams.begin();
  for (std::uint32_t i = 0; i < steps.size(); ++i)
    if (std::holds_alternative<SewEdges>(steps[i])) now[(next++)->first] = madeBy<SeamId>(i + 1, 0);
  for (const auto& [id, by] : document.eases) steps.push_back(DeclareEase{SeamRef(now.at(id)), Length{by}});
  return steps;
}

Message sharedSaid(const Shared& shared) {
  std::string names;
  for (const std::string& name : shared.names) names += (names.empty() ? "" : ", ") + name;
  if (shared.names.empty())
    return say("Figure, measurements, formulas and history were left out, and all names are neutral ones.");
  return say(
      "Figure, measurements, formulas and history were left out. The names stay, of pieces, seams, fabrics, "
      "fastenings, "
      "sizes, lines, notches and edges: {0}",
      names);
}

Result<Shared> share(DocumentFile& from, const std::filesystem::path& to, Context& context, SharedNames names) {
  const Document document = names == SharedNames::Neutral ? unnamed(from.document()) : from.document();
  if (document.pattern.pieces.empty()) return refused(say("There is no piece yet; draw one on the body."));
  std::error_code trouble;
  if (!from.path().empty() && std::filesystem::equivalent(from.path(), to, trouble))
    return refused(say("“{0}” is the document itself; choose another name for what is given away.", to.string()));
  if (!to.parent_path().empty() && !std::filesystem::is_directory(to.parent_path(), trouble))
    return storageError(say("\"{0}\" cannot be written: there is no such folder. Make it first.", to.string()));
  const std::filesystem::path part = to.string() + ".part";
  std::filesystem::remove(part, trouble);
  Shared shared;
  const Done done = [&]() -> Done {
    auto file = DocumentFile::create(part);
    if (!file) return Error{file.error().kind, named(file.error().what, part, to)};
    Context own{context.workers, context.token, from.blobs(), context.bodies, {}, {}};
    for (Operation& step : sharedSteps(document)) {
      if (context.token.cancelled()) return cancelled();
      if (const auto made = file->perform(std::move(step), own); !made) return made.error();
    }
    if (names == SharedNames::Kept) shared.names = namesIn(file->document());
    shared.notes = differences(document, file->document());
    return {};
  }();
  if (done) {
    std::filesystem::rename(part, to, trouble);
    if (!trouble) return dropJournal(to), shared;
  }
  const Error why =
      done ? storageError(say("“{0}” could not be written: {1}", to.string(), trouble.message())) : done.error();
  std::filesystem::remove(part, trouble);
  return why;
}

}  // namespace karinui
