// Measurement files written, and the formats by their endings.
#include <numbers>

#include "exchange/code_pages.h"
#include "exchange/measure_names.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/exchange/formats.h"
#include "karinui/exchange/measurement_files.h"

namespace karinui {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// To a micron, without the digits that changing units adds.
std::string number(double value) { return shortest(*parseNumber(fixed(value, 4))); }

std::string inCentimetres(std::string_view key, double value) {
  return number(isAngle(key) ? value * kDegrees : value * 100);
}

std::string lines(const Measurements& measures) {
  std::string all;
  for (const auto& [key, value] : measures.value)
    if (const std::string_view name = measureNameIn(&MeasureNames::valentina, key); !name.empty())
      all += "    <m name=\"" + std::string(name) + "\" value=\"" + inCentimetres(key, value) + "\"/>\n";
  return all;
}

// Valentina and Seamly2D know no children.
std::string gender(const Measurements& measures) {
  return std::string(measures.sex == Sex::Child ? "unknown" : sexName(measures.sex));
}

// The files of Valentina and of Seamly2D differ in their root, its version and how they name the person.
std::string valentinaFile(const std::string& root, const std::string& version, const std::string& person,
                          const Measurements& measures) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<" + root + ">\n  <version>" + version +
         "</version>\n  <read-only>false</read-only>\n  <notes/>\n  <unit>cm</unit>\n  <pm_system>998</pm_system>\n"
         "  <personal>\n    " +
         person + "\n    <birth-date>1800-01-01</birth-date>\n    <gender>" + gender(measures) +
         "</gender>\n    <email/>\n  </personal>\n  <body-measurements>\n" + lines(measures) +
         "  </body-measurements>\n</" + root + ">\n";
}

bool json(const std::filesystem::path& file) { return hasEnding(file, fileFormat("garmentcode")); }

}  // namespace

std::string writeMeasuresText(const Measurements& measures) {
  std::string all =
      "# Measures of a figure. Lengths: mm, cm, m, in; angles: deg.\nsex = " + std::string(sexName(measures.sex)) +
      "\n";
  for (const auto& [key, value] : measures.value)
    all += key + " = " + inCentimetres(key, value) + (isAngle(key) ? "deg\n" : "cm\n");
  return all;
}

std::string writeVit(const Measurements& measures) { return valentinaFile("vit", "0.5.1", "<customer/>", measures); }

std::string writeSmis(const Measurements& measures) {
  return valentinaFile("smis", "0.3.4", "<family-name/>\n    <given-name/>", measures);
}

std::string writeFreeSewing(const Measurements& measures) {
  std::string all = "# Millimetres; shoulderSlope in degrees.\nmeasurements:\n";
  for (const auto& [key, value] : measures.value)
    if (const std::string_view name = measureNameIn(&MeasureNames::freeSewing, key); !name.empty())
      all += "  " + std::string(name) + ": " + number(isAngle(key) ? value * kDegrees : value * 1000) + "\n";
  return all;
}

Measurements forMannequin(const Measurements& measures) {
  Measurements made;
  made.sex = measures.sex;
  for (const std::string_view key : mannequinKeys())
    if (const auto at = measures.value.find(std::string(key)); at != measures.value.end()) made.value.insert(*at);
  return made;
}

Result<MeasuresRead> readMeasures(const std::filesystem::path& file) {
  for (const FileFormat* format : formatsReading(file)) {
    if (!format->readMeasures && !json(file)) continue;
    auto bytes = readFile(file, std::size_t{8} << 20);
    if (!bytes) return bytes.error();
    bytes = withoutUtf16(*std::move(bytes));
    auto read = json(file) ? readMeasuresJson(*bytes) : format->readMeasures(*bytes);
    if (!read) return inFile(file, read.error());
    return read;
  }
  return unreadable(file, {FileContent::Measures});
}

Result<std::string> writtenMeasures(const std::filesystem::path& file, const Measurements& measures) {
  for (const FileFormat& format : fileFormats())
    if (format.writeMeasures && hasEnding(file, format)) return format.writeMeasures(measures);
  return badInput(say("“{0}” has none of the endings that measures are written to: {1}.", file.filename().string(),
                      listed(measureEndingsWritten())));
}

}  // namespace karinui
