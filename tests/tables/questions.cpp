#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>

#include "core/model/residual_tests/run_residual_tests.hpp"
#include "core/model/residual_tests/tests/coupling.hpp"
#include "tests/core/model/residual_tests/pass_rates.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

using tests::count;
using tests::kLevels;
using tests::kWhites;
using tests::PassRates;
using tests::powers;
using tests::Questionable;
using tests::Series;
using tests::sizes;
using tests::White;

void print(const std::string& title, const PassRates& rates, std::size_t level) {
  std::printf("%-24s", title.c_str());
  for (const auto& [question, counts] : rates)
    std::printf(" %s %.1f", question.c_str(), 100.0 * counts.passed[level] / counts.asked);
  std::printf("\n");
}

LOOPSCOPE_TABLE(question_sizes, "how often each question accuses a right model") {
  for (const std::size_t samples : {std::size_t{750}, std::size_t{4096}, std::size_t{16000}})
    for (const White kind : kWhites) {
      const PassRates rates = sizes(kind, samples, samples == 16000 ? 400 : 1000);
      for (std::size_t level = 0; level < kLevels.size(); ++level)
        print(std::to_string(samples) + " " + std::string(tests::name(kind)) + " at " +
                  std::to_string(kLevels[level]),
              rates, level);
    }
}

LOOPSCOPE_TABLE(question_events, "the same in Laplacian GARCH noise") {
  for (const std::size_t samples : {std::size_t{4096}, std::size_t{16000}}) {
    PassRates rates;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
      const Series r = tests::white(White::garch_laplace, samples, seed);
      count(test_residual(tests::closed_loop(r, seed).view()), rates);
    }
    print(std::to_string(samples), rates, 0);
  }
}

LOOPSCOPE_TABLE(question_coupling_sizes, "the same with the questions of coupling") {
  for (const std::size_t samples : {std::size_t{750}, std::size_t{4096}})
    for (const White kind : kWhites) {
      PassRates rates;
      for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Questionable loop = tests::closed_loop(tests::white(kind, samples, 131 * seed), seed);
        count(test_coupling(loop.view().innovation, seed), rates);
      }
      print(std::to_string(samples) + " " + std::string(tests::name(kind)), rates, 0);
    }
}

LOOPSCOPE_TABLE(question_cost, "milliseconds of a round") {
  const Questionable loop = tests::closed_loop(tests::white(White::gaussian, 4096, 5), 5);
  double least_ms = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 20; ++round) {
    const std::clock_t begin = std::clock();
    for (int k = 0; k < 20; ++k) (void)test_residual(loop.view());
    least_ms = std::min(least_ms, 1e3 / 20.0 * double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::printf("test_residual, 4096 samples: %.2f ms\n", least_ms);
}

LOOPSCOPE_TABLE(question_powers, "how often each question sees each scenario") {
  for (const char* scenario : {"healthy_flow",        "paper_5_1",      "paper_5_2_printed",
                               "paper_5_2_excessive", "level_loop",     "tight_tuning",
                               "sluggish_tuning",     "paper_5_3",      "outside_oscillation",
                               "paper_5_4",           "paper_5_4_kano", "sticking_valve",
                               "square_limit_cycle",  "sticking_level", "deadband",
                               "saturated_valve",     "worn_valve",     "nonlinear_process",
                               "process_gain_change", "load_upsets",    "quantised_sensor",
                               "holding_sensor",      "oversized_valve"})
    print(scenario, powers(scenario, 100), 1);
}

}  // namespace
}  // namespace loopscope::core::model
