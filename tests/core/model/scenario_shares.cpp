#include "tests/core/model/scenario_shares.hpp"

#include <algorithm>
#include <cstdio>

#include "core/model/effects/effect_catalogue.hpp"
#include "tests/core/model/model_records.hpp"

namespace loopscope::core::model::tests {
namespace {

using enum EffectKind;

bool right_first(const Explanation& explanation, const std::vector<EffectKind>& right) {
  return !explanation.steps.empty() &&
         std::ranges::find(right, explanation.steps.front().effect) != right.end();
}

}  // namespace

Shares shares_of(std::string_view scenario, const std::vector<EffectKind>& right,
                 std::size_t records) {
  Shares shares;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + records; ++seed) {
    const auto explanation = explain_scenario(scenario, seed);
    if (!explanation) continue;
    shares.right += right_first(*explanation, right);
    shares.claims += claims_hardware(*explanation);
    ++shares
          .first[explanation->steps.empty() ? "none"
                                            : std::string(name(explanation->steps.front().effect))];
  }
  return shares;
}

void print(std::string_view scenario, const Shares& shares) {
  std::printf("| %s | right %d | valve, process or sensor %d |", std::string(scenario).c_str(),
              shares.right, shares.claims);
  for (const auto& [effect, count] : shares.first) std::printf(" %s %d", effect.c_str(), count);
  std::printf(" |\n");
}

void PrintTo(const Faulty& faulty, std::ostream* stream) {
  *stream << faulty.scenario;
}

const std::vector<Faulty>& faulty_scenarios() {
  static const std::vector<Faulty> list = {{"paper_5_3", {external_oscillation}},
                                           {"paper_5_4", {valve_stiction}},
                                           {"paper_5_4_kano", {valve_stiction}},
                                           {"load_upsets", {load_step}},
                                           {"process_gain_change", {gain_change}},
                                           {"worn_valve", {valve_characteristic}},
                                           {"nonlinear_process", {process_nonlinearity}},
                                           {"saturated_valve", {valve_saturation}},
                                           {"quantised_sensor", {sensor_quantisation}},
                                           {"holding_sensor", {sensor_hold}},
                                           {"sticking_valve", {valve_stiction}},
                                           {"sticking_level", {valve_stiction}},
                                           {"deadband", {valve_deadband}},
                                           {"square_limit_cycle", {valve_stiction}},
                                           {"outside_oscillation", {external_oscillation}}};
  return list;
}

}  // namespace loopscope::core::model::tests
