#include <cstdio>

#include "tests/core/loop/unit_loops.hpp"
#include "tests/support/long_run.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::loop {
namespace {

constexpr std::uint64_t kSeed = 910'000;

void print_row(std::string_view loop, std::string_view setpoint, std::size_t records,
               const signals::UnitShares& shares) {
  std::printf("| %s | %s | %zu | %.4g | %.4g | %.4g | %.4g |\n", std::string(loop).c_str(),
              std::string(setpoint).c_str(), records, shares.far, shares.doubted, shares.shown,
              shares.wrong);
  std::fflush(stdout);
}

void print_unit_head() {
  std::puts("| loop | setpoint | number | not followed | doubted | shown | another unit |");
  std::puts("|---|---|---|---|---|---|---|");
}

LOOPSCOPE_TABLE(unit_match_size, "loops away from their setpoint whose units are said to differ") {
  print_unit_head();
  const std::size_t records = tests::records(5000);
  for (const auto setpoint : signals::kSetpoints)
    for (const auto why : signals::kElsewhere)
      print_row(name(why), name(setpoint), records,
                signals::shares_elsewhere(setpoint, why, records, kSeed));
}

LOOPSCOPE_TABLE(unit_match_power,
                "sound loops with their setpoint in another unit that are found") {
  print_unit_head();
  const std::size_t records = tests::records(500);
  for (const auto setpoint : signals::kSetpoints)
    for (const UnitConversion& conversion : unit_conversions(std::nullopt))
      print_row(conversion.words, name(setpoint), records,
                signals::shares_in_units(setpoint, conversion, records, kSeed));
}

}  // namespace
}  // namespace loopscope::core::loop
