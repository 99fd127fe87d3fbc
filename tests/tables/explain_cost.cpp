#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "core/model/explain.hpp"
#include "core/simulate/scenario.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

double explain_ms(const simulate::LoopRecord& record) {
  std::vector<double> error(record.pv.size());
  std::ranges::transform(record.sp, record.pv, error.begin(), std::minus<>());
  const std::clock_t start = std::clock();  // CPU time: the machine may be shared
  static_cast<void>(
      explain({record.pv, record.op, record.sp, error, record.sample_interval_s, true, 1}));
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double quantile(std::vector<double>& values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

LOOPSCOPE_TABLE(explain_cost, "CPU time of every scenario") {
  std::vector<double> all;
  for (const simulate::Scenario& scenario : simulate::all_scenarios()) {
    if (!scenario.is_loop) continue;
    std::vector<double> times;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      times.push_back(explain_ms(simulate::simulate_scenario(scenario.name, {}, seed)));
    }
    all.insert(all.end(), times.begin(), times.end());
    std::printf("| %s | %.0f |\n", std::string(scenario.name).c_str(), quantile(times, 0.5));
  }
  std::printf("all scenarios: median %.0f ms, 90th percentile %.0f ms\n", quantile(all, 0.5),
              quantile(all, 0.9));
}

}  // namespace
}  // namespace loopscope::core::model
