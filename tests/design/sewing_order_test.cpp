#include "karinui/design/sewing_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "design/workroom.h"

namespace karinui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SewingOrder : public testing::Test {
 protected:
  static Workroom& room() {
    static Workroom shared;  // the figure is built once
    return shared;
  }
  static Document played(const std::string& script) {
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room().play(file, script);
    EXPECT_TRUE(done) << text(done.error().what);
    return file.document();
  }
  static std::vector<std::string> said(const Document& document) {
    std::vector<std::string> lines;
    for (const SewingStep& step : sewingOrder(document)) lines.push_back(text(step.words));
    return lines;
  }
};

TEST_F(SewingOrder, IsAShirtMakers) {
  const Document shirt = played("body size=eu38\nblock kind=shirt\n");
  EXPECT_THAT(said(shirt),
              ElementsAre("Seam 2: left shoulder", "Seam 5: right shoulder", HasSubstr("Seam 4: left armhole, "),
                          HasSubstr("Seam 7: right armhole, "), "Seam 8: left underarm", "Seam 9: right underarm",
                          "Seam 3: left side", "Seam 6: right side", HasSubstr("opening"),
                          HasSubstr("left end of collar"), HasSubstr("collar"), HasSubstr("Turn up the hems of")));
}

TEST_F(SewingOrder, TellsWhatIsDoneWithinAPieceFirst) {
  const Document skirt = played(
      "piece name=front outline=\"M -200 0; hem L 200 0; side_left L 200 500; waist L -200 500; side_right L -200 0\"\n"
      "piece name=back outline=\"M -200 0; hem L 200 0; side_right L 200 500; waist L -200 500; side_left L -200 0\"\n"
      "piece name=band outline=\"M 0 0; low L 700 0; end_left L 700 40; top L 0 40; end_right L 0 0\"\n"
      "interface piece=band\n"
      "sew a=front.side_left b=back.side_left\n"
      "fasten name=zip kind=zip a=front.side_right b=back.side_right\n"
      "dart edge=front.waist at=0.25 tip=10cm,40cm width=2cm\n"
      "double_dart piece=back from=10cm,40cm to=10cm,10cm\n"
      "sew a=band.low b=\"front.waist front.waist_2 front.waist_3 back.waist\"\n");
  EXPECT_THAT(said(skirt), ElementsAre("Fuse interfacing to band.", HasSubstr("Sew the darts: seams "),
                                       "Seam 1: left side of front – left side of back", "Set in the zip: zip.",
                                       HasSubstr("Seam 6: lower edge of band – front, waist of back, 60 mm eased in"),
                                       "Turn up the hems of front, back."));
  EXPECT_THAT(sewingOrder(Document()), IsEmpty());
}

// Each seam comes once, and what a run goes over is sewn before it.
TEST_F(SewingOrder, LeadsNoSeamOverAnOpenPlace) {
  for (const char* name :
       {"tailored_shirt", "trousers", "pleated_skirt", "lined_waistcoat", "hooded_coat", "gathered_dress"}) {
    SCOPED_TRACE(name);
    std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/examples/" + name + ".ops");
    std::stringstream script;
    for (std::string line; std::getline(file, line);)
      if (!line.starts_with("drape")) script << line << '\n';
    const Document document = played(script.str());
    std::map<std::size_t, std::size_t> place;  // of a seam's number, in the order
    const auto steps = sewingOrder(document);
    for (std::size_t k = 0; k < steps.size(); ++k)
      for (const std::size_t number : steps[k].seams) EXPECT_TRUE(place.emplace(number, k).second);
    const auto corner = [&](const EdgeSpan& span, bool last) {
      return findCurve(*document.find(span.piece), span.edge)->atFraction(last ? span.to : span.from);
    };
    std::size_t number = 0;
    for (const auto& [id, seam] : document.pattern.seams) {
      ++number;
      if (!place.contains(number)) continue;  // a pleat, which is laid
      for (const auto* side : {&seam.a, &seam.b})
        for (std::size_t k = 1; k < side->size(); ++k) {
          const EdgeSpan &from = (*side)[k - 1], &to = (*side)[k];
          if (from.piece == to.piece) continue;
          // A seam of these two pieces ends at the corner of each.
          std::size_t other = 0, sewn = 0;
          for (const auto& [its, over] : document.pattern.seams) {
            ++other;
            bool at = false, there = false;
            for (const auto* part : {&over.a, &over.b})
              for (const EdgeSpan& span : *part)
                for (const bool end : {false, true}) {
                  at = at || (span.piece == from.piece && distance(corner(span, end), corner(from, true)) < 1e-4);
                  there = there || (span.piece == to.piece && distance(corner(span, end), corner(to, false)) < 1e-4);
                }
            if (at && there && its != id && place.contains(other) && place.at(other) < place.at(number)) ++sewn;
          }
          EXPECT_GT(sewn, 0u) << "seam " << number << " runs over an open place";
        }
    }
  }
}

}  // namespace
}  // namespace karinui
