#include "daemon/lab/simulate/parse_numbers.hpp"

#include <charconv>
#include <fmt/format.h>
#include <system_error>

#include "daemon/text/cell_failure.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

/// Times are kept in whole microseconds, and no controller scans less often than once in 11 days.
constexpr double kShortestInterval_s = 1e-6;
constexpr double kLongestInterval_s = 1e6;

}  // namespace

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, seed);
  if (error == std::errc{} && stop == end) return seed;
  throw Failure(ExitCode::usage, fmt::format("--seed {}: not a seed", shown(text)),
                "give a whole number from 0 to 18446744073709551615 (2^64 - 1)");
}

double parse_interval_s(const std::string& text) {
  const double interval_s = parse_number(text).value_or(core::signal::kMissing);
  if (interval_s >= kShortestInterval_s && interval_s <= kLongestInterval_s) return interval_s;
  throw Failure(ExitCode::usage, fmt::format("--interval-s {}: not an interval", shown(text)),
                "give a number of seconds from 1e-6 to 1e6");
}

}  // namespace loopscope::daemon
