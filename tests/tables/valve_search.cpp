#include "core/model/valve_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <vector>

#include "core/simulate/scenario.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::uint64_t kSeeds = 50;

struct Row {
  std::string_view scenario;
  double band, jump;
  std::string_view law;
};
constexpr std::array<Row, 7> kRows = {{{"paper_5_4", 3.0, 1.0, "choudhury"},
                                       {"paper_5_4_kano", 3.0, 1.0, "kano"},
                                       {"sticking_valve", 5.0, 2.0, "kano"},
                                       {"square_limit_cycle", 4.0, 4.0, "kano"},
                                       {"sticking_level", 4.0, 2.0, "kano"},
                                       {"deadband", 4.0, 0.0, ""},
                                       {"oversized_valve", 0.3, 0.2, "kano"}}};

struct Counts {
  int band = 0, jump = 0, law = 0, band_listed = 0, both_listed = 0, play = 0;
  std::vector<double> band_error;
};

bool right_band(const Row& row, const Valve& valve) {
  return std::abs(valve.stickband_percent / row.band - 1.0) < 0.1;
}

/// J within 10 % of S: a share of J would mean nothing for a small one.
bool right_jump(const Row& row, const Valve& valve) {
  return std::abs(valve.slip_jump_percent - row.jump) < 0.1 * row.band;
}

void count(const Row& row, const ValveSearchResult& result, Counts& counts) {
  const auto listed = [&](auto&& wanted) {
    return std::ranges::any_of(result.candidates, wanted) ? 1 : 0;
  };
  counts.band_listed += listed([&](const auto& c) { return right_band(row, c.valve); });
  counts.both_listed +=
      listed([&](const auto& c) { return right_band(row, c.valve) && right_jump(row, c.valve); });
  counts.play += result.deadband && right_band(row, result.deadband->valve) ? 1 : 0;
  if (!result.candidates.empty()) {
    const Valve& best = result.candidates[0].valve;
    counts.band += right_band(row, best) ? 1 : 0;
    counts.jump += right_jump(row, best) ? 1 : 0;
    counts.law += name(best.law) == row.law ? 1 : 0;
    counts.band_error.push_back(std::abs(best.stickband_percent / row.band - 1.0));
  }
}

void print_row(const Row& row, double op_step) {
  Counts counts;
  std::clock_t spent = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    simulate::LoopRecord record = simulate::simulate_scenario(row.scenario, {}, seed);
    for (double& op : record.op) {
      op = op_step > 0.0 ? op_step * std::round(op / op_step) : op;
    }
    const std::vector<std::uint8_t> fit(record.pv.size(), 1);
    const std::clock_t start = std::clock();
    const ValveSearchResult result = search_valve({record.pv, record.op, fit});
    spent += std::clock() - start;
    count(row, result, counts);
  }
  std::ranges::sort(counts.band_error);
  std::printf("| %.*s | %d | %d | %d | %d | %d | %d | %.3f | %.0f |\n",
              static_cast<int>(row.scenario.size()), row.scenario.data(), counts.band, counts.jump,
              counts.law, counts.band_listed, counts.both_listed, counts.play,
              counts.band_error.empty() ? 1.0 : counts.band_error[counts.band_error.size() / 2],
              1e3 * static_cast<double>(spent) / CLOCKS_PER_SEC / static_cast<double>(kSeeds));
}

LOOPSCOPE_TABLE(valve_search, "bands, jumps and laws found in 50 records of each scenario") {
  for (const double op_step : {0.0, 0.1}) {
    std::printf("op rounded to %g\n", op_step);
    for (const Row& row : kRows) {
      print_row(row, op_step);
    }
  }
}

}  // namespace
}  // namespace loopscope::core::model
