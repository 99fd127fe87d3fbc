#include "tests/plants/process/process_plant.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/plants/process/evaporator.hpp"
#include "tests/plants/process/names.hpp"
#include "tests/plants/process/truth.hpp"
#include "tests/plants/process/write_plant_files.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests::process {
namespace {

std::size_t carriers_of(const ProcessPlant& plant) {
  return static_cast<std::size_t>(std::ranges::count_if(plant.loops, &ProcessLoop::carries));
}

/// Mean distance of pv from sp, in % of the span.
double mean_offset(const ProcessLoop& loop) {
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < loop.pv.size(); ++k) {
    if (std::isnan(loop.pv[k])) continue;
    sum += loop.pv[k] - loop.sp[k];
    count += 1.0;
  }
  return 100.0 * std::abs(sum / count) / (loop.high - loop.low);
}

/// What was not recorded is the same too.
bool same_sample(double one, double other) {
  return one == other || (std::isnan(one) && std::isnan(other));
}

class ProcessKinds : public testing::TestWithParam<PlantKind> {};

TEST_P(ProcessKinds, AreCalmWithoutACause) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const ProcessPlant plant = draw_process_plant(GetParam(), Cause::none, seed);
    EXPECT_GE(plant.loops.size(), 6U);
    EXPECT_FALSE(plant.cascades.empty());
    EXPECT_FALSE(plant.source.has_value());
    EXPECT_EQ(plant.period_s, 0.0);
    EXPECT_EQ(carriers_of(plant), 0U);
    EXPECT_LE(plant.drafts, 10U) << "most drafts are calm";
    for (const ProcessLoop& loop : plant.loops)
      EXPECT_LT(mean_offset(loop), 2.0) << loop.name << " of seed " << seed;
  }
}

TEST_P(ProcessKinds, AreShakenByTheirCause) {
  for (const Cause cause : {Cause::sticking_valve, Cause::sawtooth_sensor, Cause::tight_loop}) {
    const ProcessPlant plant = draw_process_plant(GetParam(), cause, 1);
    ASSERT_TRUE(plant.source.has_value()) << name_of(cause);
    const ProcessLoop& source = plant.loops[*plant.source];
    EXPECT_TRUE(source.carries) << name_of(cause);
    EXPECT_GE(carriers_of(plant), 3U) << name_of(cause);
    EXPECT_GE(plant.period_s, 5.0 * source.interval_s);
    EXPECT_GE(source.interval_s * static_cast<double>(source.pv.size()), 12.0 * plant.period_s);
    for (const ProcessLoop& loop : plant.loops) {
      EXPECT_GE(loop.pv.size(), 1400U);
      EXPECT_LE(loop.pv.size(), 4096U);
      EXPECT_TRUE(std::ranges::none_of(loop.op, [](double op) { return op < 0.0 || op > 100.0; }));
    }
  }
}

TEST_P(ProcessKinds, HaveNoSourceWhenTheWaveIsOutside) {
  const ProcessPlant plant = draw_process_plant(GetParam(), Cause::outside_wave, 1);
  EXPECT_FALSE(plant.source.has_value());
  EXPECT_GE(carriers_of(plant), 3U);
  EXPECT_GT(plant.period_s, 0.0);
}

TEST_P(ProcessKinds, AreTheSameForTheSameSeed) {
  const ProcessPlant one = draw_process_plant(GetParam(), Cause::outside_wave, 2);
  const ProcessPlant other = draw_process_plant(GetParam(), Cause::outside_wave, 2);
  ASSERT_EQ(one.loops.size(), other.loops.size());
  EXPECT_EQ(truth_json(one), truth_json(other));
  for (std::size_t i = 0; i < one.loops.size(); ++i)
    EXPECT_TRUE(std::ranges::equal(one.loops[i].op, other.loops[i].op, same_sample));
}

INSTANTIATE_TEST_SUITE_P(All, ProcessKinds, testing::ValuesIn(all_kinds()),
                         [](const auto& kind) { return name_of(kind.param); });

TEST(ProcessPlant, WithoutItsCauseTheWaveIsGone) {
  Random random(4);
  const PlantPlan plan = draft_evaporator(11);
  std::size_t judged = 0;
  for (int attempt = 0; attempt < 40 && judged < 3; ++attempt) {
    const std::optional<Draft> draft = put_cause(plan, Cause::sticking_valve, Valves::any, random);
    ASSERT_TRUE(draft && draft->source);
    const Window window{.samples = 3000, .every = 4};
    const Twins twins{simulate(draft->with, window), simulate(draft->without, window)};
    const std::optional<double> period_s = period_of(*draft, twins);
    if (!period_s) continue;
    ++judged;
    EXPECT_TRUE(swings(twins.with[*draft->source]));
    EXPECT_TRUE(is_calm(twins.without));
  }
  EXPECT_EQ(judged, 3U);
}

TEST(ProcessPlant, DrawsTakeSecondsAtMost) {
  const std::clock_t start = std::clock();
  for (const PlantKind kind : all_kinds())
    for (std::uint64_t seed = 1; seed <= 2; ++seed)
      EXPECT_FALSE(draw_process_plant(kind, Cause::outside_wave, seed).loops.empty());
  const double used_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_LT(used_s, 60.0) << "a second each, and room for sanitizers";
}

TEST(ProcessPlant, IsWrittenAsFilesAndTruth) {
  const ProcessPlant plant = draw_process_plant(PlantKind::column, Cause::outside_wave, 1);
  const TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "plant";
  write_plant_files(plant, folder);
  const auto truth = nlohmann::json::parse(std::ifstream(folder / "truth.json"));
  EXPECT_EQ(truth["kind"], "column");
  EXPECT_TRUE(truth["source"].is_null());
  EXPECT_EQ(truth["loops"].size(), plant.loops.size());
  for (const ProcessLoop& loop : plant.loops) {
    std::ifstream file(folder / (loop.name + ".csv"));
    const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
    EXPECT_EQ(static_cast<std::size_t>(lines), loop.pv.size() + 1) << loop.name;
  }
}

TEST(ProcessPlant, NamesAreFoundAgain) {
  for (const PlantKind kind : all_kinds()) EXPECT_EQ(kind_named(name_of(kind)), kind);
  for (const Cause cause : all_causes()) EXPECT_EQ(cause_named(name_of(cause)), cause);
  EXPECT_THROW((void)kind_named("boiler"), std::invalid_argument);
}

}  // namespace
}  // namespace loopscope::tests::process
