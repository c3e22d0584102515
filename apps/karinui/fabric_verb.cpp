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

  WordTable table;
  table.row({"", console.said(say("Measured")), console.said(say("Two standard errors")),
             console.said(say("{0}, the nearest of the shop", nameSaid(measured->like)))});
  Json numbers = Json::array();
  for (const MeasuredRow& row : rowsOf(*measured)) {
    const bool bias = !row.number;
    table.row({console.said(row.label), row.valueText(),
               row.error ? row.errorText() : console.said(say("in proportion")),
               bias ? console.said(say("{0} by warp and weft", row.likeText())) : row.likeText()});
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
  const std::string words = table.words(2) + console.said(say("As a step:")) + "\n  " + operation;
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
      *fabric, "measure", help("A fabric from a swatch on scales, a strip over a table's edge, a weight on a strip"),
      asked, runMeasure);
  verb->add_option("--name", asked->name, help("What it is to be called"));
  verb->add_option("--swatch", asked->swatch, help("Length and width of the swatch, mm: 100x100"))->required();
  verb->add_option("--mass", asked->masses, help("Its mass, g; readings after commas"))->delimiter(',')->required();
  const std::array words{help("along the warp"), help("along the weft"), help("at 45 degrees to both")};
  for (std::size_t g = 0; g < kGrains; ++g) {
    const std::string grain = kGrainNames[g];
    verb->add_option(
            "--overhang-" + grain, asked->overhangs[g],
            help(say("Strip {0}: how far it hangs over the edge, mm, where its tip is 41.5 degrees below", words[g])))
        ->delimiter(',');
    verb->add_option("--angle-" + grain, asked->angles[g], help("or at these degrees instead, 5 to 80"))
        ->delimiter(',');
  }
  verb->add_option("--drape", asked->drapes,
                   help("Drape coefficient of a disc of 30 cm on a support of 18 cm, percent; in place of strips"))
      ->delimiter(',');
  verb->add_option("--disc-flat", asked->flat, help("or its photograph from above, flat at the support's height,"));
  verb->add_option("--disc-draped", asked->drapedBy, help("and draped, by the same camera; several times"))
      ->delimiter(',');
  verb->add_option("--strip", asked->strip,
                   help("Stretch: length between the marks and width of the strip, mm: 200x25"));
  for (std::size_t g = 0; g < kGrains; ++g)
    verb->add_option(
        std::string("--hang-") + kGrainNames[g], asked->hung[g],
        help(say("Strip {0}: a weight in g and the length under it in mm, 500:203.1,203.4; several times", words[g])));
  verb->add_option("--thickness", asked->thicknesses, help("Thickness, mm"))->delimiter(',');
  verb->add_option("--ruler", asked->ruler, help("The ruler is good to so many mm either way (0.5)"));
  verb->add_option("--scales", asked->scales, help("The scales are good to so many g either way (1)"));
  verb->add_option("--angle-error", asked->angle, help("The angle is good to so many degrees either way (1)"));
  verb->add_option("--like", asked->like, help("The fabric that gives what was not measured; else the nearest"));
  verb->add_option("--into", asked->into, help("A .karinui document that gets the fabric"));
}

}  // namespace karinui::app
