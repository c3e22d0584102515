// Documents as they were written by every form of the file there has been, kept in tests/design/kept: they open as they
// were left, and nothing is made anew. A new form adds a file and a row; the second file holds nearly every operation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "design/quick_folder.h"
#include "design/workroom.h"
#include "karinui/design/dump.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

struct KeptForm {
  const char* file;
  std::size_t steps, undone, branches;
  const char *hash, *drapeHash;
};
constexpr KeptForm kForms[] = {
    {"form_1.karinui", 28, 1, 1, "b7d183de3716832246cde4c8c23a7c54", "c37f6abe6e49ef47ef138d9ce8d3b5d7"},
    {"form_1_each_operation.karinui", 68, 2, 1, "ce2f9e428f8189429160383d5310ad3e", "81b457f9f95f7f43542eb3248d940c61"},
};

class KeptForms : public ::testing::TestWithParam<KeptForm> {
 protected:
  KeptForms() { fs::copy_file(fs::path(KARINUI_SOURCE_DIR "/tests/design/kept") / GetParam().file, path_); }
  ~KeptForms() override { fs::remove_all(folder_); }

  const fs::path folder_ = quickFolder(), path_ = folder_ / "coat.karinui";
  Workroom room_;
};

TEST_P(KeptForms, OpenAsTheyWereLeft) {
  Context never = room_.context;
  never.drape = [](const Document&, const DrapePieces&, Context&) -> Result<DrapeOutcome> {
    return refused(say("draped again"));
  };
  auto file = DocumentFile::open(path_, &never);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_THAT(file->remarks(), IsEmpty());
  EXPECT_EQ(hash(file->document()), GetParam().hash);
  EXPECT_EQ(drapeHash(file->document()), GetParam().drapeHash);
  const std::vector<Step> steps = file->steps();
  EXPECT_EQ(steps.size(), GetParam().steps);
  EXPECT_EQ(file->undone().size(), GetParam().undone);
  EXPECT_EQ(file->otherBranches().size(), GetParam().branches);
  const auto script = parseScript(file->log());
  ASSERT_TRUE(script) << text(script.error().what);
  EXPECT_EQ(script->size(), steps.size());
  // To the beginning and back, by what the file kept.
  for (std::size_t k = steps.size(); k-- > 0;) {
    ASSERT_TRUE(file->undo(never)) << k;
    EXPECT_EQ(hash(file->document()), steps[k].before);
  }
  for (const Step& step : steps) {
    const auto again = file->redo(never);
    ASSERT_TRUE(again) << step.seq << ": " << text(again.error().what);
    EXPECT_EQ(hash(file->document()), step.after);
    EXPECT_EQ(drapeHash(file->document()), step.stand);
  }
  EXPECT_TRUE(file->perform(*parseOperation("set spacing=20mm"), room_.context));
}

TEST_P(KeptForms, GoThroughTextUnchanged) {
  const auto dump = dumped(path_);
  ASSERT_TRUE(dump) << text(dump.error().what);
  const fs::path again = folder_ / "again.karinui";
  const Done done = loadDump(*dump, again);
  ASSERT_TRUE(done) << text(done.error().what);
  EXPECT_EQ(*dumped(again), *dump);
  EXPECT_EQ(drapeHash(DocumentFile::openForReading(again)->document()), GetParam().drapeHash);
}

INSTANTIATE_TEST_SUITE_P(All, KeptForms, ::testing::ValuesIn(kForms),
                         [](const auto& form) { return fs::path(form.param.file).stem().string(); });

}  // namespace
}  // namespace karinui
