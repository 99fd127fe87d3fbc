#pragma once

#include <bitset>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace loopscope::core::model {

/// A part of the search that can be left out, so that tests measure what it is worth: the table of
/// tests/effects/leave_one_out. Nobody leaves one out in a plant.
enum class Mechanism {
  cheap_look,     ///< at effects that no residual test asked for
  stem_search,    ///< valves that move between the samples (stiction_search.hpp)
  play_net,       ///< play, and what sticks about it, by its law alone (hysteresis_grid_search.hpp)
  bands_scanned,  ///< bands and jumps about a valve that was found (candidate_fit.cpp)
  hysteresis_by_cycle,     ///< valves that no one-step error shows (apply_limit_cycle_evidence.hpp)
  cycle_score,             ///< the shape of the loop's cycle (limit_cycle_cause.hpp)
  second_period,           ///< the period at which op turns, beside that of most power
  slow_travel,             ///< a few strokes of op (slow_travel.hpp)
  steps_after_moves,       ///< load steps when the loop answers its setpoint
  inverse_controller_fit,  ///< a fit that may be the controller run backwards
  wave_shape,              ///< harmonics of an outside wave, and knots
  exponential_trim,
  root_outflow,
  bends_told_apart,  ///< limit, trim or process on the same rows
  plainer_refuted,   ///< a change of gain against a load at its moment
  fair_comparison,   ///< against the model without the effect, polished anew
  settled_effect,    ///< the process once more with the effect in its place
  multi_step,        ///< what an effect explains further ahead (candidate_fit.hpp)
  share_left,        ///< what the tests that asked for an effect still see (stepwise_model.cpp)
  outdone_skipped,   ///< effects that promise little beside one tried before (selection_round.cpp)
};
inline constexpr std::size_t kMechanisms = 20;

/// The word of the tests' option --without; and back, nullopt for any other.
[[nodiscard]] std::string_view name(Mechanism mechanism);
[[nodiscard]] std::span<const Mechanism> all_mechanisms();
[[nodiscard]] std::optional<Mechanism> mechanism_of(std::string_view name);

struct TestOutcome;

/// What a search goes without; nothing, unless a test says so.
class Without {
 public:
  void leave_out(Mechanism mechanism) { out_.set(static_cast<std::size_t>(mechanism)); }
  [[nodiscard]] bool keeps(Mechanism mechanism) const {
    return !out_.test(static_cast<std::size_t>(mechanism));
  }
  [[nodiscard]] bool any() const { return out_.any(); }
  /// The outcomes of the residual tests are replaced by those of another loop.
  void hear_instead(const std::vector<TestOutcome>& others) { others_ = &others; }
  [[nodiscard]] const std::vector<TestOutcome>* others() const { return others_; }

 private:
  std::bitset<kMechanisms> out_;
  const std::vector<TestOutcome>* others_ = nullptr;
};

}  // namespace loopscope::core::model
