#include "daemon/monitor/plant_metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/monitor/metrics.hpp"
#include "tests/daemon/monitor/exposition.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using storage::AreaFigures;
using storage::PlantFigures;
using testing::Contains;
using testing::Key;
using testing::Not;
using testing::Pair;

class PlantMetricsTest : public testing::Test {
 protected:
  [[nodiscard]] std::map<std::string, double> samples() const {
    return read_exposition(metrics.text()).samples;
  }
  Metrics metrics{{"0.1.0", 8, "avx2"}};
};

const AreaFigures kNorth{.area = "north",
                         .judged = 7,
                         .not_controlling = 2,
                         .not_judged = 1,
                         .never_analysed = 3,
                         .control_sum = 4.5,
                         .control_loops = 9,
                         .flagged = {{"valve_stiction", 2}}};
const std::map<std::string, std::int64_t> kAnnounced{{"tight_tuning", 0}, {"valve_stiction", 5}};

TEST_F(PlantMetricsTest, AreNotSaidBeforeTheyAreKnown) {
  for (const char* name : {"loopscope_flagged_loops", "loopscope_flags_total",
                           "loopscope_loops_by_state", "loopscope_service_factor"})
    EXPECT_EQ(metrics.text().find(name), std::string::npos) << name;
}

TEST_F(PlantMetricsTest, SayHowEachAreaStands) {
  metrics.set(PlantFigures{{kNorth, {.area = "", .never_analysed = 1}}, kAnnounced});
  const auto all = samples();
  for (const auto& [name, value] :
       {std::pair{R"(loopscope_flagged_loops{area="north",verdict="valve_stiction"})", 2.0},
        std::pair{R"(loopscope_flagged_loops{area="north",verdict="tight_tuning"})", 0.0},
        std::pair{R"(loopscope_flagged_loops{area="none",verdict="tight_tuning"})", 0.0},
        std::pair{R"(loopscope_loops_by_state{area="north",state="judged"})", 7.0},
        std::pair{R"(loopscope_loops_by_state{area="north",state="not_controlling"})", 2.0},
        std::pair{R"(loopscope_loops_by_state{area="north",state="not_judged"})", 1.0},
        std::pair{R"(loopscope_loops_by_state{area="none",state="never_analysed"})", 1.0},
        std::pair{R"(loopscope_service_factor{area="north"})", 0.5},
        std::pair{R"(loopscope_flags_total{verdict="valve_stiction"})", 5.0},
        std::pair{R"(loopscope_flags_total{verdict="tight_tuning"})", 0.0}})
    EXPECT_THAT(all, Contains(Pair(name, value)));
  EXPECT_THAT(all, Not(Contains(Key(R"(loopscope_service_factor{area="none"})"))))
      << "nothing is known of it";
}

TEST_F(PlantMetricsTest, ForgetAnAreaThatIsNoLongerThere) {
  metrics.set(PlantFigures{{kNorth}, kAnnounced});
  metrics.set(PlantFigures{{{.area = "south", .judged = 1}}, kAnnounced});
  EXPECT_EQ(metrics.text().find("north"), std::string::npos);
  EXPECT_THAT(samples(),
              Contains(Pair(R"(loopscope_loops_by_state{area="south",state="judged"})", 1.0)));
}

TEST_F(PlantMetricsTest, TheTotalFollowsTheDatabaseAlsoBackToABackup) {
  for (const std::int64_t total : {5, 7, 7, 3}) {
    metrics.set(PlantFigures{{}, {{"valve_stiction", total}}});
    EXPECT_THAT(samples(), Contains(Pair(R"(loopscope_flags_total{verdict="valve_stiction"})",
                                         static_cast<double>(total))));
  }
}

/// Names that are equal as a plain line are one series, with the loops of both.
TEST_F(PlantMetricsTest, HostileAreasStayLabelsOfOneLine) {
  PlantFigures figures{{}, kAnnounced};
  for (const tests::HostileName& hostile : tests::hostile_names())
    figures.areas.push_back({.area = hostile.name, .judged = 1});
  figures.areas.push_back({.area = "a\nb", .judged = 1});
  metrics.set(figures);
  double judged = 0.0;
  for (const auto& [name, value] : samples())
    if (name.find("state=\"judged\"") != std::string::npos) judged += value;
  EXPECT_EQ(judged, static_cast<double>(figures.areas.size()));
}

}  // namespace
}  // namespace loopscope::daemon
