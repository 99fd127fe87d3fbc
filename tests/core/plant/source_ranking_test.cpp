#include "core/plant/source_ranking.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace loopscope::core::plant {
namespace {

/// A loop that the oscillation shakes and that shows nothing of its own.
SourceEvidence victim() {
  SourceEvidence evidence;
  evidence.strength = 0.7;
  evidence.line_height = 50.0;
  evidence.op_share = 0.4;
  evidence.net_lead = -0.4;
  evidence.direct_lead = -0.3;
  evidence.outside_p = 0.6;
  evidence.cubic_evidence = 5.0;
  return evidence;
}

SourceEvidence sticking() {
  SourceEvidence evidence;
  evidence.strength = 0.7;
  evidence.line_height = 100.0;
  evidence.op_share = 0.8;
  evidence.net_lead = 0.6;
  evidence.direct_lead = 0.4;
  evidence.friction_p = 0.8;
  evidence.cubic_evidence = 60.0;
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
  std::vector<SourceEvidence> evidence(6, victim());
  for (SourceEvidence& one : evidence) one.outside_p = 0.9;
  evidence.front().net_lead = 0.3;  // where the wave arrives first
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_GT(odds.outside, 0.5);
  for (const double one : odds.members) EXPECT_LT(one, 0.5);
}

TEST(SourceRanking, EveryFigureSpeaksAsItsNameSays) {
  SourceEvidence first = victim();
  first.net_lead = 0.6;
  const auto chance = [&first](const SourceEvidence& one) {
    return rank_sources(std::vector<SourceEvidence>{first, one}).members[1];
  };
  const double as_victim = chance(victim());
  SourceEvidence leads = victim(), valve = victim(), output = victim(), outside = victim();
  leads.net_lead = 0.5;
  valve.friction_p = 0.8;
  output.op_share = 0.9;
  outside.outside_p = 1.0;
  EXPECT_GT(chance(leads), as_victim);
  EXPECT_GT(chance(valve), as_victim);
  EXPECT_GT(chance(output), as_victim);
  EXPECT_LT(chance(outside), as_victim);
}

TEST(SourceRanking, OfALoopThatMovesNoValveNoneIsBlamed) {
  SourceEvidence master = sticking();
  master.writes_setpoint = true;
  const std::vector<SourceEvidence> evidence{master, sticking(), victim()};
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_GT(odds.members[1], 2.0 * odds.members[0]);
  bool said = false;
  for (const std::string& reason : reasons_of(master))
    said |= reason.find("setpoint") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(SourceRanking, AValveThatSticksInAnotherRhythmCountsLess) {
  SourceEvidence other = victim(), same = victim();
  other.friction_p = same.friction_p = 0.9;
  other.strength = 0.05;
  const std::vector<SourceEvidence> evidence{other, same, victim()};
  const SourceOdds odds = rank_sources(evidence);
  EXPECT_LT(odds.members[0], 0.5 * odds.members[1]);
}

TEST(SourceRanking, ReasonsNameWhatSpeaksForTheLoopFirst) {
  const std::vector<std::string> reasons = reasons_of(sticking());
  ASSERT_EQ(reasons.size(), 3U);
  EXPECT_NE(reasons.front().find("predicts the others"), std::string::npos) << reasons.front();
  EXPECT_NE(reasons_of(victim()).back().find("Against it"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::core::plant
