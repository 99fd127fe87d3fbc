#include "core/repair/standing_fault.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace loopscope::core::repair {
namespace {

/// The windows of one side that name a family, either surely enough or not.
struct Named {
  double confidence = 0.0;  ///< their sum
  std::size_t windows = 0;
  std::map<std::string, std::size_t> codes;
};

/// False sorts first: families of which a verdict is sure enough go before mere suspicions.
using Families = std::map<std::pair<bool, std::string>, Named>;

Families families_of(std::span<const RepairWindow> windows, double min_confidence) {
  Families families;
  for (const RepairWindow& window : windows) {
    if (window.family.empty()) continue;
    Named& named = families[{window.confidence < min_confidence, window.family}];
    named.confidence += window.confidence;
    ++named.windows;
    ++named.codes[window.code];
  }
  return families;
}

/// Surely named before suspected, then by confidence, then by name.
std::optional<StandingFault> leading(const Families& families) {
  if (families.empty()) return std::nullopt;
  const auto& [key, named] =
      *std::ranges::min_element(families, {}, [](const Families::value_type& entry) {
        return std::tuple(entry.first.first, -entry.second.confidence, entry.first.second);
      });
  const auto code =
      std::ranges::max_element(named.codes, {}, &decltype(named.codes)::value_type::second);
  return StandingFault{code->first, key.second, names_hardware(key.second), named.windows,
                       named.confidence / static_cast<double>(named.windows)};
}

/// Confidence for a fault less what speaks against one.
double blame(std::span<const RepairWindow> windows, double min_confidence) {
  double sum = 0.0;
  for (const RepairWindow& window : windows) {
    const bool fault = !window.family.empty() && window.confidence >= min_confidence;
    sum += fault ? window.confidence : -window.confidence;
  }
  return sum;
}

}  // namespace

bool names_hardware(std::string_view family) {
  constexpr std::array<std::string_view, 4> kHardware = {"friction", "limit", "sensor", "curve"};
  return std::ranges::find(kHardware, family) != kHardware.end();
}

std::size_t windows_naming(std::span<const RepairWindow> windows, std::string_view family,
                           double min_confidence) {
  return static_cast<std::size_t>(std::ranges::count_if(windows, [&](const RepairWindow& window) {
    return window.family == family && window.confidence >= min_confidence;
  }));
}

SideVerdict side_verdict(std::span<const RepairWindow> windows, double min_confidence) {
  const std::optional<StandingFault> fault = leading(families_of(windows, min_confidence));
  if (!fault) return {};
  if (blame(windows, min_confidence) >= 0.0) return {fault, {}};
  // "unknown" suspects nothing in particular.
  return {std::nullopt, fault->family == "unknown" ? std::string() : fault->code};
}

}  // namespace loopscope::core::repair
