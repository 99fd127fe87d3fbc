#include <array>
#include <cstdio>
#include <string>

#include "core/loop/oscillation.hpp"
#include "tests/core/loop/null_families.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::loop {
namespace {

using signals::Family;

void print_sizes(const Family& family, std::size_t samples, int records) {
  constexpr std::array kSizes{0.05, 0.01, 1e-3, 1e-4, 1e-5};
  std::array<int, kSizes.size()> counts{};
  for (int k = 0; k < records; ++k) {
    const auto series = family.draw(samples, 700'000 + static_cast<std::uint64_t>(k));
    const double p = find_oscillation(series, 1.0).p.value();
    for (std::size_t i = 0; i < kSizes.size(); ++i) counts[i] += p <= kSizes[i] ? 1 : 0;
  }
  std::printf("| %s | %zu | %d |", std::string(family.name).c_str(), samples, records);
  for (const int count : counts) std::printf(" %.4g |", static_cast<double>(count) / records);
  std::puts("");
  std::fflush(stdout);
}

void print_head() {
  std::puts("| records | samples | number | p <= 0.05 | 0.01 | 1e-3 | 1e-4 | 1e-5 |");
  std::puts("|---|---|---|---|---|---|---|---|");
}

LOOPSCOPE_TABLE(oscillation_p_size, "shares of quiet and damped records below each p") {
  print_head();
  for (const std::size_t samples : {std::size_t{751}, std::size_t{4096}}) {
    for (const Family& family : signals::quiet_families()) print_sizes(family, samples, 20'000);
  }
  for (const Family& family : signals::damped_families()) {
    for (const std::size_t samples : {std::size_t{751}, std::size_t{4096}})
      print_sizes(family, samples, 2000);
  }
}

LOOPSCOPE_TABLE(oscillation_p_power, "shares of oscillating records below each p") {
  print_head();
  for (const Family& family : signals::oscillating_families()) {
    for (const std::size_t samples : {std::size_t{751}, std::size_t{4096}})
      print_sizes(family, samples, 500);
  }
}

}  // namespace
}  // namespace loopscope::core::loop
