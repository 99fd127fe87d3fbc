#include "tests/verdict/known_generators.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "core/diagnosis/effect_verdict.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/results/explanation.hpp"
#include "tests/core/model/field_families.hpp"
#include "tests/effects/generator.hpp"
#include "tests/effects/random.hpp"

namespace loopscope::tests::verdict {
namespace {

using Code = core::diagnosis::VerdictCode;
using Codes = std::set<Code>;

struct NamedTruth {
  std::string_view name;
  Codes causes;
  Codes doubtful = {};
};

/// Kinds without an effect of the catalogue.
const std::vector<NamedTruth>& kinds_without_effect() {
  static const std::vector<NamedTruth> kinds = {
      {"healthy_still", {}},
      {"healthy_moving", {}},
      {"tight", {Code::tight_tuning}},
      {"tight_moving", {Code::tight_tuning}},
      {"sluggish", {Code::sluggish_tuning}},
      {"intermittent_stiction", {Code::valve_stiction}},
      {"hunting_positioner", {Code::external_disturbance}, {Code::valve_stiction}},
      {"delay_change", {Code::process_change}},
      {"nonlinear_neighbour", {Code::external_disturbance}},
      {"controller_change", {}, {Code::process_change, Code::tight_tuning, Code::sluggish_tuning}},
      {"overflow_weir", {Code::process_nonlinearity}},
      {"sensor_drift", {}, {Code::sensor_fault, Code::external_disturbance}}};
  return kinds;
}

/// Families of recordings; those that are not named stick and do nothing else.
const std::vector<NamedTruth>& families() {
  static const std::vector<NamedTruth> all = {
      {"stiction_disturbed", {Code::valve_stiction, Code::external_disturbance}},
      {"stiction_coarse", {Code::valve_stiction}, {Code::sensor_fault}},
      {"stiction_cascade", {Code::valve_stiction}, {Code::external_disturbance}},
      {"stiction_complicated_flow", {Code::valve_stiction}, {Code::valve_characteristic}},
      {"stiction_complicated_level", {Code::valve_stiction}, {Code::valve_characteristic}},
      {"stiction_complicated_heat", {Code::valve_stiction}, {Code::valve_characteristic}},
      {"tight_flow", {Code::tight_tuning}},
      {"tight_level", {Code::tight_tuning}},
      {"tight_temperature", {Code::tight_tuning}},
      {"tight_concentration", {Code::tight_tuning}},
      {"complicated_tight", {Code::tight_tuning}, {Code::valve_characteristic}},
      {"saturated", {Code::valve_saturation, Code::tight_tuning}},
      {"one_sided_limit", {Code::valve_saturation, Code::tight_tuning}},
      {"analyser_dead_zone", {Code::sensor_fault}, {Code::tight_tuning}},
      {"quantised", {Code::sensor_fault}},
      {"faulty_sensor", {Code::sensor_fault}},
      {"coarse_wave", {Code::external_disturbance}, {Code::sensor_fault}},
      {"wandering_flow", {}},
      {"wandering_level", {}},
      {"setpoint_steps", {}},
      {"cascade_slave", {}, {Code::external_disturbance}},
      {"sluggish_sine", {Code::external_disturbance}, {Code::sluggish_tuning}},
      {"proportional_level", {Code::external_disturbance}, {Code::sluggish_tuning}},
      {"complicated_wave", {Code::external_disturbance}, {Code::valve_characteristic}},
      {"play_and_wave", {Code::valve_deadband, Code::external_disturbance}},
      {"play_and_load", {Code::valve_deadband}},
      {"play_and_moves", {Code::valve_deadband}}};
  return all;
}

const NamedTruth* find(const std::vector<NamedTruth>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &NamedTruth::name);
  return found == all.end() ? nullptr : &*found;
}

Code verdict_of_word(std::string_view word) {
  for (const core::model::EffectKind kind : core::model::all_effect_kinds()) {
    if (core::model::name(kind) == word) return core::diagnosis::verdict_of(kind);
  }
  throw std::invalid_argument("no effect of the catalogue: " + std::string(word));
}

Truth truth_of(const effects::KindInfo& kind) {
  Truth truth{.causes = {}, .doubtful = {}, .family = "effects." + kind.name};
  if (const NamedTruth* known = find(kinds_without_effect(), kind.name)) {
    truth.causes = known->causes;
    truth.doubtful = known->doubtful;
  }
  for (const std::string& effect : kind.effects) truth.causes.insert(verdict_of_word(effect));
  return truth;
}

Truth truth_of(const model::FieldFamily& family) {
  Truth truth{.causes = {}, .doubtful = {}, .family = "field." + std::string(family.name)};
  if (const NamedTruth* known = find(families(), family.name)) {
    truth.causes = known->causes;
    truth.doubtful = known->doubtful;
  } else {
    truth.causes = {family.sticks ? Code::valve_stiction : Code::external_disturbance};
  }
  return truth;
}

effects::NoiseFamily draw_noise(effects::Random& random) {
  constexpr double kGaussian = 0.7;
  if (random.chance(kGaussian)) return effects::NoiseFamily::gaussian;
  constexpr std::array kOthers = {effects::NoiseFamily::t5, effects::NoiseFamily::bursts,
                                  effects::NoiseFamily::garch};
  return kOthers.at(static_cast<std::size_t>(random.whole(0, 2)));
}

}  // namespace

SimulatedLoop effects_loop(std::uint64_t seed) {
  effects::Random random(effects::seed_for("verdict kind", seed));
  const auto& kinds = effects::all_kinds();
  const auto last = static_cast<int>(kinds.size()) - 1;
  // Two of thirty kinds are healthy loops: plants have more of them.
  constexpr double kHealthy = 0.15;
  const int place = random.chance(kHealthy) ? random.whole(0, 1) : random.whole(0, last);
  const effects::KindInfo& kind = kinds[static_cast<std::size_t>(place)];
  constexpr double kFaint = 0.3;
  const effects::Size size =
      random.chance(kFaint) ? effects::Size::faint : effects::Size::realistic;
  effects::Record record = effects::generate(kind.name, seed, size, draw_noise(random));
  const bool integrating = record.truth.loop.integrating;
  const double interval_s = record.interval_s;
  SimulatedLoop loop = loop_of(std::move(record), integrating, truth_of(kind));
  loop.interval_s = interval_s;
  return loop;
}

SimulatedLoop family_loop(std::uint64_t seed) {
  const auto all = model::field_families();
  const model::FieldFamily& family = all[seed % all.size()];
  // A family's own seeds end at 100 000, and its tests use those from 80 000 on.
  constexpr std::uint64_t kOwnSeeds = 79'000;
  model::FieldLoop record = record_of(family, seed / all.size() % kOwnSeeds);
  return loop_of(std::move(record), is_level(family), truth_of(family));
}

}  // namespace loopscope::tests::verdict
