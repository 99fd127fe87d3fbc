#include "core/model/valve_law/valve_kernel.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/core/model/model_records.hpp"
#include "tests/support/each_processor.hpp"

namespace loopscope::core::model {
namespace {

/// Of bands and jumps of all kinds, one of which begins elsewhere; op pauses once.
std::vector<EightNumbers> positions(ValveLaw law) {
  std::vector<double> op = tests::white_noise(500, 3);
  op[40] = op[41] = std::numeric_limits<double>::quiet_NaN();
  std::vector<Valve> valves;
  for (std::size_t i = 0; i < kSideBySide; ++i) {
    const double band = 0.3 * static_cast<double>(i);
    valves.push_back({law, band, 0.3 * static_cast<double>(i % 4) * band, i < 4 ? -1.0 : 1.0});
  }
  valves.back().start_percent = 2.0;
  std::vector<EightNumbers> mv(op.size());
  follow_valves(valves, op, mv);
  return mv;
}

TEST(ValveKernel, IsTheSameOnEveryProcessor) {
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    const auto found = loopscope::tests::on_each_processor([=] { return positions(law); });
    for (const std::vector<EightNumbers>& mv : found) {
      for (std::size_t k = 0; k < mv.size(); ++k) {
        for (std::size_t i = 0; i < kSideBySide; ++i) ASSERT_EQ(mv[k][i], found.front()[k][i]);
      }
    }
  }
}

/// SideBySideTheyStandWhereEachDoesByItself of valve_law_test asks where they stand.
TEST(ValveKernel, FollowsOpWithoutABand) {
  const std::vector<double> op = tests::white_noise(50, 4);
  std::vector<EightNumbers> mv(op.size());
  follow_valves(std::vector{Valve{ValveLaw::he, 0.0, 0.0}}, op, mv);
  EXPECT_EQ(series_at(0, mv), op);
  EXPECT_EQ(series_at(7, mv), op);
}

}  // namespace
}  // namespace loopscope::core::model
