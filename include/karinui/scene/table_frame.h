#pragma once
// The flat pattern on the cutting table as plain data: what the pattern window, a headset and the command draw. Made by
// tableFrameOf() in session. Owns everything; no ids of the document, no pointers; any thread may read. Places in
// metres on the table, v up; curves are points no further than 0.2 mm from them; colours linear RGB.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/geometry/polygon.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

struct TableStroke {
  Flat from, to;
};

struct TableEdge {
  enum class State { Open, PartlySewn, Sewn };
  std::string name;
  std::vector<Flat> points;  // in the edge's own direction, its two ends included
  double length = 0;         // metres, of the exact curve
  State state = State::Open;
  std::optional<std::size_t> seam;  // of TableFrame::seams: the first that holds it
  bool dart = false;                // a dart's leg: it is sewn to the edge it meets at the dart's point
  bool chosen = false;
};
Ring ringOf(const std::vector<TableEdge>& edges);

struct TableNotch {
  TableStroke stroke;  // from the edge inwards
  bool own = false;    // put there by the person; else a place where the two sides of a seam meet
};

struct TableLabel {
  enum class Says { Name, Cut, SeamNumber, Note };
  Says says = Says::Name;
  Message words;
  Flat place;           // the middle of the lettering
  double size = 0.004;  // metres, of the font, as it is printed
  bool upright = true;  // else turned to read from below upwards
};

inline constexpr double kTrimPixels = 7;  // from an edge to its trim's line, so that a seam's line is seen between

struct TableTrim {  // a piping or a binding: places on the edge, and beside each how far it reaches into the cloth
  std::vector<Flat> edgewise, inside;
  std::vector<Flat> line(double least) const;  // its inner side, at least so far from the edge that it is seen there
};

struct TableSize {  // the outline in another size, drawn over the one that stands
  std::string name;
  Ring outline;
  Colour colour;
};

struct TablePiece {
  std::string name;
  Colour colour{0.5f, 0.5f, 0.5f};  // of its fabric
  ClothLook look = {};              // its print
  Flat lies;                        // where the paper's origin lies: prints begin there
  bool chosen = false, frozen = false;
  bool unsettled = false;                     // a drape has yet to bring it to rest
  std::vector<TableEdge> edges;               // the outline, counter-clockwise
  std::vector<std::vector<TableEdge>> holes;  // counter-clockwise too
  Flat low, high;                             // the outline's box
  std::vector<Ring> cut;                      // the lines it is cut along, where there is a seam allowance
  std::optional<Ring> before;                 // the outline of the document, where a drag shows another one
  std::vector<TableSize> nest;                // all other sizes, where they are shown
  std::vector<std::vector<Flat>> lines;       // internal lines
  std::vector<std::vector<Flat>> stitches;    // rows of topstitching
  std::vector<TableTrim> trims;
  std::vector<TableNotch> notches;
  std::vector<Flat> drills;
  double drillRadius = 0.0025;
  std::optional<TableStroke> grain;  // both ends bear an arrow head; nothing where there is no room for it
  std::vector<TableLabel> labels;
  std::vector<Flat> pins;
  std::vector<Flat> corners;  // while a tool moves them: where edges meet
};

struct TableSeam {
  struct Run {  // along one edge
    std::vector<Flat> points;
    std::vector<Flat> inward;  // at each point, a unit step into the cloth
  };
  struct Tick {  // two on each side, nearer to the end where the seam begins: which end meets which
    Flat place, inward;
  };
  struct Side {
    std::vector<Run> runs;
    std::vector<Tick> ticks;
  };
  std::string name;
  Colour colour{0.5f, 0.5f, 0.5f};  // one hue for both sides
  bool chosen = false;
  std::array<Side, 2> sides;
};

// A scan that is traced; it lies under all else.
struct TableScan {
  std::shared_ptr<const PrintImage> image;
  Flat at;           // where its middle lies
  double width = 1;  // metres
  double turn = 0;   // radians, counter-clockwise
  double strength = 0.5;
  double height() const { return width * image->height / image->width; }
  std::array<Flat, 4> corners() const;  // lower left, lower right, upper right, upper left
};

struct TableFrame {
  std::vector<TableScan> scans;    // the later ones above
  std::vector<TablePiece> pieces;  // in the order of the document's, the later ones above
  std::vector<TableSeam> seams;    // seam n is printed with the number n + 1
};

FlatBox extent(const TableFrame& frame);  // empty: there is neither piece nor scan

}  // namespace karinui
