#include "storage/results/writes/loop_windows.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace loopscope::storage {

namespace diagnosis = core::diagnosis;
using diagnosis::PerCause;

PerCause as_stored(PerCause values) {
  constexpr double kLeast = std::numeric_limits<float>::min();
  for (std::optional<double>& value : values) {
    if (value && !std::isfinite(*value)) value.reset();
    if (value)
      value = std::abs(*value) < kLeast ? 0.0 : static_cast<double>(static_cast<float>(*value));
  }
  return values;
}

Combined LoopWindows::next(const diagnosis::JudgedWindow& window, const PerCause& probabilities,
                           const PerCause& priors) {
  if (window.evidence.empty() || !(window.end_s > window.start_s)) return {};
  if (combined_ && window.end_s <= combined_->odds.end_s) return *combined_;
  const auto before = combined_ ? std::optional(combined_->odds) : std::nullopt;
  diagnosis::CombinedOdds odds = diagnosis::combine(before, window);
  odds.evidence = as_stored(std::move(odds.evidence));
  odds.windows = as_stored(std::move(odds.windows));
  PerCause all = diagnosis::stands_alone(before, window)
                     ? probabilities
                     : diagnosis::probabilities_of(odds, priors);
  combined_ = Combined{std::move(odds), std::move(all)};
  return *combined_;
}

}  // namespace loopscope::storage
