#include "core/plant/source_ranking.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace loopscope::core::plant {
namespace {

/// A loop that the oscillation shakes and that shows nothing of its own.
SourceEvidence victim() {
  SourceEvidence evidence;
  evidence.strength = 0.7;
  evidence.outside_explained = 0.1;
  evidence.cycle_score = 0.1;
  evidence.cubic_evidence = 20.0;
  return evidence;
}

SourceEvidence sticking() {
  SourceEvidence evidence;
  evidence.strength = 0.7;
  evidence.valve_explained = 0.8;
  evidence.valve_blamed = 0.8;
  evidence.cycle_score = 0.95;
  evidence.cubic_evidence = 80.0;
  return evidence;
}

TEST(SourceRanking, OddsAddUpToOne) {
  const std::vector<SourceEvidence> evidence{victim(), sticking(), victim()};
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_NEAR(std::accumulate(odds.members.begin(), odds.members.end(), odds.outside), 1.0, 1e-12);
  EXPECT_EQ(rank_sources({}).outside, 1.0);
}

TEST(SourceRanking, AStickingValveAmongVictimsIsTheSource) {
  const std::vector<SourceEvidence> evidence{victim(), sticking(), victim()};
  EXPECT_GT(rank_sources(evidence).members[1], 0.8);
}

TEST(SourceRanking, VictimsAloneNameNobody) {
  const std::vector<SourceEvidence> evidence(6, victim());
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_GT(odds.outside, 0.5);
  for (const double one : odds.members) EXPECT_LT(one, 0.5);
}

TEST(SourceRanking, WhatTheValveExplainsRaisesALoop) {
  SourceEvidence more = victim();
  more.valve_explained = 0.3;
  const std::vector<SourceEvidence> evidence{victim(), more};
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_GT(odds.members[1], odds.members[0]);
}

TEST(SourceRanking, ALoopThatMovesNoValveIsNoSource) {
  SourceEvidence master = sticking();
  master.writes_setpoint = true;
  const std::vector<SourceEvidence> evidence{master, sticking(), victim()};
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_GT(odds.members[1], 0.8);
  EXPECT_LT(odds.members[0], 0.05);
  EXPECT_NE(reasons_of(master).front().find("setpoint"), std::string::npos);
}

TEST(SourceRanking, AValveThatSticksInAnotherRhythmIsNoSource) {
  SourceEvidence other = sticking();
  other.strength = 0.05;
  const std::vector<SourceEvidence> evidence{other, victim()};
  EXPECT_LT(rank_sources(evidence).members[0], 0.5);
}

TEST(SourceRanking, ReasonsNameWhatSpeaksForTheLoopFirst) {
  const std::vector<std::string> reasons = reasons_of(sticking());
  ASSERT_GE(reasons.size(), 4U);
  EXPECT_NE(reasons.front().find("by a factor of 2.23"), std::string::npos) << reasons.front();
  EXPECT_NE(reasons_of(victim()).back().find("Against it"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::core::plant
