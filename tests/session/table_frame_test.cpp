// The cutting table as data: everything of the garment is on it, inside its pieces, and where the printed sheet has it.
#include "karinui/design/piece_label.h"
#include "karinui/session/table_frame_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exchange/patterns.h"
#include "exchange/sheet.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/label_room.h"

namespace karinui {
namespace {

constexpr double kTiny = 1e-9;

struct Table {
  SnapshotPtr garment;
  TableLayout layout;
  explicit Table(Pattern pattern) {
    Document document;
    document.pattern = std::move(pattern);
    garment = snapshotOf(std::move(document), nullptr);
    layout.arrange(*garment);
  }
  TableFrame frame(const Selection& chosen = {}, const TableFrameOptions& options = {},
                   LetteringRooms* rooms = nullptr) const {
    return tableFrameOf(*garment, layout, chosen, options, rooms);
  }
  const Pattern& pattern() const { return garment->document.pattern; }
};

// A skirt's front with a dart at the waist, sewn, and sewn to a back at one half of its side.
Pattern skirt() {
  Pattern pattern;
  const auto rectangle = [](std::uint32_t n, const char* name) {
    Piece piece;
    piece.id = madeBy<PieceId>(1, n);
    piece.name = name;
    piece.outline.edges = {{"hem", Curve::line({0, 0}, {0.4, 0})},
                           {"right", Curve::line({0.4, 0}, {0.4, 0.5})},
                           {"waist", Curve::line({0.4, 0.5}, {0, 0.5})},
                           {"left", Curve::line({0, 0.5}, {0, 0})}};
    return piece;
  };
  const auto darted = addDart(rectangle(0, "front"), "waist", 0.5, 0.03, {0.2, 0.38}, "dart");
  EXPECT_TRUE(darted);
  const Piece front = darted->edited.piece, back = rectangle(1, "back");
  const auto sew = [&](std::uint32_t n, EdgeSpan a, EdgeSpan b) {
    const SeamId id = madeBy<SeamId>(2, n);
    pattern.seams[id] = {id, "", {std::move(a)}, {std::move(b)}, true, Seam::Tie::OneToOne};
  };
  sew(0, {front.id, darted->to, 0, 1}, {front.id, darted->back, 0, 1});
  sew(1, {front.id, "right", 0, 1}, {back.id, "left", 0, 1});
  sew(2, {front.id, "left", 0, 0.5}, {back.id, "right", 0.5, 1});
  for (const Piece& piece : {front, back}) pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  return pattern;
}

const TableEdge& edge(const TableFrame& frame, const std::string& piece, const std::string& name) {
  for (const TablePiece& one : frame.pieces)
    for (const TableEdge& found : one.edges)
      if (one.name == piece && found.name == name) return found;
  ADD_FAILURE() << piece << "." << name << " is not on the table";
  static const TableEdge none;
  return none;
}

// Wide hems and sizes far larger than the one that stands lie in no neighbour, also where they come when the pieces lie
// on the table already.
TEST(TableFrame, CutLinesAndSizesKeepClearOfNeighbours) {
  Document plain;
  for (std::uint32_t n = 0; n < 6; ++n) {
    Piece piece;
    piece.id = madeBy<PieceId>(1, n);
    piece.name = "piece" + std::to_string(n);
    piece.outline.edges = {{"hem", Curve::line({0, 0}, {0.4, 0})},
                           {"right", Curve::line({0.4, 0}, {0.4, 0.5})},
                           {"waist", Curve::line({0.4, 0.5}, {0, 0.5})},
                           {"left", Curve::line({0, 0.5}, {0, 0})}};
    plain.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  }
  Document sized = plain;
  sized.grading.sizes = {"S", "M", "L"};
  for (const auto& [id, piece] : plain.pattern.pieces) {
    plain.allowances.edges[{id, "hem"}] = sized.allowances.edges[{id, "hem"}] = 0.09;
    const auto by = [](double u, double v) { return std::vector<Flat>{{}, {u, v}, {2 * u, 2 * v}}; };
    sized.grading.pieces[id] = {{"hem", 0, by(-.04, -.03)},
                                {"right", 0, by(.04, -.03)},
                                {"waist", 0, by(.04, .05)},
                                {"left", 0, by(-.04, .05)}};
  }
  TableLayout layout;
  for (const Document& document : {plain, sized}) {
    const SnapshotPtr garment = snapshotOf(document, nullptr);
    layout.arrange(*garment);
    TableFrameOptions options;
    options.nest = true;
    const TableFrame frame = tableFrameOf(*garment, layout, {}, options, nullptr);
    std::vector<Box> boxes;
    for (const TablePiece& piece : frame.pieces) {
      Box box;
      const auto hold = [&](const Ring& ring) {
        for (const Flat p : ring) box.include({p.u, p.v, 0});
      };
      for (const Ring& cut : piece.cut) hold(cut);
      for (const TableSize& size : piece.nest) hold(size.outline);
      EXPECT_EQ(piece.nest.size(), document.grading.empty() ? 0u : 2u) << piece.name;
      boxes.push_back(box);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const Box &a = boxes[i], &b = boxes[k];
        EXPECT_FALSE(a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y)
            << i << " " << k << " " << document.grading.sizes.size();
      }
  }
}

TEST(TableFrame, HasEveryPieceEdgeAndSeam) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Table table(test::random(seed));
    const TableFrame frame = table.frame();
    ASSERT_EQ(frame.pieces.size(), table.pattern().pieces.size());
    ASSERT_EQ(frame.seams.size(), table.pattern().seams.size());
    std::size_t k = 0;
    for (const auto& [id, piece] : table.pattern().pieces) {
      const TablePiece& drawn = frame.pieces[k++];
      EXPECT_EQ(drawn.name, piece->name);
      ASSERT_EQ(drawn.edges.size(), piece->outline.edges.size());
      ASSERT_EQ(drawn.holes.size(), piece->holes.size());
      ASSERT_EQ(drawn.holes[0].size(), 2u);
      for (std::size_t i = 0; i < drawn.edges.size(); ++i) {
        const Curve& curve = piece->outline.edges[i].curve;
        EXPECT_EQ(drawn.edges[i].name, piece->outline.edges[i].name);
        EXPECT_EQ(drawn.edges[i].length, curve.length());
        EXPECT_LT(distance(drawn.edges[i].points.front(), curve.start + table.layout.at(id)), kTiny);
        EXPECT_LT(distance(drawn.edges[i].points.back(), curve.end + table.layout.at(id)), kTiny);
      }
      EXPECT_EQ(drawn.drills.size(), 1u);
      EXPECT_EQ(drawn.lines.size(), 2u) << "the two curves of a pocket";
      EXPECT_EQ(std::count_if(drawn.notches.begin(), drawn.notches.end(), [](const auto& n) { return n.own; }), 1);
      EXPECT_GE(drawn.labels.size(), 2u);
    }
    for (const TableSeam& seam : frame.seams)
      for (const TableSeam::Side& side : seam.sides) EXPECT_EQ(side.ticks.size(), 2u) << seam.name;
    EXPECT_EQ(frame.seams[1].sides[1].runs.size(), 2u) << "a side over two edges";
  }
}

