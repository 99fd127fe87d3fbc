#include "tests/effects/kinds.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/effects/realistic.hpp"

namespace loopscope::tests::effects {
namespace {

using Names = std::vector<std::string>;

constexpr LoopOptions kStill{.moves = Moves::none};
constexpr LoopOptions kMoving{.moves = Moves::small};
constexpr LoopOptions kFirm{.tuning = Tuning::firm};
/// A curve inside the loop: loads pass it only where they enter behind it.
constexpr LoopOptions kTravelling{.tuning = Tuning::robust,
                                  .moves = Moves::large,
                                  .may_integrate = false,
                                  .load_at_output = true,
                                  .most_tau = 30.0};
constexpr LoopOptions kWandering{.moves = Moves::none, .may_integrate = false, .noise_factor = 3.0};
constexpr LoopOptions kExcited{.tuning = Tuning::robust, .moves = Moves::small};
constexpr LoopOptions kVessel{
    .moves = Moves::none, .only_integrates = true, .load_at_output = true};

Recipe healthy(const char* name, LoopOptions options, const char* verdict) {
  return {{name, Group::healthy, {}, {verdict}, true}, {options}, {}};
}

Recipe single(const char* name, std::vector<LoopOptions> options, Dress dress, const char* verdict,
              bool hardware_is_wrong = false) {
  return {{name, Group::single, {name}, {verdict}, hardware_is_wrong}, std::move(options), {dress}};
}

Recipe pair(const char* name, LoopOptions options, Dress first, Dress second, Names effects,
            Names verdicts) {
  return {{name, Group::pair, std::move(effects), std::move(verdicts), false},
          {options},
          {first, second}};
}

/// The words that admit ignorance are right for every unknown kind.
Recipe unknown(const char* name, LoopOptions options, Dress dress, Names also_right,
               bool hardware_is_wrong) {
  Names verdicts = {"nonlinear_unexplained", "unexplained"};
  verdicts.insert(verdicts.end(), also_right.begin(), also_right.end());
  return {{name, Group::unknown, {}, std::move(verdicts), hardware_is_wrong}, {options}, {dress}};
}

LoopOptions tuned(Tuning tuning, Moves moves) {
  return {.tuning = tuning, .moves = moves};
}

std::vector<Recipe> healthy_recipes() {
  return {healthy("healthy_still", kStill, "healthy"),
          healthy("healthy_moving", kMoving, "healthy"),
          healthy("tight", tuned(Tuning::tight, Moves::none), "tight_tuning"),
          healthy("tight_moving", tuned(Tuning::tight, Moves::small), "tight_tuning"),
          healthy("sluggish", tuned(Tuning::sluggish, Moves::sometimes), "sluggish_tuning")};
}

std::vector<Recipe> single_recipes() {
  Recipe saturation =
      single("valve_saturation", {kTravelling, kWandering}, add_saturation, "valve_saturation");
  saturation.most_at_limit = 0.2;
  return {single("valve_stiction", {kFirm}, add_stiction, "valve_stiction"),
          single("valve_deadband", {kFirm}, add_deadband, "valve_deadband"),
          saturation,
          single("valve_characteristic", {kTravelling}, add_characteristic, "valve_characteristic"),
          single("process_nonlinearity", {kTravelling}, add_process_nonlinearity,
                 "process_nonlinearity"),
          single("external_oscillation", {{}}, add_oscillation, "external_disturbance", true),
          single("load_step", {{}}, add_load_steps, "external_disturbance", true),
          single("gain_change", {kExcited}, add_gain_change, "process_change"),
          single("sensor_quantisation", {{}}, add_quantisation, "sensor_fault"),
          single("sensor_hold", {{}}, add_hold, "sensor_fault")};
}

std::vector<Recipe> pair_recipes() {
  Recipe saturation =
      pair("saturation_and_load_step", kTravelling, add_saturation, add_load_steps,
           {"valve_saturation", "load_step"}, {"valve_saturation", "external_disturbance"});
  saturation.most_at_limit = 0.2;
  return {
      pair("stiction_and_oscillation", kFirm, add_stiction, add_oscillation,
           {"valve_stiction", "external_oscillation"}, {"valve_stiction", "external_disturbance"}),
      pair("stiction_and_quantisation", kFirm, add_stiction, add_quantisation,
           {"valve_stiction", "sensor_quantisation"}, {"valve_stiction", "sensor_fault"}),
      pair("deadband_and_load_step", kFirm, add_deadband, add_load_steps,
           {"valve_deadband", "load_step"}, {"valve_deadband", "external_disturbance"}),
      pair("characteristic_and_oscillation", kTravelling, add_characteristic, add_oscillation,
           {"valve_characteristic", "external_oscillation"},
           {"valve_characteristic", "external_disturbance"}),
      saturation,
      pair("nonlinearity_and_load_step", kTravelling, add_process_nonlinearity, add_load_steps,
           {"process_nonlinearity", "load_step"}, {"process_nonlinearity", "external_disturbance"}),
      pair("gain_change_and_oscillation", kExcited, add_gain_change, add_oscillation,
           {"gain_change", "external_oscillation"}, {"process_change", "external_disturbance"}),
      pair("hold_and_load_step", {}, add_hold, add_load_steps, {"sensor_hold", "load_step"},
           {"sensor_fault", "external_disturbance"})};
}

/// Beside ignorance, what an engineer would not be misled by is right: a valve that sticks now and
/// then does stick; a bias of the sensor cannot be told from a load at the output.
std::vector<Recipe> unknown_recipes() {
  return {
      unknown("intermittent_stiction", kFirm, add_intermittent_stiction, {"valve_stiction"}, false),
      unknown("hunting_positioner", {}, add_hunting_positioner, {"external_disturbance"}, true),
      unknown("delay_change", kExcited, add_delay_change, {"process_change"}, false),
      unknown("nonlinear_neighbour", {}, add_nonlinear_neighbour, {"external_disturbance"}, true),
      unknown("controller_change", kMoving, add_controller_change,
              {"healthy", "tight_tuning", "sluggish_tuning"}, true),
      unknown("overflow_weir", kVessel, add_overflow_weir, {"process_nonlinearity"}, false),
      unknown("sensor_drift", {}, add_sensor_drift, {"sensor_fault", "external_disturbance"},
              false)};
}

std::vector<Recipe> make_recipes() {
  std::vector<Recipe> all;
  for (const auto& part : {healthy_recipes(), single_recipes(), pair_recipes(), unknown_recipes()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

const std::vector<Recipe>& all_recipes(Size size) {
  static const std::vector<Recipe> faint = make_recipes();
  static const std::vector<Recipe> all_realistic = realistic(faint);
  return size == Size::faint ? faint : all_realistic;
}

const Recipe& recipe_of(std::string_view kind, Size size) {
  const std::vector<Recipe>& all = all_recipes(size);
  const auto found = std::find_if(
      all.begin(), all.end(), [kind](const Recipe& recipe) { return recipe.info.name == kind; });
  if (found == all.end()) throw std::invalid_argument("no kind of record: " + std::string(kind));
  return *found;
}

}  // namespace loopscope::tests::effects
