#include "core/model/results/mechanism.hpp"

#include <algorithm>
#include <array>

namespace loopscope::core::model {
namespace {

struct NamedMechanism {
  Mechanism mechanism;
  std::string_view name;
};

constexpr std::array<NamedMechanism, kMechanisms> kMechanismNames = {{
    {Mechanism::cheap_look, "cheap_look"},
    {Mechanism::stem_search, "stem_search"},
    {Mechanism::play_net, "play_net"},
    {Mechanism::bands_scanned, "bands_scanned"},
    {Mechanism::hysteresis_by_cycle, "hysteresis_by_cycle"},
    {Mechanism::cycle_score, "cycle_score"},
    {Mechanism::second_period, "second_period"},
    {Mechanism::slow_travel, "slow_travel"},
    {Mechanism::steps_after_moves, "steps_after_moves"},
    {Mechanism::inverse_controller_fit, "inverse_controller_fit"},
    {Mechanism::wave_shape, "wave_shape"},
    {Mechanism::exponential_trim, "exponential_trim"},
    {Mechanism::root_outflow, "root_outflow"},
    {Mechanism::bends_told_apart, "bends_told_apart"},
    {Mechanism::plainer_refuted, "plainer_refuted"},
    {Mechanism::fair_comparison, "fair_comparison"},
    {Mechanism::settled_effect, "settled_effect"},
    {Mechanism::multi_step, "multi_step"},
    {Mechanism::share_left, "share_left"},
    {Mechanism::outdone_skipped, "outdone_skipped"},
}};

constexpr std::array<Mechanism, kMechanisms> kAllMechanisms = [] {
  std::array<Mechanism, kMechanisms> all{};
  std::ranges::transform(kMechanismNames, all.begin(), &NamedMechanism::mechanism);
  return all;
}();

}  // namespace

std::string_view name(Mechanism mechanism) {
  return std::ranges::find(kMechanismNames, mechanism, &NamedMechanism::mechanism)->name;
}

std::span<const Mechanism> all_mechanisms() {
  return kAllMechanisms;
}

std::optional<Mechanism> mechanism_of(std::string_view name) {
  const auto at = std::ranges::find(kMechanismNames, name, &NamedMechanism::name);
  return at == kMechanismNames.end() ? std::nullopt : std::optional(at->mechanism);
}

}  // namespace loopscope::core::model
