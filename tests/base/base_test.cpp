// The lowest storey: messages, numbers, workers, hashes.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <thread>

#include "karinui/base/hash.h"
#include "karinui/base/message.h"
#include "karinui/base/number.h"
#include "karinui/base/said_lengths.h"
#include "karinui/base/threads.h"
#include "karinui/base/workers.h"

namespace karinui {
namespace {

TEST(Message, PutsValuesWhereThePatternSays) {
  EXPECT_EQ(text(say("{1} is {0} mm longer.", 2.5, "front")), "front is 2.5 mm longer.");
  EXPECT_EQ(text(say("{9} {x} {0}", 7)), "{9} {x} 7");
}

// A dialog is called as the entry of the menu that opens it.
TEST(Message, ADialogIsCalledAsItsEntry) {
  for (const auto& [entry, title] :
       {std::pair(say("Picture of the fitting…"), say("Picture of the fitting")),
        std::pair(say("Share the pattern…"), say("Share the pattern")), std::pair(say("Lay plan…"), say("Lay plan"))})
    EXPECT_EQ(text(title, Language::Japanese) + "…", text(entry, Language::Japanese));
}

TEST(Message, CountsOneAsOne) {
  const auto said = [](auto n) { return text(say("There {0|is|are} {0} {0|seam|seams}", n)); };
  EXPECT_EQ(said(1), "There is 1 seam");
  EXPECT_EQ(said(0), "There are 0 seams");
  EXPECT_EQ(said(21), "There are 21 seams");
  EXPECT_EQ(said(std::size_t{1}), "There is 1 seam");
  EXPECT_EQ(text(say("{0|no end", 1)), "{0|no end");
  EXPECT_EQ(text(say("{1|a|b}", 1)), "{1|a|b}") << "there is no such value";
  EXPECT_EQ(text(say("{0} {0|edge|edges}", 1), Language::Japanese), "辺 1 本");
  EXPECT_EQ(text(say("{0} edges", 3), Language::Japanese), "辺 3 本") << "as a document of before keeps it";
}

TEST(Message, SpeaksJapaneseWhereThereIsATranslation) {
  EXPECT_EQ(text(say("Stopped; nothing was changed."), Language::Japanese), "中止しました。何も変更していません。");
  EXPECT_EQ(text(say("No such sentence {0}.", 1), Language::Japanese), "No such sentence 1.");
}

TEST(Message, SaysASentenceWithinASentenceInTheSameLanguage) {
  const Message within = say("Line {0}: {1}", 3, say("Step {0}: {1}", 2, say("There is nothing to undo.")));
  EXPECT_EQ(text(within), "Line 3: Step 2: There is nothing to undo.");
  EXPECT_EQ(text(within, Language::Japanese), "3 行目：手順 2：取り消すことはありません。");
}

TEST(Message, SaysLengthsAsThePersonReadsThemAndLeavesNamesAlone) {
  const auto inches = [](double metres) { return fixed(metres / 0.0254, 2) + " in"; };
  const auto said = [&](const Message& m, Language l = Language::English) { return text(m, l, inches); };
  const Message dart = say(
      "A dart {0} mm wide does not fit there on edge {1}, which is {2} mm long: it would open beyond its end. Put it "
      "farther in, or join the edge to the next one first.",
      25.4, "5 mm lace", 127);
  EXPECT_EQ(said(dart),
            "A dart 1.00 in wide does not fit there on edge 5 mm lace, which is 5.00 in long: it would open beyond its "
            "end. Put it farther in, or join the edge to the next one first.");
  EXPECT_EQ(said(say("Step {0}: {1}", 2, dart)), "Step 2: " + said(dart));
  EXPECT_EQ(said(dart, Language::Japanese),
            "幅 1.00 in のダーツは、長さ 5.00 in の辺「5 mm "
            "lace」のその位置に入りません。辺の端を越えて開きます。内側へずらすか、先に次の辺とつないでください。");
  EXPECT_EQ(said(say("The line crosses itself at {0} mm; draw it without a loop.", "(50.8, -25.4)")),
            "The line crosses itself at (2.00 in, -1.00 in); draw it without a loop.");
  EXPECT_EQ(said(say("A dart is between 1 mm and 1 m wide.")), "A dart is between 0.04 in and 1 m wide.");
  EXPECT_EQ(said(say("A button is 4 to 60 mm wide.")), "A button is 0.16 in to 2.36 in wide.");
  EXPECT_EQ(said(say("A button is 4 to 60 mm wide."), Language::Japanese), "ボタンの直径は0.16 in〜2.36 inです。");
  const Message print = say("A print repeats every {0} mm; between {1} and {2} mm is possible.", 1, 12.7, 254);
  EXPECT_EQ(said(print), "A print repeats every 0.04 in; between 0.50 in and 10.00 in is possible.");
  EXPECT_EQ(said(say("Elastic is sewn in 1 to {0} rows, 3 to 100 mm apart.", 9)),
            "Elastic is sewn in 1 to 9 rows, 0.12 in to 3.94 in apart.");
  EXPECT_EQ(text(dart).find(" in "), std::string::npos) << "millimetres where nobody asked";
}

TEST(Number, LengthsInTheUnitsPeopleWrite) {
  EXPECT_EQ(*parseLength("12mm"), 0.012);
  EXPECT_EQ(*parseLength("88cm"), 0.88);
  EXPECT_EQ(*parseLength("-1.5m"), -1.5);
  EXPECT_EQ(*parseLength("－９５．５ｃｍ"), -0.955) << "as Japanese input gives it";
  EXPECT_EQ(*parseNumber("１２"), 12);
  EXPECT_EQ(*parseAngle("９０deg"), *parseAngle("90deg"));
  EXPECT_EQ(halfWidth("袖丈ｘ２\xef"), "袖丈x2\xef");
  for (const char* none : {"９５ｃ", "ー５", "\xef", "\xef\xbc", "５本"}) EXPECT_FALSE(parseLength(none)) << none;
  EXPECT_DOUBLE_EQ(*parseLength("2in"), 0.0508);
  EXPECT_DOUBLE_EQ(*parseAngle("90deg"), std::numbers::pi / 2);
  for (const char* bad : {"", "mm", "12 mm", "1,5cm", "nan", "inf", "1e999", "5furlong", "0x10"}) {
    EXPECT_FALSE(parseLength(bad)) << bad;
  }
}

TEST(Number, InchesInFractionsAsTapeMeasuresHaveThem) {
  constexpr double kInch = 0.0254;
  for (const char* said : {"27 1/2in", "27-1/2\"", "27 1/2 in", "27½\"", "27 ½″", "２７　1/2in", "27.5\"",
                           "2ft 3 1/2in", "2'3 1/2\"", "2' 3-1/2", "27 1/2 inches", " 27  1/2in"})
    EXPECT_NEAR(parseLength(said) ? *parseLength(said) : 0, 27.5 * kInch, 1e-15) << said;
  EXPECT_DOUBLE_EQ(*parseLength("1/2 in"), kInch / 2);
  EXPECT_DOUBLE_EQ(*parseLength("-3/8\""), -3 * kInch / 8);
  EXPECT_DOUBLE_EQ(*parseLength("5'"), 60 * kInch);
  EXPECT_DOUBLE_EQ(*parseLength("5'7"), 67 * kInch);
  for (const char* bad : {"1/2", "1/2cm", "27 1/2", "27 1/0in", "27 3/2in", "1/in", "/2in", "\"", "'", "ft", "5'x",
                          "27 1/2inx", "1/2/3in", "2 in/2", "left", "5''", "27-in", "waist/2in"})
    EXPECT_FALSE(parseLength(bad)) << bad;
}

TEST(Number, ShortestReadsBackTheSameBits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::pow(10.0, exponent(random)) * (i % 2 ? -1 : 1);
    EXPECT_EQ(*parseNumber(shortest(value)), value);
  }
  EXPECT_EQ(fixed(-0.0001, 2), "0.00");
  EXPECT_EQ(fixed(1.235, 1), "1.2");
}

TEST(Workers, SumsAreTheSameBitsForAnyNumberOfThreads) {
  std::mt19937_64 random(3);
  std::vector<double> values(100'003);
  for (double& v : values) v = std::ldexp(static_cast<double>(random()), -60);
  const auto total = [&](int threads) {
    Workers workers(threads);
    return workers.sum(values.size(), 1024, [&](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) part += values[i];
      return part;
    });
  };
  EXPECT_EQ(total(1), total(2));
  EXPECT_EQ(total(1), total(5));
}

TEST(Workers, AsManyThreadsAsTheEnvironmentSays) {
  const char* before = std::getenv("KARINUI_THREADS");
  const std::string kept = before ? before : "";
  setenv("KARINUI_THREADS", "7", 1);
  EXPECT_EQ(usualThreads(), 7);
  unsetenv("KARINUI_THREADS");
  const int processors = usualThreads();
  EXPECT_EQ(processors, std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
  for (const char* nonsense : {"", "0", "-1", "257", "2x", " 2", "99999999999999999999"}) {
    setenv("KARINUI_THREADS", nonsense, 1);
    EXPECT_EQ(usualThreads(), processors) << nonsense;
  }
  unsetenv("KARINUI_THREADS");
  if (before) setenv("KARINUI_THREADS", kept.c_str(), 1);
}

TEST(Workers, EveryItemOnceEvenWhenCalledManyTimes) {
  Workers workers(3);
  std::vector<int> seen(997, 0);
  for (int round = 0; round < 500; ++round) {
    workers.forBlocks(seen.size(), 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
  }
  for (int count : seen) EXPECT_EQ(count, 500);
}

// Jobs of a few blocks follow each other faster than helpers wake, sleep or are put off the processor by others; the
// work of each is gone when it returns.
TEST(Workers, EveryItemOnceHoweverLateHelpersCome) {
  std::mt19937_64 random(7);
  for (const int threads : {2, 3, 8}) {
    Workers workers(threads);
    for (int round = 0; round < 3000; ++round) {
      const std::size_t count = random() % 60, block = 1 + random() % 7;
      std::vector<std::atomic<int>> seen(count);
      const auto pause = std::chrono::microseconds(random() % 50 == 0 ? 300 : 0);
      workers.forBlocks(count, block, [&](std::size_t begin, std::size_t end) {
        if (begin % 5 == 0 && pause.count() > 0) std::this_thread::sleep_for(pause);
        EXPECT_LE(end, begin + block);
        for (std::size_t i = begin; i < end; ++i) ++seen[i];
      });
      for (const auto& times : seen) ASSERT_EQ(times, 1);
      if (random() % 200 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));  // helpers fall asleep
    }
  }
}

// Memory that runs out in a block is the caller's to hear of, whichever thread met it; the team works on.
TEST(Workers, WhatABlockThrowsComesOutOfTheJob) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    for (std::size_t bad = 0; bad < 40; ++bad) {
      EXPECT_THROW(workers.forBlocks(400, 10,
                                     [&](std::size_t begin, std::size_t) {
                                       if (begin / 10 == bad) throw std::bad_alloc();
                                     }),
                   std::bad_alloc);
      std::atomic<int> done = 0;
      workers.forBlocks(400, 10, [&](std::size_t begin, std::size_t end) { done += static_cast<int>(end - begin); });
      EXPECT_EQ(done, 400);
    }
  }
}

TEST(Hash, TellsApartWhatDiffersAndNothingElse) {
  EXPECT_EQ(Hasher().add("sleeve").hex(), Hasher().add("sleeve").hex());
  EXPECT_NE(Hasher().add("ab").add("c").hex(), Hasher().add("a").add("bc").hex());
  EXPECT_NE(Hasher().add(0.0).hex(), Hasher().add(-0.0).hex());
  EXPECT_NE(Hasher().bytes("a", 1).hex(), Hasher().bytes("a\0", 2).hex());
  EXPECT_EQ(Hasher().hex().size(), 32u);
}

}  // namespace
}  // namespace karinui
