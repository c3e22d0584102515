#pragma once
// A person's measures in files: our own plain text, Valentina and Seamly2D (.vit, .smis, .vst), FreeSewing (YAML, JSON)
// and GarmentCode (YAML). Names are mapped to ours by one table; what has no counterpart is named in `unknown` and left
// out. Strangers' files are welcome: sizes and counts are bounded, XML has no DTD. Pure, but for what opens a file; any
// thread.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/body/measurements.h"

namespace karinui {

struct MeasuresRead {
  Measurements measures;             // metres and radians
  std::vector<std::string> unknown;  // names in the file that mean nothing here, or have no value
  struct Unread {
    std::string name;
    Message why;
  };
  std::vector<Unread> unread;  // names that are known here, whose values cannot be worked out
};

// By the ending (formats.h); .json is FreeSewing's or GarmentCode's.
Result<MeasuresRead> readMeasures(const std::filesystem::path& file);
Result<std::string> writtenMeasures(const std::filesystem::path& file, const Measurements& measures);

// One format each, from and to the file's bytes.
Result<MeasuresRead> readMeasuresText(std::string_view bytes);
Result<MeasuresRead> readValentina(std::string_view bytes);  // .vit, .smis, .vst: at its base size
Result<MeasuresRead> readMeasuresYaml(std::string_view bytes);
Result<MeasuresRead> readMeasuresJson(std::string_view bytes);
std::string writeMeasuresText(const Measurements& measures);
std::string writeVit(const Measurements& measures);
std::string writeSmis(const Measurements& measures);
std::string writeFreeSewing(const Measurements& measures);

// Those that a mannequin can be made to.
Measurements forMannequin(const Measurements& measures);

}  // namespace karinui
