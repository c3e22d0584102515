#pragma once
// What a hand does with a stylus, operation by operation: where it begins, how it goes on, where it lets go. The same
// for a virtual clock and for the simulated service.
#include <algorithm>

#include "design/workroom.h"
#include "karinui/design/document.h"
#include "karinui/design/script.h"
#include "karinui/session/session.h"

namespace karinui {

// A stylus at work: go() to a place, press() or let go of the button.
struct StylusWork {
  std::string name;
  Command tool;
  std::vector<std::string> given;  // operations before it
  // Where the hand begins, a clear way from everything.
  std::function<Vec3(const Session&)> start;
  // `go` and `press` as the rig has them.
  std::function<void(const Session&, const std::function<void(Vec3)>& go, const std::function<void(bool)>& press)> work;
  std::string expected;  // the step's text, or how it begins
  // The hand goes to each place exactly, against the force, and so does what is expected to a tenth of a millimetre.
  bool exact() const { return tool != Command::Draw; }
};

inline SessionOptions cheapSession(std::shared_ptr<Bodies> bodies) {
  SessionOptions options;
  options.autoSettle = false;
  options.bodies = std::move(bodies);
  options.drape = [](const Document& d, const DrapePieces& op, Context&) { return fallABit(d, op.live); };
  options.pull = [](const Document& d, const PullCloth& op, Context&) {
    return fallABit(d, std::vector<PieceRef>{op.piece});
  };
  return options;
}

inline std::vector<std::string> twoPieces() {
  std::vector<std::string> lines;
  const auto script = parseScript(kTwoPieces);
  for (const ScriptLine& line : *script) lines.push_back(text(line.operation));
  return lines;
}

// A ring on the front of the mannequin, `deep` metres below its skin.
inline Vec3 onFront(const Session& session, double turn, double deep) {
  const Body& body = *session.snapshot().body;
  const Vec3 middle = at(body.mesh(), *body.find(*parseBodyPoint("torso:waist@0"))), seen{0, 0, 1};
  const Vec3 place = middle + Vec3{0.06 * std::cos(turn), 0.06 * std::sin(turn), 0.03};
  const auto near = body.bvh().nearest(place);
  return near->point - normalized(place - near->point) * deep * (dot(place - near->point, seen) > 0 ? 1 : -1);
}

inline std::vector<StylusWork> sixOperations() {
  const auto at = [](Vec3 place) { return [place](const Session&) { return place; }; };
  using Go = const std::function<void(Vec3)>&;
  using Press = const std::function<void(bool)>&;
  std::vector<StylusWork> all;
  all.push_back({"draw",
                 Command::Draw,
                 {"body size=jis9ar"},
                 [](const Session& session) { return onFront(session, 0, -0.02); },
                 [](const Session& session, Go go, Press press) {
                   go(onFront(session, 0, 0.002));
                   press(true);
                   for (int k = 1; k <= 48; ++k) go(onFront(session, 2 * std::numbers::pi * k / 48, 0.002));
                   press(false);
                   go(onFront(session, 0, -0.02));
                 },
                 "draw "});
  all.push_back({"move", Command::Move, twoPieces(), at({0.2, 0.25, 0.03}),
                 [](const Session&, Go go, Press press) {
                   go({0.2, 0.25, 0.004});
                   press(true);
                   go({0.23, 0.25, 0.204});
                   press(false);
                   go({0.23, 0.25, 0.23});
                 },
                 "move piece=p1 by=30mm,0,200mm"});
  all.push_back({"sew", Command::Sew, twoPieces(), at({0.42, 0.25, 0.02}),
                 [](const Session&, Go go, Press press) {
                   go({0.4, 0.25, 0.004});
                   press(true);
                   go({0.45, 0.25, 0});
                   go({0.3, 0.25, -0.15});
                   go({0.0, 0.25, -0.25});
                   go({0.0, 0.25, -0.296});
                   press(false);
                   go({0.0, 0.25, -0.25});
                 },
                 "sew a=p1.side_left b=p2.side_left"});
  all.push_back({"cut", Command::Cut, twoPieces(), at({-0.03, 0.2, 0.02}),
                 [](const Session&, Go go, Press press) {
                   go({-0.03, 0.2, 0.004});
                   press(true);
                   go({0.05, 0.2, 0.004});
                   go({0.1, 0.2, -0.002});
                   go({0.3, 0.2, -0.002});
                   go({0.35, 0.2, 0.004});
                   go({0.44, 0.2, 0.004});
                   press(false);
                   go({0.44, 0.2, 0.02});
                 },
                 "cut piece=p1 line="});
  all.push_back({"pull", Command::Pull, twoPieces(), at({0.2, 0.2, 0.03}),
                 [](const Session&, Go go, Press press) {
                   go({0.2, 0.2, 0.004});
                   press(true);
                   go({0.2, 0.2, 0.014});
                   press(false);
                   go({0.2, 0.2, 0.04});
                 },
                 "pull piece=p1 at=200mm,200mm by=0,0,10mm"});
  all.push_back({"reshape", Command::Reshape, twoPieces(), at({0.2, 0.44, 0.03}),
                 [](const Session&, Go go, Press press) {
                   go({0.2, 0.44, 0.004});
                   press(true);
                   go({0.2, 0.42, 0.019});
                   press(false);
                   go({0.2, 0.42, 0.04});
                 },
                 "reshape piece=p1 at=200mm,440mm by=0,-20mm,15mm"});
  return all;
}

inline void give(Session& session, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const auto operation = parseOperation(line);
    if (operation) session.perform(*operation);
    session.finish();
  }
}

// The hash of the document that the session's steps make by script, in a file of its own.
inline std::string hashByScript(const Session& session) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  for (const Step& step : session.steps()) {
    const auto operation = parseOperation(text(step.operation));
    if (!operation || !file.perform(*operation, room.context)) return "refused: " + text(step.operation);
  }
  return hash(file.document());
}

}  // namespace karinui