TEST(TableFrame, TellsWhatIsSewnToWhat) {
  const Table table(skirt());
  const TableFrame frame = table.frame();
  using State = TableEdge::State;
  EXPECT_EQ(edge(frame, "front", "right").state, State::Sewn);
  EXPECT_EQ(edge(frame, "front", "right").seam, edge(frame, "back", "left").seam);
  EXPECT_EQ(edge(frame, "front", "left").state, State::PartlySewn);
  EXPECT_EQ(edge(frame, "front", "hem").state, State::Open);
  EXPECT_FALSE(edge(frame, "front", "hem").seam);
  std::size_t legs = 0;
  for (const TableEdge& one : frame.pieces[0].edges) legs += one.dart;
  EXPECT_EQ(legs, 2u);
  for (const TableEdge& one : frame.pieces[1].edges) EXPECT_FALSE(one.dart) << one.name;
  for (const TablePiece& piece : frame.pieces) {
    EXPECT_FALSE(piece.notches.empty()) << "side seams of half a metre get balance notches";
    for (const TableNotch& notch : piece.notches) EXPECT_FALSE(notch.own) << "no seam has a name here";
  }
  // The ticks of a seam are as far from where it begins on both sides: on the front going up, on the back going down.
  const auto& [a, b] = frame.seams[1].sides;
  const Flat front = table.layout.at(madeBy<PieceId>(1, 0)), back = table.layout.at(madeBy<PieceId>(1, 1));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(a.ticks[i].place.v - front.v, b.ticks[i].place.v - back.v, kTiny) << "sewn place on place";
  EXPECT_GT(std::hypot(frame.seams[1].colour[0] - frame.seams[2].colour[0],
                       frame.seams[1].colour[1] - frame.seams[2].colour[1]),
            0.05);
}

