#include <gtest/gtest.h>
#include <vector>

#include "core/model/valve_law/stem_lanes-inl.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

using Series = tests::Series;

constexpr std::size_t kStemSamples = 3000;
constexpr std::size_t kVectors = 2;

/// Steps, rests and a wander: stems rest, slip, move on all along and come to rest on the way.
Series moving_op() {
  const Series wander = tests::coloured_noise({1, {0.97, 0, 0}, {}}, kStemSamples, 7, 0.3);
  return tests::sum(tests::stepping_op(kStemSamples, 6, 4.0), wander);
}

/// Number `i` of some stems of that law: bands, jumps and lags of all sizes.
Valve stem(ValveLaw law, std::size_t i) {
  const auto x = static_cast<double>(i);
  const double band = 0.4 + 0.5 * x;
  Valve valve{
      law,
      band,
      (0.1 + 0.1 * x) * band,
      i % 2 == 0 ? 1.0 : -1.0,
      {0.03 + 0.1 * x, 0.04 * static_cast<double>(i % 5), 0.004 * static_cast<double>(i % 3)}};
  if (i == 1) valve.start_percent = 49.8;
  return valve;
}

/// The places of all lanes, run in stretches of uneven lengths.
template <typename Number, ValveLaw law>
std::vector<Series> side_by_side(const Series& op) {
  using Element = typename ElementOf<Number>::type;
  StemLanes<Number, kVectors> lanes;
  constexpr std::size_t kLanes = kVectors * kElements<Number>;
  for (std::size_t lane = 0; lane < kLanes; ++lane) lanes.put_in(lane, stem(law, lane), op.front());
  const std::vector<Element> seen(op.begin(), op.end());
  std::vector<NumberRow<Number, kVectors>> places(op.size());
  for (std::size_t k = 0; k < op.size();) {
    const std::size_t count = std::min<std::size_t>(1 + k % 7, op.size() - k);
    lanes.template run<law>(std::span(seen).subspan(k, count), &places[k]);
    k += count;
  }
  std::vector<Series> result(kLanes);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (const auto& at : places)
      result[lane].push_back(
          static_cast<double>(at[lane / kElements<Number>][lane % kElements<Number>]));
  }
  return result;
}

Series alone(const Valve& valve, const Series& op) {
  Series mv(op.size());
  run_valve(valve, op, mv);
  return mv;
}

/// Returns how many were compared.
template <ValveLaw law>
std::size_t expect_each_alone() {
  const Series op = moving_op();
  const std::vector<Series> lanes = side_by_side<NumberPair, law>(op);
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    EXPECT_EQ(lanes[lane], alone(stem(law, lane), op)) << lane;
  return lanes.size();
}

TEST(StemLanes, AreEachAloneToTheLastDigit) {
  constexpr std::size_t kLanes = kVectors * kElements<NumberPair>;
  EXPECT_EQ(expect_each_alone<ValveLaw::he>(), kLanes);
  EXPECT_EQ(expect_each_alone<ValveLaw::kano>(), kLanes);
}

/// Returns how many were compared.
template <ValveLaw law>
std::size_t expect_nearly_each_alone() {
  const Series op = moving_op();
  const std::vector<Series> lanes = side_by_side<ShortNumbers, law>(op);
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    const Series mv = alone(stem(law, lane), op);
    std::size_t apart = 0;
    for (std::size_t k = 0; k < op.size(); ++k) apart += std::abs(lanes[lane][k] - mv[k]) > 1e-3;
    EXPECT_LT(apart, op.size() / 50) << lane;
  }
  return lanes.size();
}

/// But where a pressure meets a threshold within their rounding.
TEST(StemLanes, OfFewDigitsAreNearlyThose) {
  constexpr std::size_t kLanes = kVectors * kElements<ShortNumbers>;
  EXPECT_EQ(expect_nearly_each_alone<ValveLaw::he>(), kLanes);
  EXPECT_EQ(expect_nearly_each_alone<ValveLaw::kano>(), kLanes);
}

TEST(StemLanes, RestWhereOpLeavesThem) {
  StemLanes<ShortNumbers, 1> lanes;
  for (std::size_t lane = 0; lane < 4; ++lane)
    lanes.put_in(lane, {ValveLaw::kano, 4.0, 1.0, 1.0, {0.2, 0.1, 0.0}}, 50.0);
  const std::vector<float> op = {50.0F, 50.9F, 46.1F, 50.5F};
  std::vector<NumberRow<ShortNumbers, 1>> places(op.size());
  lanes.run<ValveLaw::kano>(op, places.data());
  for (const auto& at : places) EXPECT_EQ(at[0][3], 48.5F);
}

}  // namespace
}  // namespace loopscope::core::model
