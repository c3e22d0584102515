#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <cstring>
#include <filesystem>

#include "karinui/view/picture.h"
#include "view/utf8.h"

namespace karinui {
namespace {

int inked(const Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i] < 128;
  return count;
}

TEST(Words, Utf8IsReadAndRubbishReplaced) {
  EXPECT_EQ(lettersOf("a仮𝄞\n"), U"a仮𝄞 ");
  EXPECT_EQ(lettersOf("\xff\xc3(\xe4\xbb\xf5\x80\xed\xa0\x80\xc0\xaf"),
            std::u32string(U"\ufffd\ufffd(\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd\ufffd"));
  EXPECT_EQ(lettersOf("\xe4\xbb"), U"\ufffd\ufffd") << "cut off in the middle";
}

TEST(Words, LatinAndJapaneseAreWritten) {
  Lettering lettering;
  Image image(300, 60);
  lettering.write(image, "仮縫い fitting", 5, 40, 24, {0, 0, 0, 255});
  const auto notes = lettering.takeNotes();
  if (!notes.empty()) GTEST_SKIP() << text(notes[0]);
  EXPECT_GT(inked(image), 300);
  EXPECT_GT(lettering.width("前身頃", 24), 60);
  EXPECT_NEAR(lettering.width("前身頃前身頃", 24), 2 * lettering.width("前身頃", 24), 1e-6);
}

TEST(Words, AMissingFontIsSaidAndTheRestDrawn) {
  const std::string latin = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  if (!std::filesystem::exists(latin)) GTEST_SKIP() << "no DejaVu here";
  Lettering lettering({latin});
  Image image(300, 60);
  lettering.write(image, "front 前身頃", 5, 40, 24, {0, 0, 0, 255});
  EXPECT_GT(inked(image), 150);
  const auto notes = lettering.takeNotes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(text(notes[0]).find("fonts-ipafont-gothic"), std::string::npos);
  EXPECT_TRUE(lettering.takeNotes().empty());

  Lettering none(std::vector<std::string>{"/nowhere.ttf"});
  none.write(image, "x", 0, 0, 10, {});
  EXPECT_EQ(none.takeNotes().size(), 1u);
}

TEST(Words, ASheetHoldsItsPicturesInOrderWithCaptions) {
  const Pixel red{200, 0, 0, 255}, green{0, 200, 0, 255};
  const std::vector<SheetItem> items{
      {Image(120, 160, red), "one"}, {Image(120, 160, green), "二"}, {Image(60, 80, red), ""}};
  const auto sheet = contactSheet(items, {.columns = 2});
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->at(60, 80), red);
  EXPECT_EQ(sheet->at(sheet->width - 60, 80), green);
  EXPECT_EQ(sheet->at(64, sheet->height - 60), red);
  EXPECT_FALSE(contactSheet({}));
  EXPECT_FALSE(contactSheet(std::vector<SheetItem>(600, {Image(120, 16), ""})));
}

// As large as was asked, whatever the captions and margins take of it.
TEST(Words, ASheetIsAsLargeAsItsLayoutSays) {
  for (const auto& [width, height] : {std::pair(1800, 2400), {900, 1200}, {1920, 1080}, {211, 283}})
    for (const bool joined : {false, true})
      for (const int count : {2, 4, 8}) {
        const SheetLayout layout{.columns = count / 2, .joined = joined, .width = width, .height = height};
        const SheetCell cell = sheetCell(count, layout);
        EXPECT_GT(cell.width * layout.columns, 0.85 * width);
        EXPECT_GT(cell.height * 2, 0.75 * height);
        const auto sheet = contactSheet(
            std::vector<SheetItem>(static_cast<std::size_t>(count), {Image(cell.width, cell.height), "Front"}), layout);
        ASSERT_TRUE(sheet);
        EXPECT_EQ(sheet->width, width);
        EXPECT_EQ(sheet->height, height);
      }
}

TEST(Words, APngIsWrittenWholeOrNotAtAll) {
  Image image(3, 2, {10, 20, 30, 255});
  image.set(2, 1, {200, 100, 50, 128});
  const std::string path = ::testing::TempDir() + "karinui_view_words.png";
  ASSERT_TRUE(writePng(path, image));
  png_image read;
  std::memset(&read, 0, sizeof read);
  read.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&read, path.c_str()));
  read.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(read));
  ASSERT_TRUE(png_image_finish_read(&read, nullptr, back.data(), 0, nullptr));
  EXPECT_EQ(back, image.rgba);

  const std::string link = ::testing::TempDir() + "karinui_view_link.png";
  std::filesystem::remove(link);
  std::filesystem::create_symlink(path, link);
  ASSERT_TRUE(writePng(link, Image(8, 8)));
  EXPECT_TRUE(std::filesystem::is_symlink(link)) << "it is the file it points to that is written";
  ASSERT_TRUE(png_image_begin_read_from_file(&read, path.c_str()));
  EXPECT_EQ(read.width, 8u);
  png_image_free(&read);
  std::filesystem::remove(link);
  std::filesystem::remove(path);

  const auto nowhere = writePng("/nowhere/at/all.png", image);
  ASSERT_FALSE(nowhere);
  EXPECT_NE(text(nowhere.error().what).find("/nowhere/at/all.png"), std::string::npos);
}

}  // namespace
}  // namespace karinui