TEST(TableFrame, WhatIsChosenIsMarked) {
  const Table table(skirt());
  Selection chosen;
  chosen.pieces = {madeBy<PieceId>(1, 1)};
  chosen.edge = EdgeNear{madeBy<PieceId>(1, 1), "hem", 0.5, 0};
  chosen.seam = madeBy<SeamId>(2, 1);
  TableFrameOptions options;
  options.corners = true;
  const TableFrame frame = table.frame(chosen, options), plain = table.frame();
  EXPECT_FALSE(frame.pieces[0].chosen);
  EXPECT_TRUE(frame.pieces[1].chosen);
  EXPECT_TRUE(edge(frame, "back", "hem").chosen);
  EXPECT_FALSE(edge(frame, "front", "hem").chosen);
  EXPECT_TRUE(frame.seams[1].chosen);
  EXPECT_FALSE(frame.seams[0].chosen);
  EXPECT_EQ(frame.pieces[0].corners.size(), 7u);
  EXPECT_TRUE(plain.pieces[0].corners.empty());
  EXPECT_FALSE(edge(plain, "back", "hem").chosen);
}

TEST(TableFrame, EveryStrokeLiesOnItsPiece) {
  int notches = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const TableFrame frame = Table(test::random(seed)).frame();
    constexpr double kMiss = 2.1e-4;  // metres: outlines are chords
    const auto inBox = [](const TablePiece& piece, Flat p) {
      return p.u > piece.low.u - kMiss && p.u < piece.high.u + kMiss && p.v > piece.low.v - kMiss &&
             p.v < piece.high.v + kMiss;
    };
    for (const TablePiece& piece : frame.pieces) {
      const Ring ring = ringOf(piece.edges);
      EXPECT_GT(signedArea(ring), 0);
      for (const Flat p : ring) EXPECT_TRUE(inBox(piece, p));
      for (const auto& line : piece.lines)
        for (const Flat p : line) EXPECT_TRUE(inBox(piece, p)) << seed;
      for (const TableNotch& notch : piece.notches) {
        double away = distanceToRing(ring, notch.stroke.from);
        for (const auto& hole : piece.holes) away = std::min(away, distanceToRing(ringOf(hole), notch.stroke.from));
        EXPECT_LT(away, kMiss) << "a notch begins on an edge";
        EXPECT_NEAR(distance(notch.stroke.from, notch.stroke.to), kNotchLength, kTiny);
        EXPECT_TRUE(inBox(piece, notch.stroke.from)) << seed;
        // At right angles to the one edge a notch in a corner may leave the cloth over the other.
        const bool inCorner = std::any_of(piece.edges.begin(), piece.edges.end(), [&](const TableEdge& edge) {
          return distance(edge.points.front(), notch.stroke.from) < 0.003;
        });
        notches += !inCorner;
        EXPECT_TRUE(inCorner || contains(ring, lerp(notch.stroke.from, notch.stroke.to, 0.5)))
            << "a notch goes into the cloth";
      }
      if (piece.grain) {
        EXPECT_TRUE(contains(ring, piece.grain->from) && contains(ring, piece.grain->to)) << seed;
      }
      for (const TableLabel& label : piece.labels) EXPECT_TRUE(inBox(piece, label.place)) << text(label.words);
    }
    for (const TableSeam& seam : frame.seams)
      for (const TableSeam::Side& side : seam.sides)
        for (const TableSeam::Run& run : side.runs) {
          ASSERT_EQ(run.points.size(), run.inward.size());
          for (std::size_t i = 1; i + 1 < run.points.size(); ++i)
            EXPECT_TRUE(std::any_of(frame.pieces.begin(), frame.pieces.end(), [&](const TablePiece& piece) {
              return contains(ringOf(piece.edges), run.points[i] + run.inward[i] * 0.001);
            })) << seam.name;
        }
  }
  EXPECT_GT(notches, 40);
}

// Places of the sheet (millimetres, y down) and of the table, back on the paper of the piece.
TEST(TableFrame, ShowsTheCutLinesOfThePrintedSheet) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Table table(test::random(seed));
    const TableFrame frame = table.frame();
    const auto sheet = layOut(table.pattern(), {});
    ASSERT_TRUE(sheet);
    for (std::size_t k = 0; k < frame.pieces.size(); ++k) {
      const SheetPiece& printed = sheet->pieces[k];
      const Flat lies = table.layout.at(printed.piece->id);
      ASSERT_EQ(frame.pieces[k].cut.size(), printed.cutLines.size());
      for (std::size_t i = 0; i < printed.cutLines.size(); ++i) {
        Ring onSheet;
        for (const Mm p : printed.cutLines[i]) onSheet.push_back({p.x, p.y});
        for (const Flat p : frame.pieces[k].cut[i]) {
          const Mm there = printed.at(p - lies);
          EXPECT_LT(distanceToRing(onSheet, {there.x, there.y}), 0.5) << seed;  // mm; chords of the table are longer
        }
      }
    }
  }
}

