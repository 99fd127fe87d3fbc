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
/// Of what op usually stays at a value: two equal samples come by rounding at every turn of op, and
/// an op in whole percent turns for twice as long as it passes.
constexpr double kLongerThanUsual = 3.0;
constexpr double kFewestVisits = 2.0;
/// Fewer stays away from the ends are no habit: an on-off output that was held once.
constexpr double kFewestStays = 10.0;

/// Consecutive samples within `near` of the first of them.
struct Stay {
  double value = 0.0;
  double samples = 0.0;
};

std::vector<Stay> stays_of(const std::vector<double>& values, double near) {
  std::vector<Stay> stays;
  for (const double value : values) {
    if (stays.empty() || std::abs(value - stays.back().value) > near) stays.push_back({value, 0.0});
    stays.back().samples += 1.0;
  }
  return stays;
}

struct EndRests {
  double samples = 0.0;
  double visits = 0.0;
};

/// Of the stays where `at_end` holds those that are longer than usual.
template <typename AtEnd>
EndRests rests_at(const std::vector<Stay>& stays, double shortest, AtEnd at_end) {
  EndRests rests;
  for (const Stay& stay : stays) {
    if (!at_end(stay.value) || stay.samples < shortest) continue;
    rests.samples += stay.samples;
    rests.visits += 1.0;
  }
  return rests;
}

/// Mean length of the stays where `at_end` does not hold; 1 where there are few.
template <typename AtEnd>
double usual_stay(const std::vector<Stay>& stays, AtEnd at_end) {
  double samples = 0.0, count = 0.0;
  for (const Stay& stay : stays) {
    if (at_end(stay.value)) continue;
    samples += stay.samples;
    count += 1.0;
  }
  return count < kFewestStays ? 1.0 : samples / count;
}

}  // namespace

std::optional<OpRest> measure_op_rest(std::span<const double> op) {
  std::vector<double> recorded;
  std::ranges::copy_if(op, std::back_inserter(recorded), [](double v) { return std::isfinite(v); });
  if (recorded.size() < kFewestForRests) return std::nullopt;
  const auto ends = std::ranges::minmax(recorded);
  const double near = kNear * (ends.max - ends.min);
  if (!(near > 0.0)) return std::nullopt;
  const auto at_bottom = [&](double value) { return value <= ends.min + near; };
  const auto at_top = [&](double value) { return value >= ends.max - near; };
  const std::vector<Stay> stays = stays_of(recorded, near);
  const double usual =
      usual_stay(stays, [&](double value) { return at_bottom(value) || at_top(value); });
  const double shortest = std::round(kLongerThanUsual * usual);
  const EndRests below = rests_at(stays, shortest, at_bottom);
  const EndRests above = rests_at(stays, shortest, at_top);
  double resting = 0.0;
  for (const EndRests& rests : {below, above})
    if (rests.visits >= kFewestVisits) resting += rests.samples;
  return OpRest{resting / static_cast<double>(recorded.size()),
                std::max(below.visits, above.visits)};
}

}  // namespace loopscope::core::loop
