#include "daemon/catalogue/discovery_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

storage::CatalogueEntry entry_of(const std::string& name, const std::string& pv,
                                 const std::string& sp, const std::string& op) {
  storage::CatalogueEntry entry;
  entry.name = name;
  entry.pv_tag = pv;
  entry.sp_tag = sp;
  entry.op_tag = op;
  return entry;
}

TEST(DiscoveryText, NothingMissingIsOneLine) {
  DiscoveryReport report{"plant", 3, {}, 2, {}};
  report.discovery.loops = {entry_of("A", "A.PV", "A.SP", "A.OP")};
  EXPECT_EQ(discovery_text(report),
            "historian plant: 3 tags, 1 loop is new (sp 1, pv 1, op 1, mv 0, mode 0), 2 are in the "
            "catalogue\n");
  report = {"plant", 1, {}, 1, {}};
  EXPECT_EQ(discovery_text(report),
            "historian plant: 1 tag, 0 loops are new (sp 0, pv 0, op 0, mv 0, mode 0), 1 is in the "
            "catalogue\n");
}

TEST(DiscoveryText, EverythingMissingOrUnclearHasALine) {
  DiscoveryReport report{"plant", 9, {}, 0, {"T"}, {"A.MODE"}, {}};
  report.discovery.loops = {entry_of("A", "A.PV", "", ""), entry_of("C", "C.PV", "C.SP", "C.MV")};
  report.discovery.without_pv = {entry_of("B", "", "B.SP", "B.OP")};
  report.discovery.indicators = {entry_of("TI7", "TI7.PV", "", "")};
  report.discovery.doubtful = {{entry_of("FV3", "FV3.PV", "FV3.SP", ""), "named as a valve"}};
  report.discovery.ambiguous = {{"D", "pv", {"D.PV", "D.MEAS"}, "D.PV"},
                                {"E", "pv", {"E.PV", "E/PV"}, ""}};
  report.discovery.by_shared_word = {"C"};
  for (int k = 1; k <= 12; ++k) report.discovery.unmatched.push_back("X" + std::to_string(k));
  EXPECT_EQ(
      discovery_text(report),
      "historian plant: 9 tags, 2 loops are new (sp 1, pv 2, op 1, mv 0, mode 0), 0 are in "
      "the catalogue\n"
      "       1 without pv, left out: B (B.SP, B.OP)\n"
      "       1 pv without sp and op, no control loop, left out: TI7 (TI7.PV)\n"
      "       1 perhaps no control loop, left out: FV3 (FV3.SP, FV3.PV): named as a valve\n"
      "       1 without op, no model and no valve to judge: A\n"
      "       1 without sp, the mean of pv stands in: A\n"
      "       1 tag without a value, left out: A.MODE\n"
      "       2 roles with several tags: D pv (D.PV, D.MEAS; taken: D.PV), E pv (E.PV, E/PV; "
      "none taken)\n"
      "       1 by a word of two roles (MV), check op and mv: C\n"
      "       1 name taken by another loop of the catalogue, left out: T\n"
      "      12 tags are no loop's by their names: X1, X2, X3, X4, X5, X6, X7, X8, X9, X10, ...\n");
}

TEST(DiscoveryText, ProposalsAndQuestions) {
  const std::vector<Proposal> proposals = {
      {"A", "op_low=0 op_high=1", "op is 0.4 to 0.6 in 300 values, never outside 0 to 1",
       [](storage::CatalogueEntry&) {}},
      {"B 1",
       "",
       "op is 8 to 14 in 300 values: 0 to 100 (%) or 4 to 20 (mA)?",
       nullptr,
       {"--op-low=0 --op-high=100", "--op-low=4 --op-high=20"}}};
  EXPECT_EQ(proposals_text(proposals, "a.json"),
            "       1 proposed by history and name: A op_low=0 op_high=1 (op is 0.4 to 0.6 in 300 "
            "values, never outside 0 to 1)\n"
            "       1 question that history leaves open; who knows the answer says it, once the "
            "loop is in the catalogue, by:\n"
            "         B 1: op is 8 to 14 in 300 values: 0 to 100 (%) or 4 to 20 (mA)?\n"
            "           loopscope loops --config a.json set 'B 1' --op-low=0 --op-high=100\n"
            "           loopscope loops --config a.json set 'B 1' --op-low=4 --op-high=20\n");
  EXPECT_THAT(proposals_text(std::vector<Proposal>(12, proposals[1]), "f"),
              testing::EndsWith("         ... and 2 more\n"));
  EXPECT_EQ(proposals_text({}, "f"), "");
}

}  // namespace
}  // namespace loopscope::daemon