TEST(TableFrame, HasTheSameMarksAsThePrintedSheet) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const Table table(test::random(seed));
    const TableFrame frame = table.frame();
    SheetSettings settings;
    settings.allowance = 0;
    const auto sheet = layOut(table.pattern(), settings);
    ASSERT_TRUE(sheet);
    for (std::size_t k = 0; k < frame.pieces.size(); ++k) {
      const TablePiece& drawn = frame.pieces[k];
      const SheetPiece& printed = sheet->pieces[k];
      const Flat lies = table.layout.at(printed.piece->id);
      const auto same = [&](Flat onTable, Mm onSheet) {
        const Mm there = printed.at(onTable - lies);
        return std::hypot(there.x - onSheet.x, there.y - onSheet.y) < 1e-6;
      };
      ASSERT_EQ(drawn.notches.size(), printed.notches.size());
      for (std::size_t i = 0; i < drawn.notches.size(); ++i) {
        EXPECT_TRUE(same(drawn.notches[i].stroke.from, printed.notches[i].stroke.from)) << seed;
        EXPECT_TRUE(same(drawn.notches[i].stroke.to, printed.notches[i].stroke.to)) << seed;
        EXPECT_EQ(drawn.notches[i].own, printed.notches[i].seam.empty());
      }
      ASSERT_EQ(drawn.drills.size(), printed.drills.size());
      for (std::size_t i = 0; i < drawn.drills.size(); ++i) EXPECT_TRUE(same(drawn.drills[i], printed.drills[i]));
      ASSERT_EQ(drawn.grain.has_value(), printed.grain.has_value());
      if (drawn.grain) {
        EXPECT_TRUE(same(drawn.grain->from, printed.grain->from)) << seed;
        EXPECT_TRUE(same(drawn.grain->to, printed.grain->to)) << seed;
      }
      ASSERT_EQ(drawn.labels.size(), printed.texts.size());
      for (std::size_t i = 0; i < drawn.labels.size(); ++i) {
        EXPECT_EQ(text(drawn.labels[i].words), printed.texts[i].words);
        EXPECT_TRUE(same(drawn.labels[i].place, printed.texts[i].place)) << printed.texts[i].words;
        EXPECT_NEAR(drawn.labels[i].size * 1000, printed.texts[i].size, 1e-9);
        EXPECT_EQ(drawn.labels[i].upright, printed.texts[i].upright);
      }
    }
  }
}

// Piping in a sewn edge and a binding, on the table and on the sheet: as deep as they are, and seen beside a seam.
TEST(TableFrame, ShowsPipingsAndBindings) {
  Document document;
  document.pattern = skirt();
  const PieceId front = document.pattern.pieces.begin()->first;
  document.allowances.pipings[{front, "right"}] = {0.004, ""};
  document.allowances.bindings[{front, "hem"}] = {0.008, ""};
  SheetSettings settings;
  settings.allowances = document.allowances;
  const auto sheet = layOut(document.pattern, settings);
  ASSERT_TRUE(sheet);
  const SnapshotPtr garment = snapshotOf(document, nullptr);
  TableLayout layout;
  layout.arrange(*garment);
  const TableFrame frame = tableFrameOf(*garment, layout, {}, {});
  const TablePiece& drawn = frame.pieces[0];
  const SheetPiece& printed = sheet->pieces[0];
  ASSERT_EQ(drawn.trims.size(), 2u);
  ASSERT_EQ(printed.trims.size(), 2u);
  const TableTrim& piping = drawn.trims[0];
  for (std::size_t k = 0; k < piping.inside.size(); ++k) {
    EXPECT_NEAR(piping.edgewise[k].u - layout.at(front).u, 0.4, kTiny);
    EXPECT_NEAR(piping.inside[k].u - layout.at(front).u, 0.396, kTiny);
    EXPECT_NEAR(piping.line(0.02)[k].u - layout.at(front).u, 0.38, kTiny) << "seen from afar";
    EXPECT_EQ(piping.line(0.001)[k], piping.inside[k]);
    const Mm there = printed.at(piping.inside[k] - layout.at(front));
    EXPECT_NEAR(printed.trims[0][k].x, there.x, 1e-6);
    EXPECT_NEAR(printed.trims[0][k].y, there.y, 1e-6);
  }
  for (const Flat place : drawn.trims[1].inside) EXPECT_NEAR(place.v - layout.at(front).v, 0.008, kTiny);
  const auto svg = writeSvg(document.pattern, settings);
  ASSERT_TRUE(svg);
  EXPECT_NE(svg->find("class=\"trim\""), std::string::npos);
}

