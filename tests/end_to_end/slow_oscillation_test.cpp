#include <cmath>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/end_to_end/plant.hpp"

namespace loopscope::tests {
namespace {

using testing::HasSubstr;

constexpr std::size_t kSamples = 4096;
constexpr std::size_t kSeconds = 8 * kSamples;  // seconds
constexpr double kPeriod_s = 1173.0;

/// A cycle whose period wanders, second by second.
std::vector<double> slow_cycle() {
  std::mt19937_64 random(7);
  std::normal_distribution<double> slip(0.0, 0.2 / std::sqrt(kPeriod_s));
  std::vector<double> cycle;
  double phase = 0.0;
  for (std::size_t k = 0; k < kSeconds; ++k) {
    phase += 2.0 * std::numbers::pi / kPeriod_s + slip(random);
    cycle.push_back(std::sin(phase));
  }
  return cycle;
}

/// A row every `interval` seconds of the newest `rows`: what its PI controller leaves of a load,
/// and noise that wanders.
void write_loop(const std::string& file, std::size_t rows, std::size_t interval,
                const std::function<double(std::size_t)>& load, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::ofstream text(file);
  text.precision(10);
  text << "t_s,sp,pv,op\n";
  double own = 0.0, op = 50.0;
  for (std::size_t k = kSeconds - rows * interval; k < kSeconds; k += interval) {
    own = 0.97 * own + noise(random);
    const double pv = 50.0 + load(k) + own + noise(random);
    op += 0.002 * (50.0 - pv);
    text << k << ",50," << pv << ',' << op << '\n';
  }
}

class SlowOscillation : public testing::Test {
 protected:
  void SetUp() override {
    wait_for_hour_with(std::chrono::seconds(60));
    plant.write_settings(Plant::settings(R"("schedule": {"settle_s": 0})"));
    const std::vector<double> cycle = slow_cycle();
    const auto level = [&](std::size_t k) { return 2.0 * cycle[k]; };
    const auto flow = [&](std::size_t k) { return 0.6 * cycle[k < 90 ? 0 : k - 90]; };
    const auto quiet = [](std::size_t) { return 0.0; };
    import("LIC1", kSamples, 8, level, 1);
    for (unsigned k = 1; k <= 4; ++k) import("FIC" + std::to_string(k), kSeconds, 1, flow, 10 + k);
    for (unsigned k = 1; k <= 2; ++k) import("PIC" + std::to_string(k), kSeconds, 1, quiet, 20 + k);
  }
  void import(const std::string& loop, std::size_t rows, std::size_t interval,
              const std::function<double(std::size_t)>& load, unsigned seed) const {
    const std::string file = plant.folder() / (loop + ".csv");
    write_loop(file, rows, interval, load, seed);
    const ProgramResult done = plant.loopscope("import", {"--create-table", "--loop", loop, file});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  Plant plant;
};

/// A window of the flows, 4096 samples of one second, holds three and a half of the level's cycles.
TEST_F(SlowOscillation, FlowsOfOneSecondFollowALevelThatSwingsInTwentyMinutes) {
  const ProgramResult pass = plant.loopscope("once");
  ASSERT_EQ(pass.exit_code, 0) << pass.err;
  EXPECT_EQ(plant.sql("select string_agg(loop_name, ', ' order by loop_name) from "
                      "loopscope.plant_oscillation_member where is_current"),
            "FIC1, FIC2, FIC3, FIC4, LIC1")
      << pass.err;
  EXPECT_THAT(pass.err, HasSubstr("period of 19")) << "minutes";
  EXPECT_EQ(plant.sql("select count(*) from loopscope.latest_verdict where code = 'healthy' and "
                      "follows is not null"),
            "0")
      << "whoever is shaken is not called healthy";
}

}  // namespace
}  // namespace loopscope::tests
