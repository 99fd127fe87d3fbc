#include "core/loop/op_rest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace loopscope::core::loop {
namespace {

constexpr std::size_t kFewestForRests = 32;
constexpr double kNear = 1e-3;  ///< of the span
/// Two equal samples come by rounding at every turn of op.
constexpr std::size_t kShortestRun = 3;
constexpr std::size_t kFewestVisits = 2;

struct Runs {
  std::size_t samples = 0;
  std::size_t count = 0;
};

template <typename AtEnd>
Runs runs_where(const std::vector<double>& values, AtEnd at_end) {
  Runs runs;
  std::size_t length = 0;
  const auto close = [&] {
    if (length >= kShortestRun) {
      runs.samples += length;
      ++runs.count;
    }
    length = 0;
  };
  for (const double value : values) {
    if (at_end(value))
      ++length;
    else
      close();
  }
  close();
  return runs;
}

}  // namespace

std::optional<OpRest> measure_op_rest(std::span<const double> op) {
  std::vector<double> recorded;
  std::ranges::copy_if(op, std::back_inserter(recorded), [](double v) { return std::isfinite(v); });
  if (recorded.size() < kFewestForRests) return std::nullopt;
  const auto ends = std::ranges::minmax(recorded);
  const double near = kNear * (ends.max - ends.min);
  if (!(near > 0.0)) return std::nullopt;
  const Runs below = runs_where(recorded, [&](double v) { return v <= ends.min + near; });
  const Runs above = runs_where(recorded, [&](double v) { return v >= ends.max - near; });
  std::size_t resting = 0;
  for (const Runs& runs : {below, above}) resting += runs.count >= kFewestVisits ? runs.samples : 0;
  return OpRest{static_cast<double>(resting) / static_cast<double>(recorded.size()),
                static_cast<double>(std::max(below.count, above.count))};
}

}  // namespace loopscope::core::loop
