// Truing, and the paper that leaves a document, by the command.
#include "command.h"

namespace karinui::test {
namespace {

// Two panels whose sides differ by a centimetre and a half.
std::string panels(const Folder& folder) {
  const std::string document = folder / "skirt.karinui";
  write(folder / "skirt.ops",
        "piece name=front outline=\"M 0 0; hem L 300 0; side L 300 400; waist L 0 400; fold L 0 0\"\n"
        "piece name=back pose=\"0.5,0,0\" outline=\"M 0 0; hem L 300 0; fold L 300 415; waist L 0 415; side L 0 0\"\n"
        "sew a=front.side b=back.side name=side\n");
  EXPECT_EQ(karinui("play " + (folder / "skirt.ops") + " -o " + document).exit, 0);
  return document;
}

TEST(Truing, TellsWhatDoesNotFit) {
  const Folder folder;
  const std::string document = panels(folder);
  const Said words = karinui("truing " + document), japanese = karinui("truing " + document, "ja_JP.UTF-8");
  EXPECT_EQ(words.exit, 0);
  EXPECT_NE(words.out.find("15.0 mm longer"), std::string::npos) << words.out;
  EXPECT_NE(japanese.out.find("15.0 mm 長く"), std::string::npos) << japanese.out;
  const auto found = karinui("truing " + document + " --json").json();
  EXPECT_EQ(found["faults"], 1);
  EXPECT_NEAR(found["seams"][0]["off_m"].get<double>(), 0.015, 1e-9);
  EXPECT_EQ(found["corners"].size(), 2u);
  EXPECT_EQ(karinui("do " + document + " 'ease seam=side by=15mm'").exit, 0);
  EXPECT_EQ(karinui("truing " + document + " --json").json()["faults"], 0);
}

TEST(Paper, IsAskedForByItsName) {
  const Folder folder;
  const std::string document = panels(folder);
  for (const auto& [paper, width] :
       {std::pair<std::string, std::string>{"letter", "612 792"}, {"a0", "2383"}, {"36in", "2592 3456"}}) {
    const std::string file = folder / (paper + ".pdf");
    ASSERT_EQ(karinui("export " + document + " -o " + file + " --paper " + paper + " --date 2026-01-31").exit, 0);
    EXPECT_NE(contents(file).find("/MediaBox [ 0 0 " + width), std::string::npos) << paper;
  }
  EXPECT_NE(karinui("export " + document + " -o " + (folder / "a.pdf") + " --overlap 2").exit, 0);
  // The document's own allowances, or the width of seams that is asked for.
  const auto widths = [&](const std::string& more) {
    const std::string file = folder / "skirt.svg";
    EXPECT_EQ(karinui("export " + document + " -o " + file + " " + more).exit, 0);
    std::string all;
    const std::string svg = contents(file);
    for (std::size_t at = 0; (at = svg.find("data-allowance=\"", at)) != std::string::npos;)
      at += 16, all += svg.substr(at, svg.find('"', at) - at) + " ";
    return all;
  };
  EXPECT_EQ(widths(""), "30 10 10 0 30 0 10 10 ");
  EXPECT_EQ(karinui("do " + document + " 'allowance edges=front.hem width=4cm' 'allowance kind=seam width=12mm'").exit,
            0);
  EXPECT_EQ(widths(""), "40 12 12 0 30 0 12 12 ");
  EXPECT_EQ(widths("--allowance 8"), "40 8 8 0 30 0 8 8 ");
  EXPECT_EQ(widths("--allowance 0"), "");
}

// Four legs of trousers are two pairs.
TEST(Paper, LeftAndRightAlikeAreDrawnOnce) {
  const Folder folder;
  const std::string document = folder / "trousers.karinui";
  write(folder / "trousers.ops", "body size=eu38\nblock kind=trousers\n");
  ASSERT_EQ(karinui("play " + (folder / "trousers.ops") + " -o " + document).exit, 0);
  const auto pages = [&](const std::string& more) {
    const std::string file = folder / "trousers.pdf";
    EXPECT_EQ(karinui("export " + document + " -o " + file + " --paper a4 " + more).exit, 0);
    const std::string pdf = contents(file);
    std::size_t count = 0;
    for (std::size_t at = 0; (at = pdf.find("/MediaBox", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  const std::size_t all = pages(""), once = pages("--pairs-once");
  EXPECT_GT(once, 5u);
  EXPECT_LT(static_cast<double>(once), 0.6 * static_cast<double>(all));
}

}  // namespace
}  // namespace karinui::test
