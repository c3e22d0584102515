#pragma once
// What a DXF file of the cutting trade says (AAMA, and ASTM D 6673): pieces by size, as lines and points on numbered
// layers. Metres on paper. The file's habits are sorted out here and in dxf_shapes.h; curves are made of the points in
// cad_outline.h.
#include <optional>
#include <string>
#include <vector>

#include "dxf_file.h"

namespace karinui {

struct CadLine {
  std::vector<Flat> points;
  bool closed = false;
};

struct CadNotch {
  Flat place;                  // on the boundary
  std::optional<Flat> inward;  // unit; into the piece
};

struct CadPiece {
  std::string block;  // that it is drawn in, by its name
  std::string name, size, category, annotation, fabric;
  bool sizeTold = false;                             // by a text; else the block's name ends in it, perhaps
  int quantity = 0;                                  // how often it is cut; 0: not told
  bool pairs = false;                                // told as right and left ones
  std::vector<Message> notes;                        // what was guessed
  std::vector<CadLine> boundary;                     // layer 1: points *on* the boundary, sparse where it is curved
  std::vector<CadLine> dense;                        // layer 84 (ASTM): the boundary with more points
  std::vector<CadLine> sewing;                       // layer 14: the seam line, where layer 1 is the cut line
  std::vector<CadLine> cutouts, inside;              // layers 11 and 8
  std::vector<Flat> turns, curved;                   // layers 2 and 3: which points are corners, which lie on a curve
  std::vector<CadNotch> notches;                     // layers 4 and 80 to 83
  std::vector<Flat> drills;                          // layer 13
  std::vector<std::pair<Flat, std::size_t>> rules;   // "# 5": the point there goes by grade rule 5
  std::optional<std::pair<Flat, Flat>> grain, fold;  // layers 7 and 6
};

struct CadStyle {
  std::string name, sampleSize, author;
  double unit = 0;                 // metres
  bool unitsTold = true;           // else the unit was guessed from how large the pieces are
  bool lettersGuessed = false;     // the code page of its words was
  std::vector<Message> notes;      // what was left out
  std::vector<std::string> sizes;  // in the file's order
  std::vector<CadPiece> pieces;    // one for each piece and size, in the file's order
};

// Refuses a file without a piece. `unit`: metres of a unit, whatever the file tells; 0: as it tells.
Result<CadStyle> cadStyle(const DxfFile& file, double unit = 0);

}  // namespace karinui
