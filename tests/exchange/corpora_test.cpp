// The files of the fuzz targets' corpora, whole, cut short and with bytes changed, through every reader. What a reader
// takes is examined by tests/fuzz/readers.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "../apps/karinui/batch/manifest.h"
#include "fuzz/readers.h"
#include "karinui/exchange/read_body.h"
#include "karinui/exchange/read_print.h"
#include "patterns.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::filesystem::path> corpus(std::string_view folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(KARINUI_SOURCE_DIR) / "tests/fuzz/corpus" / folder))
    files.push_back(file.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Corpora, GoThroughEveryReader) {
  std::size_t files = 0;
  for (const auto& reader : test::fuzzedReaders())
    for (const char* folder : {"dxf", "svg", "json", "measures", "ops", "dump", "document", "parts", "request", "hand",
                               "poses", "manifest", "formula", "reply", "device"})
      for (const auto& file : corpus(folder)) reader.read(test::content(file)), ++files;
  EXPECT_GT(files, 800u);
}

TEST(Corpora, CutShortAndChangedTheyAreTakenOrRefused) {
  std::mt19937 random(7);
  for (const auto& reader : test::fuzzedReaders())
    for (const auto& file : corpus(reader.corpus)) {
      const std::string whole = test::content(file);
      for (std::size_t cut = 0; cut < whole.size(); cut += std::max<std::size_t>(1, whole.size() / 20))
        reader.read(std::string_view(whole).substr(0, cut));
      for (int round = 0; round < 60; ++round) {
        std::string changed = whole;
        for (int n = 0; n < 1 + round % 4 && !changed.empty(); ++n) {
          const std::size_t at = random() % changed.size();
          if (random() % 3 == 0)
            changed.erase(at, 1 + random() % 8);
          else if (random() % 2 == 0)
            changed[at] = static_cast<char>(random() % 256);
          else
            changed[at] = "0123456789-.eE"[random() % 14];
        }
        reader.read(changed);
      }
    }
}

// Keys and seals are no signatures: whoever changes a batch can make them anew.
TEST(Corpora, ABatchNamesFilesInItsFolderAndOutcomesThatThereAre) {
  const auto folder = std::filesystem::path(KARINUI_SOURCE_DIR) / "tests/fuzz/corpus/manifest";
  EXPECT_TRUE(app::parseManifest(test::content(folder / "two_by_two.json"), "batch"));
  for (const char* name : {"elsewhere.json", "deep.json", "outcome.json"})
    EXPECT_FALSE(app::parseManifest(test::content(folder / name), "batch")) << name;
  app::BatchItem item;
  item.key = "00";
  const auto sealed = [&](const char* word) {
    app::Json outcome = *app::shallowJson(test::content(folder / "outcome.json"));
    outcome["outcome"] = word;
    outcome["seal"] = app::sealOf(outcome);
    return app::parseOutcome(outcome.dump(), item);
  };
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_FALSE(app::parseManifest("{\"x\":" + deep + "}", "batch"));
  EXPECT_TRUE(app::parseOutcome("{\"key\":\"00\",\"outcome\":\"ok\",\"numbers\":" + deep + "}", item).is_null());
  EXPECT_TRUE(sealed("did not settle").is_object());
  EXPECT_TRUE(sealed("it flew away").is_null());
}

TEST(Corpora, JsonIsHeldAsDeepAsItMayBe) {
  const auto nested = [](int deep, const std::string& within) {
    const auto levels = static_cast<std::size_t>(deep);
    return std::string(levels, '[') + within + std::string(levels, ']');
  };
  for (const char* within : {"1", "\"word\"", "{}", "null"}) {
    bool deep = true;
    EXPECT_TRUE(app::shallowJson(nested(app::kDeepestJson, within), &deep)) << within;
    EXPECT_FALSE(deep) << within;
    EXPECT_FALSE(app::shallowJson(nested(app::kDeepestJson + 1, within), &deep)) << within;
    EXPECT_TRUE(deep) << within;
  }
  EXPECT_FALSE(app::shallowJson("[1, 2"));
  EXPECT_FALSE(app::shallowJson("[1e999]"));
}

// A batch of many garments has an object for each. A reader that looks back at all of them for each would take hours.
TEST(Corpora, JsonOfManyObjectsIsReadAtOnce) {
  constexpr std::size_t kMany = 1'000'000;
  std::string many = "[{}";
  for (std::size_t k = 1; k < kMany; ++k) many += ",{}";
  const auto all = app::shallowJson(many + "]");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->size(), kMany);
}

// Those that the fuzz targets read without the cell.
TEST(Corpora, OfBodiesAndPicturesAreTakenOrRefusedByTheCell) {
  Workers workers(1);
  std::size_t files = 0, taken = 0;
  const auto look = [&](const auto& read, const std::filesystem::path& file) {
    ++files, taken += bool(read);
    EXPECT_THAT(read ? "" : text(read.error().what), Not(HasSubstr("made the reader fail"))) << file;
  };
  for (const char* folder : {"obj", "ply", "gltf", "glb"})
    for (const auto& file : corpus(folder)) look(readBody(file, {}, workers, Token()), file);
  for (const auto& file : corpus("picture")) look(readPrint(file, Token()), file);
  EXPECT_GE(files, 15u);
  EXPECT_GE(taken, 4u);
}

}  // namespace
}  // namespace karinui
