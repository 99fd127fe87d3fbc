#include <array>
#include <cstdio>
#include <string>

#include "tests/core/loop/harris_null.hpp"
#include "tests/core/loop/null_families.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::loop {
namespace {

using signals::mixture;
using signals::p_of;
using signals::Random;
using signals::share_at_null;

template <typename Draw>
void print_sizes(const std::string& name, std::size_t samples, int records, const Draw& draw) {
  constexpr std::array kSizes{0.05, 0.01, 1e-3, 1e-4, 1e-6};
  std::array<int, kSizes.size()> counts{};
  for (int k = 0; k < records; ++k) {
    const double p = p_of(draw(static_cast<std::uint64_t>(k) + 700'000));
    for (std::size_t i = 0; i < kSizes.size(); ++i) counts[i] += p <= kSizes[i] ? 1 : 0;
  }
  std::printf("| %s | %zu | %d |", name.c_str(), samples, records);
  for (const int count : counts) std::printf(" %.4g |", static_cast<double>(count) / records);
  std::puts("");
  std::fflush(stdout);
}

LOOPSCOPE_TABLE(harris_p_size, "shares of well tuned records below each p") {
  std::puts("| records | samples | number | p <= 0.05 | 0.01 | 1e-3 | 1e-4 | 1e-6 |");
  std::puts("|---|---|---|---|---|---|---|---|");
  for (const std::size_t samples : {std::size_t{751}, std::size_t{4096}}) {
    for (const char* scenario :
         {"healthy_flow", "paper_5_1", "paper_5_2_printed", "level_loop", "sluggish_tuning"}) {
      print_sizes(scenario, samples, 5000, [=](std::uint64_t seed) {
        return signals::scenario_error(scenario, samples, seed);
      });
    }
    for (const double phi : {0.9, 0.97, 0.99, 0.999}) {
      const double share = share_at_null(phi);
      const std::string name = "edge of the null, slow part AR(1) " + std::to_string(phi);
      print_sizes(name, samples, 20'000, [=](std::uint64_t seed) {
        Random random(seed);
        return mixture(random, samples, phi, share);
      });
    }
  }
}

}  // namespace
}  // namespace loopscope::core::loop
