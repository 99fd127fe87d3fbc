#include "core/diagnosis/odds/explaining_away.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/diagnosis/odds/log_odds.hpp"

namespace loopscope::core::diagnosis {
namespace {

/// The other causes of one, were they independent.
std::optional<OthersPart> rivals_of(std::size_t place, std::span<const OwnOdds> all) {
  /// -ln of the probability that none is there; beyond it no double is below 1.
  constexpr double kSurest = 30.0;
  const OwnOdds* first = nullptr;
  double none = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == place || all[k].beside->rival.empty()) continue;
    const double odds = all[k].log_odds;
    none += std::max(odds, 0.0) + std::log1p(std::exp(-std::abs(odds)));
    if (!first || odds > first->log_odds) first = &all[k];
  }
  if (!first) return std::nullopt;
  const double any = std::log(std::expm1(std::min(none, kSurest)));
  return OthersPart{height_at(all[place].beside->rival, any), probability_of(any), first->code};
}

}  // namespace

std::vector<OthersPart> parts_of_others(std::size_t place, std::span<const OwnOdds> all) {
  const ExplainingAway& beside = *all[place].beside;
  if (beside.rival.empty()) return {};
  std::vector<OthersPart> parts;
  if (const auto rivals = rivals_of(place, all)) parts.push_back(*rivals);
  const auto any = std::ranges::find(all, VerdictCode::nonlinear_unexplained, &OwnOdds::code);
  if (any != all.end())
    parts.push_back(
        {height_at(beside.nonlinear, any->log_odds), probability_of(any->log_odds), any->code});
  return parts;
}

double explaining_away(double log_odds, std::size_t place, std::span<const OwnOdds> all) {
  const ExplainingAway& beside = *all[place].beside;
  double result = beside.scale * log_odds + beside.offset;
  for (const OthersPart& part : parts_of_others(place, all)) result += part.weight;
  return result;
}

}  // namespace loopscope::core::diagnosis
