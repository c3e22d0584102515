#include "fabric_verb.h"

#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/design/glossary.h"
#include "karinui/design/script.h"
#include "karinui/exchange/read_print.h"
#include "karinui/session/fabric_numbers.h"
#include "karinui/session/silhouette.h"
#include "open_document.h"
#include "word_table.h"

namespace karinui::app {

namespace {

constexpr std::array<const char*, kGrains> kGrainNames{"warp", "weft", "bias"};
constexpr double kDoubtful = 0.1;  // a weight whose standard error is more of it is told of

struct MeasureOptions {
  std::string name = "my_fabric", like, swatch, strip, into;
  std::vector<double> masses, thicknesses, drapes;
  std::string flat;  // photographs of a disc
  std::vector<std::string> drapedBy;
  std::array<std::vector<double>, kGrains> overhangs, angles;
  std::array<std::vector<std::string>, kGrains> hung;
  double ruler = 0.5, scales = 1, angle = 1;  // good to so many mm, g, degrees either way
};

std::vector<double> scaled(std::vector<double> values, double by) {
  for (double& value : values) value *= by;
  return values;
}

// "100x25" as metres.
Result<std::array<double, 2>> sides(const std::string& text, const char* option) {
  const std::size_t cross = text.find('x');
  const auto a = parseNumber(text.substr(0, cross)),
             b = cross == std::string::npos ? std::nullopt : parseNumber(text.substr(cross + 1));
  if (!a || !b)
    return badInput(say("{0}: “{1}” is no length by width; write millimetres, like 100x100.", option, text));
  return std::array{*a / 1000, *b / 1000};
}

// "500:203.1,203.4": grams, and millimetres under them.
Result<HungWeight> hungWeight(const std::string& text) {
  HungWeight hung;
  const std::size_t colon = text.find(':');
  const auto grams = parseNumber(text.substr(0, colon));
  bool good = grams && colon != std::string::npos;
  for (std::size_t from = colon + 1; good && from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const auto length = parseNumber(text.substr(from, comma - from));
    good = length.has_value();
    if (good) hung.lengths.push_back(*length / 1000);
    from = comma + 1;
  }
  if (!good)
    return badInput(
        say("“{0}” is no weight and lengths under it; write grams and millimetres, like 500:203.1,203.4.", text));
  hung.mass = *grams / 1000;
  return hung;
}

Result<TableReadings> readingsOf(const MeasureOptions& asked) {
  TableReadings t;
  t.ruler = uncertaintyOf(asked.ruler / 1000), t.scales = uncertaintyOf(asked.scales / 1000);
  t.angle = uncertaintyOf(asked.angle * kDegree);
  const auto swatch = sides(asked.swatch, "--swatch");
  if (!swatch) return swatch.error();
  t.swatchLength = (*swatch)[0], t.swatchWidth = (*swatch)[1];
  t.swatchMasses = scaled(asked.masses, 0.001), t.thicknesses = scaled(asked.thicknesses, 0.001);
  if (!asked.strip.empty()) {
    const auto strip = sides(asked.strip, "--strip");
    if (!strip) return strip.error();
    t.stripLength = (*strip)[0], t.stripWidth = (*strip)[1];
  }
  for (std::size_t g = 0; g < kGrains; ++g) {
    t.overhang[g] = {scaled(asked.overhangs[g], 0.001), scaled(asked.angles[g], kDegree)};
    for (const std::string& text : asked.hung[g]) {
      auto hung = hungWeight(text);
      if (!hung) return hung.error();
      t.hung[g].push_back(*std::move(hung));
    }
  }
  t.like = asked.like;
  return t;
}

// From photographs of the disc, one flat and one or more draped.
Result<std::vector<double>> drapesOf(const MeasureOptions& asked, const Token& token) {
  std::vector<double> all = scaled(asked.drapes, 0.01);
  if (asked.flat.empty() != asked.drapedBy.empty())
    return badInput(say("A disc is photographed twice: flat (--disc-flat) and draped (--disc-draped)."));
  if (asked.flat.empty()) return all;
  const auto flat = readPrint(asked.flat, token);
  const auto whole = flat ? coveredShare(*flat) : Result<double>(flat.error());
  if (!whole) return inFile(asked.flat, whole.error());
  for (const std::string& photograph : asked.drapedBy) {
    const auto draped = readPrint(photograph, token);
    const auto drape = draped ? drapeOfPhotographs(*flat, *draped) : Result<double>(draped.error());
    if (!drape) return inFile(photograph, drape.error());
    all.push_back(*drape);
  }
  return all;
}

int runMeasure(Program& program, const MeasureOptions& asked) {
  Console& console = program.console;
  auto readings = readingsOf(asked);
  if (!readings) return console.refuse(readings.error());
  auto drapes = drapesOf(asked, console.token());
  if (!drapes) return console.refuse(drapes.error());
  readings->drapes = *std::move(drapes);
  const auto measured = measuredFabric(*readings);
  if (!measured) return console.refuse(measured.error());
  const SetFabric step = fabricStep(*measured, asked.name);
  const std::string operation = text(Operation(step));

  const Uncertain weight = measured->numbers.front().value;
  if (weight.error > kDoubtful * weight.value)
    console.note(
        say("The weight is sure to ± {0} % only, and all else is counted from it: weigh a larger piece, or say how "
            "exact the scales are (--scales 0.1).",
            fixed(200 * weight.error / weight.value, 0)));
  WordTable table;
  table.row(
      {"", console.said(say("Measured")), console.said(say("Error (95 %)")), console.said(nameSaid(measured->like))});
  Json numbers = Json::array();
  for (const MeasuredRow& row : rowsOf(*measured)) {
    const bool bias = !row.number;
    table.row({console.said(row.label), row.valueText(),
               row.error ? row.errorText() : console.said(say("not measured, in proportion")),
               bias ? console.said(say("{0} from warp and weft", row.likeText())) : row.likeText()});
    Json one = {{"what", bias ? "bending, bias" : text(row.label)}, {"value", row.value}};
    if (row.error) one["error"] = *row.error;
    one[bias ? "by_warp_and_weft" : "like"] = row.like;
    numbers.push_back(std::move(one));
  }
  if (!readings->drapes.empty()) {
    const Uncertain drape = meanOf(readings->drapes, 0);
    table.row({console.said(say("Drape of the disc")), fixed(100 * drape.value, 1) + " %",
               readings->drapes.size() > 1 ? "± " + fixed(200 * drape.error, 1) + " %" : "", ""});
  }
  Json object = {{"like", measured->like}, {"measured", std::move(numbers)}, {"operation", operation}};
  if (!readings->drapes.empty()) object["drapes"] = readings->drapes;
  const Message others =
      asked.like.empty()
          ? say("The nearest fabric of the shop is {0}; what was not measured is as there.", nameSaid(measured->like))
          : say("What was not measured is as in {0}.", nameSaid(measured->like));
  const Message how = asked.into.empty() ? say("The operation that makes it:") : say("Added to {0}:", asked.into);
  const std::string words = table.words(2) + console.said(others) + "\n" + console.said(how) + "\n  " + operation;
  if (asked.into.empty()) {
    console.answer(object, words);
    return kDone;
  }
  return withDocument(program, asked.into, false, [&](OpenDocument& opened) -> int {
    if (const Result<Step> done = opened.perform(step); !done) return console.refuse(done.error());
    object["document"] = asked.into;
    console.answer(object, words);
    return kDone;
  });
}

}  // namespace

void addFabricVerb(Program& program) {
  CLI::App* fabric = Program::word(program.cli, "fabric", help("Fabrics from measurements"));
  fabric->require_subcommand(1);
  auto asked = std::make_shared<MeasureOptions>();
  CLI::App* verb = program.verb(
      *fabric, "measure", help("Finds the numbers of a cloth with scales, a ruler and a table"), asked, runMeasure);
  verb->add_option("--name", asked->name, help("The fabric's name"));
  verb->add_option("--swatch", asked->swatch, help("Length and width of the piece that is weighed, mm: 100x100"))
      ->required();
  verb->add_option("--mass", asked->masses, help("What it weighs, g; weighed several times: 1.52,1.54"))
      ->delimiter(',')
      ->required();
  const std::array words{help("along the warp"), help("along the weft"), help("at 45 degrees to both")};
  for (std::size_t g = 0; g < kGrains; ++g) {
    const std::string grain = kGrainNames[g];
    verb->add_option(
            "--overhang-" + grain, asked->overhangs[g],
            help(say(
                "Strip cut {0}: how much of it hangs over the table's edge, mm, when the line from the edge to its tip "
                "falls by 41.5 degrees",
                words[g])))
        ->delimiter(',');
    verb->add_option("--angle-" + grain, asked->angles[g],
                     help("where the line falls otherwise: by so many degrees, 5 to 80"))
        ->delimiter(',');
  }
  verb->add_option(
          "--drape", asked->drapes,
          help("Instead of strips over the edge: drape coefficient of a disc of 30 cm on a stand of 18 cm, percent"))
      ->delimiter(',');
  verb->add_option("--disc-flat", asked->flat,
                   help("Instead of --drape: a photograph from above of the disc, lying flat at the stand's height"));
  verb->add_option("--disc-draped", asked->drapedBy,
                   help("and photographs of it hanging over the stand, by the same camera from the same place"))
      ->delimiter(',');
  verb->add_option("--strip", asked->strip,
                   help("For stretch: two marks on a strip are so far apart, and it is so wide, mm: 200x25"));
  for (std::size_t g = 0; g < kGrains; ++g)
    verb->add_option(std::string("--hang-") + kGrainNames[g], asked->hung[g],
                     help(say("Strip cut {0}: a weight hung on it, g, and how far apart the marks are then, mm: "
                              "500:203.1,203.4; once for "
                              "each weight",
                              words[g])));
  verb->add_option("--thickness", asked->thicknesses, help("How thick the cloth is, mm"))->delimiter(',');
  verb->add_option("--ruler", asked->ruler, help("The ruler may be wrong by so many mm (0.5)"));
  verb->add_option("--scales", asked->scales, help("The scales may be wrong by so many g (1)"));
  verb->add_option("--angle-error", asked->angle, help("The angle may be wrong by so many degrees (1)"));
  verb->add_option("--like", asked->like,
                   help("The fabric from which comes what was not measured; otherwise the nearest"));
  verb->add_option("--into", asked->into, help("A .karinui document to which the fabric is added"));
}

}  // namespace karinui::app
