#include "core/model/fit/batched/valve_responses.hpp"

#include <gtest/gtest.h>

#include "core/model/response/whitening.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kAnswerSamples = 900;

/// op about its mean, two whitened columns and rows that begin and end anywhere.
struct AnswerSetting {
  tests::Series op = tests::stepping_op(kAnswerSamples, 3);
  tests::Series first = tests::white_noise(kAnswerSamples, 4);
  tests::Series second = tests::white_noise(kAnswerSamples, 5);
  std::vector<Signal> steady{first.data(), second.data()};
  std::vector<Range> rows{{40, 63}, {64, 65}, {130, 301}, {500, 900}};
  AnswerSetting() {
    for (double& value : op) value -= 50.0;
  }
};

/// The same one after the other: law, process, whitening, products.
Eigen::MatrixXd slowly(const AnswerSetting& setting, const Structure& structure,
                       const ValveEffect& valve, const ProcessShape& process) {
  std::vector<tests::Series> taps{setting.op};
  valve.shape_flow(taps[0]);
  respond(process, tests::Series(taps[0]), taps[0]);
  whiten(structure.noise, taps[0], taps[0]);
  if (structure.two_taps) {
    taps.emplace_back(kAnswerSamples);
    put_later(taps[0], taps[1]);
  }
  std::vector<Signal> left;
  for (const tests::Series& tap : taps) left.push_back(tap.data());
  std::vector<Signal> right = setting.steady;
  right.insert(right.end(), left.begin(), left.end());
  return products(left, right, setting.rows);
}

/// Each with its lags, some too slow to move on, some hardly held.
void add_stems(std::vector<ValveEffect>& valves) {
  for (const ValveLaw law : {ValveLaw::kano, ValveLaw::he}) {
    for (int i = 0; i < 19; ++i) {
      const double band = 0.5 + 0.4 * i;
      const double direction = i % 2 == 0 ? 1.0 : -1.0;
      const BetweenSamples between{0.03 + 0.05 * i, 0.03 * (i % 5), 0.002 * (i % 3)};
      valves.emplace_back(Valve{law, band, 0.05 * i * band, direction, between});
    }
    valves.emplace_back(Valve{law, 3.0, 1.0, 1.0, {0.2, 0.1, 0.0}, 1.0});
  }
}

/// More than go side by side, of every law, at the samples and between them, from both directions,
/// some from a place of their own.
std::vector<ValveEffect> answering_valves() {
  std::vector<ValveEffect> result;
  for (const ValveLaw law : {ValveLaw::choudhury, ValveLaw::kano, ValveLaw::he}) {
    for (int i = 0; i < 19; ++i) {
      const double band = 1.0 + 0.4 * i;
      const double direction = i < 9 ? 1.0 : -1.0;
      result.emplace_back(Valve{law, band, 0.05 * i * band, direction});
    }
    result.emplace_back(Valve{law, 3.0, 1.0, 1.0, {}, 2.0});
  }
  add_stems(result);
  return result;
}

std::vector<Structure> structures() {
  std::vector<Structure> result;
  for (const ProcessShape& shape : {tests::one_lag(0.0, 1), tests::one_lag(0.9, 3),
                                    tests::two_lags(0.95, 0.8, 70), tests::integrator(2)}) {
    Structure structure = tests::structure_of(shape);
    structure.noise = {1, {0.9, 0.0, 0.0}, {-0.4, 0.0, 0.0}};
    result.push_back(structure);
    structure.noise = {3, {1.0, 0.7, 0.2}, {-0.6, 0.2, -0.05}};
    structure.two_taps = true;
    result.push_back(structure);
  }
  result.push_back(result.back());
  result.back().process.second_pole = 0.7;
  result.back().noise.order = 2;
  result.back().noise.poles[2] = result.back().noise.zeros[2] = 0.0;
  return result;
}

/// A process for each valve: dead times and poles about the structure's.
std::vector<ProcessShape> processes(const ProcessShape& about, std::size_t count) {
  std::vector<ProcessShape> result(count, about);
  for (std::size_t i = 1; i < count; ++i) {
    const double share = 0.9 + 0.01 * static_cast<double>(i % 10);
    result[i].delay_samples += i % 4;
    if (!about.integrating) result[i].pole *= share;
    result[i].second_pole *= share;
  }
  return result;
}

void expect_the_slow_way(Digits digits, double tolerance) {
  const AnswerSetting setting;
  const std::vector<ValveEffect> all = answering_valves();
  for (const Structure& structure : structures()) {
    const std::vector<ProcessShape> behind = processes(structure.process, all.size());
    std::vector<ValveAndProcess> each;
    for (std::size_t i = 0; i < all.size(); ++i) each.push_back({&all[i], &behind[i]});
    const ValveResponses answers(setting.op, structure, setting.steady, setting.rows);
    const std::vector<Eigen::MatrixXd> found = answers.products(each, digits);
    ASSERT_EQ(found.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Eigen::MatrixXd truth = slowly(setting, structure, all[i], behind[i]);
      ASSERT_EQ(found[i].rows(), truth.rows());
      ASSERT_EQ(found[i].cols(), truth.cols());
      EXPECT_LE((found[i] - truth).norm(), tolerance * truth.norm()) << i;
    }
  }
}

TEST(ValveResponses, AreTheProductsOfOneAfterTheOther) {
  expect_the_slow_way(Digits::full, 1e-10);
}

/// Single precision, but for valves that slip a sample earlier or later where op meets a threshold
/// within its rounding: op here is no such number.
TEST(ValveResponses, OfSingleDigitsAreNearlyThose) {
  expect_the_slow_way(Digits::single, 1e-4);
}

TEST(ValveResponses, OfNoValvesAreNone) {
  const AnswerSetting setting;
  const Structure structure = tests::structure_of(tests::one_lag(0.5, 1));
  EXPECT_TRUE(ValveResponses(setting.op, structure, setting.steady, setting.rows)
                  .products({}, Digits::full)
                  .empty());
}

}  // namespace
}  // namespace loopscope::core::model