TEST(TableFrame, ADragShowsItsOutlineAndKeepsTheLettering) {
  const Table table(skirt());
  const PieceId front = madeBy<PieceId>(1, 0);
  TableFrameOptions options;
  const auto moved = moveCorner(*table.pattern().pieces.at(front), "right", {0.44, -0.02});
  ASSERT_TRUE(moved);
  options.outlines[front] = moved->outline;
  LetteringRooms rooms;
  const TableFrame before = table.frame({}, {}, &rooms), dragged = table.frame({}, options, &rooms);
  EXPECT_NEAR(dragged.pieces[0].high.u - before.pieces[0].high.u, 0.04, kTiny);
  ASSERT_TRUE(dragged.pieces[0].before);
  EXPECT_EQ(*dragged.pieces[0].before, ringOf(before.pieces[0].edges));
  EXPECT_FALSE(dragged.pieces[1].before);
  EXPECT_EQ(dragged.pieces[0].labels[0].place, before.pieces[0].labels[0].place);
  // The seam lies along the edge that is shown.
  const Flat lies = table.layout.at(front);
  EXPECT_LT(distance(dragged.seams[1].sides[0].runs[0].points.front(), Flat{0.44, -0.02} + lies), kTiny);
}

TEST(LetteringRooms, GiveWhatWouldBeFoundAnew) {
  LetteringRooms rooms;
  Pattern pattern = skirt();
  Piece piece = *pattern.pieces.begin()->second;
  const auto words = [&] {
    std::vector<std::string> all;
    for (const Message& line : labelOf(piece)) all.push_back(text(line, Language::English));
    return all;
  };
  const auto same = [](const LetteredPiece& a, const LetteredPiece& b) {
    return a.grain == b.grain && a.lines.size() == b.lines.size() && a.lines[0].place == b.lines[0].place &&
           a.lines[0].size == b.lines[0].size;
  };
  const auto anew = [&] {
    LetteringRooms fresh;
    return fresh.of(piece, words());
  };
  EXPECT_TRUE(same(rooms.of(piece, words()), anew()));
  const LetteredPiece first = rooms.of(piece, words());
  piece.name = "a name that is very much longer than the one before, and needs smaller letters";
  EXPECT_TRUE(same(rooms.of(piece, words()), anew()));
  EXPECT_FALSE(same(rooms.of(piece, words()), first));
  piece.name = "front";
  EXPECT_TRUE(same(rooms.of(piece, words()), first));
  piece.grain = {1, 0};
  EXPECT_TRUE(same(rooms.of(piece, words()), anew()));
  EXPECT_FALSE(same(rooms.of(piece, words()), first));
  piece.lines.push_back({"fold", {Curve::line({0.01, 0.2}, {0.39, 0.2})}, {}});
  EXPECT_TRUE(same(rooms.of(piece, words()), anew()));
}

TEST(TableFrame, WordsBesideAnEdgeLieOnTheirPiece) {
  Document document;
  Piece piece;
  piece.id = madeBy<PieceId>(1, 0);
  piece.name = "pocket";
  piece.outline.edges = {{"bottom", Curve::line({0, 0}, {0.03, 0})},
                         {"right", Curve::line({0.03, 0}, {0.03, 0.12})},
                         {"top", Curve::line({0.03, 0.12}, {0, 0.12})},
                         {"left", Curve::line({0, 0.12}, {0, 0})}};
  document.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  document.allowances.hems[{piece.id, "top"}] = {0.03, 0.005};
  const SnapshotPtr garment = snapshotOf(std::move(document), nullptr);
  TableLayout layout;
  layout.arrange(*garment);
  LetteringRooms rooms;
  for (LetteringRooms* kept : {static_cast<LetteringRooms*>(nullptr), &rooms, &rooms}) {
    const TableFrame frame = tableFrameOf(*garment, layout, {}, {}, kept);
    std::size_t notes = 0;
    for (const TableLabel& label : frame.pieces.at(0).labels) {
      if (label.says != TableLabel::Says::Note) continue;
      ++notes;
      const double half = wordsWidth(text(label.words), label.size) / 2;
      const Flat along = label.upright ? Flat{half, 0} : Flat{0, half};
      for (const Flat end : {label.place - along, label.place + along})
        EXPECT_TRUE(contains(ringOf(frame.pieces[0].edges), end)) << text(label.words);
    }
    EXPECT_EQ(notes, 1u);
  }
}

}  // namespace
}  // namespace karinui
