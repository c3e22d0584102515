// The session's small state machines, without a session: what a drape under way, a preview and a figure on trial may
// do.
#include <gtest/gtest.h>

#include <random>

#include "session/figure_trial.h"
#include "session/latest_request.h"
#include "session/settle_schedule.h"

namespace karinui {
namespace {

PieceId piece(int n) { return PieceId{static_cast<std::uint64_t>(n)}; }

TEST(LatestRequest, OneAtATimeAndOnlyTheNewestAfterIt) {
  LatestRequest<int> requests;
  EXPECT_FALSE(requests.next());
  requests.put(1);
  EXPECT_EQ(requests.next(), 1);
  requests.put(2);
  requests.put(3);
  EXPECT_FALSE(requests.next()) << "1 is still on its way";
  requests.answered();
  EXPECT_EQ(requests.next(), 3) << "2 is asked for no more";
  requests.answered();
  EXPECT_FALSE(requests.next());
}

TEST(LatestRequest, ClearedItWaitsForNothing) {
  LatestRequest<int> requests;
  requests.put(1);
  (void)requests.next();
  requests.put(2);
  requests.clear();
  EXPECT_FALSE(requests.next());
  requests.put(4);
  EXPECT_EQ(requests.next(), 4) << "what was dropped unanswered must not keep the next one waiting";
}

TEST(FigureTrial, AFigureThatComesAfterTheTrialIsNotShown) {
  FigureTrial trial;
  SetBody body;
  body.size = "EU 40";
  trial.propose(body);
  EXPECT_TRUE(trial.active());
  ASSERT_TRUE(trial.next());
  EXPECT_TRUE(trial.built());
  trial.propose(body);
  ASSERT_TRUE(trial.next());
  EXPECT_TRUE(trial.end());
  EXPECT_FALSE(trial.built());
  EXPECT_FALSE(trial.end()) << "there was none any more";
}

TEST(SettleSchedule, AStepInterruptsADrapeOnceAndItsPiecesAreRemembered) {
  SettleSchedule schedule;
  EXPECT_FALSE(schedule.interrupt()) << "nothing to cancel";
  const auto stop = schedule.begin({piece(1), piece(2)}, true);
  EXPECT_TRUE(schedule.interrupt());
  EXPECT_TRUE(schedule.live().empty());
  EXPECT_EQ(schedule.interrupted(), (std::set{piece(1), piece(2)}));
  EXPECT_FALSE(schedule.interrupt());
  schedule.end(stop);
  EXPECT_EQ(schedule.interrupted(), (std::set{piece(1), piece(2)})) << "it was cancelled: they still wait";
}

TEST(SettleSchedule, TheEndOfAnOlderDrapeIsNotThatOfTheOneUnderWay) {
  SettleSchedule schedule;
  const auto first = schedule.begin({piece(1)}, false);
  const auto second = schedule.begin({piece(2)}, false);
  schedule.end(first);
  EXPECT_EQ(schedule.live(), std::set{piece(2)});
  schedule.end(second);
  EXPECT_TRUE(schedule.live().empty());
}

TEST(SettleSchedule, StoppingWaitsForADrapeThatHasMovedSomething) {
  SettleSchedule schedule;
  const auto stop = schedule.begin({piece(1)}, false);
  EXPECT_EQ(schedule.stop(), SettleSchedule::Stopping::NotBegun);
  (void)stop->askedAfterStep();  // the solver has made a step
  EXPECT_EQ(schedule.stop(), SettleSchedule::Stopping::UnderWay);
  EXPECT_EQ(schedule.stop(), SettleSchedule::Stopping::UnderWay) << "asked again";
  EXPECT_FALSE(schedule.interrupt()) << "it is over in a moment";
}

TEST(SettleSchedule, WhateverHappensAPieceIsDrapedOrWaitsNeverBoth) {
  std::mt19937 dice(11);
  SettleSchedule schedule;
  std::vector<std::shared_ptr<StopRequest>> begun;
  std::string log;
  for (int step = 0; step < 4000; ++step) {
    const PieceId some = piece(static_cast<int>(dice() % 5) + 1), other = piece(static_cast<int>(dice() % 5) + 1);
    const unsigned what = dice() % 8;
    log += std::to_string(what);
    switch (what) {
      case 0:
      case 1:
        begun.push_back(schedule.begin({some, other}, dice() % 2 == 0));
        break;
      case 2:
        (void)schedule.interrupt();
        break;
      case 3:
        (void)schedule.stop();
        break;
      case 4:
        schedule.disturb(some);
        break;
      case 5:
        if (!begun.empty()) schedule.end(begun[dice() % begun.size()]);
        break;
      case 6:
        if (!begun.empty()) (void)begun.back()->askedAfterStep();
        break;
      default:
        if (dice() % 4 == 0) schedule.drop();
    }
    for (const PieceId id : schedule.live()) ASSERT_FALSE(schedule.interrupted().contains(id)) << "seed 11: " << log;
  }
}

}  // namespace
}  // namespace karinui
