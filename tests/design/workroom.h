#pragma once
// A workroom for tests of the design: a context whose solver is cheap, and a body that is quickly built.
#include <cmath>
#include <numbers>

#include "karinui/design/history.h"
#include "karinui/design/script.h"
#include "soak.h"

namespace karinui {

inline Operation op(const std::string& line) { return *parseOperation(line); }

// The document that a list of operations leads to, from nothing.
inline Result<Document> replayed(const std::vector<Operation>& operations, Context& context) {
  Document document;
  for (const Operation& operation : operations) {
    auto next = apply(document, operation, context);
    if (!next) return next.error();
    document = *std::move(next);
  }
  return document;
}

// Everything falls by a centimetre and is at rest: enough to see that forms, poses and dirt are handled.
inline Result<DrapeOutcome> fallABit(const Document& document, const std::vector<PieceRef>& live) {
  DrapeOutcome outcome;
  for (const PieceRef& ref : live) {
    const Piece& piece = *document.find(ref.id);
    const Stand stand(piece);
    auto form = std::make_shared<Form>();
    const Ring ring = piece.outline.flattened(0.001);
    for (const Flat place : ring) {
      form->flat.push_back(place);
      form->space.push_back(stand(place) + Vec3{0, -0.01, 0});
    }
    auto faces = triangulate(ring, {}, {});
    if (!faces) return faces.error();
    form->faces = *std::move(faces);
    outcome.forms[ref.id] = std::move(form);
  }
  outcome.report.settled = true;
  return outcome;
}

// A figure without landmarks: an ellipsoid 1.6 m high.
inline Body::Parts egg() {
  Body::Parts parts;
  parts.name = "egg";
  constexpr std::uint32_t kRings = 24, kAround = 32;
  parts.mesh.points.push_back({0, 0, 0});
  for (std::uint32_t i = 1; i < kRings; ++i) {
    const double a = std::numbers::pi * i / kRings;
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double b = 2 * std::numbers::pi * k / kAround;
      parts.mesh.points.push_back(
          {0.15 * std::sin(a) * std::sin(b), 0.8 - 0.8 * std::cos(a), 0.12 * std::sin(a) * std::cos(b)});
    }
  }
  parts.mesh.points.push_back({0, 1.6, 0});
  const auto at = [](std::uint32_t i, std::uint32_t k) { return 1 + (i - 1) * kAround + k % kAround; };
  const auto top = static_cast<std::uint32_t>(parts.mesh.points.size() - 1);
  for (std::uint32_t k = 0; k < kAround; ++k) {
    parts.mesh.faces.push_back({0, at(1, k + 1), at(1, k)});
    parts.mesh.faces.push_back({top, at(kRings - 1, k), at(kRings - 1, k + 1)});
    for (std::uint32_t i = 1; i + 1 < kRings; ++i) {
      parts.mesh.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      parts.mesh.faces.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  return parts;
}

struct Workroom {
  Workers workers{1};
  Token token;
  MemoryBlobs blobs;
  Bodies bodies;
  Context context{workers,
                  token,
                  blobs,
                  bodies,
                  [](const Document& d, const DrapePieces& op, Context&) { return fallABit(d, op.live); },
                  [](const Document& d, const PullCloth& op, Context&) { return fallABit(d, op.live); }};

  // Plays a script into a file; nothing is expected to be refused.
  Done play(DocumentFile& file, const std::string& script) {
    auto lines = parseScript(script);
    if (!lines) return lines.error();
    for (const ScriptLine& line : *lines) {
      if (auto step = file.perform(line.operation, context); !step) return step.error();
    }
    return {};
  }
};

inline const char* const kTwoPieces =
    "piece name=front outline=\"M 0 0; hem L 400 0; side_left L 400 500; neck C 300 450 100 450 0 500; side_right L 0 "
    "0\"\n"
    "piece name=back outline=\"M 0 0; hem L 400 0; side_right L 400 500; neck L 0 500; side_left L 0 0\" "
    "pose=\"0,0,-0.3 y 180deg\"\n";

}  // namespace karinui
