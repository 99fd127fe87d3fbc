#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "tests/effects/generator.hpp"
#include "tests/effects/loop_frequency.hpp"
#include "tests/effects/scenario.hpp"

namespace loopscope::tests::effects {

enum class Tuning { normal, robust, firm, tight, sluggish };
enum class Moves { none, sometimes, small, large };

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// What a kind asks of its loop before effects are put in.
struct LoopOptions {
  Tuning tuning = Tuning::normal;
  Moves moves = Moves::sometimes;
  bool may_integrate = true;
  bool only_integrates = false;
  bool load_at_output = false;  ///< where the load could not pass a curve by superposition
  double op_range = 0.0;        ///< % that large moves travel
  double most_tau = 60.0;       ///< samples
  double noise_factor = 1.0;
  Range noise = {0.5, 2.0};   ///< % of span, standard deviation of pv
  Range reach = {3.0, 12.0};  ///< % of span that small moves travel to either side
};

/// Standard deviation of pv in % of span, of flow and pressure transmitters in quiet service.
inline constexpr Range kQuiet = {0.1, 1.0};

/// % of span to either side: changes of grade and of load, where op has room for them. What shows
/// where op travels shows then.
inline constexpr Range kFarMoves = {6.0, 20.0};

/// A loop in the making. Truth speaks in % and samples until the record is made.
struct Draft {
  Scenario base;      ///< without its effects
  Scenario scenario;  ///< with them
  LoopOptions options;
  double noise_std = 0.0;  ///< of pv in `base` with the set point at rest, % of span
  std::vector<TrueEffect> effects;
  /// The loop with one effect alone, of those that have to be explainable.
  std::vector<Scenario> alone;
  /// What has to hold of the record with its effects and of the one without.
  std::vector<std::function<bool(const Series& with, const Series& without)>> conditions;
  /// Parameters that follow from the record, e.g. the curvature over the travelled range.
  std::vector<std::function<void(Draft&, const Series& with)>> measurements;
};

/// A loop without effects: process, tuned controller, load, noise, set point.
[[nodiscard]] Draft draw_loop(const LoopOptions& options, Random& random);

/// Where pv comes to rest when op stands; self-regulating processes and vessels with a loss.
[[nodiscard]] double resting_pv(const Scenario& scenario, double op);

/// Sets `draft.scenario.sp` to moves of the kind; called again by effects that bend the loop.
void draw_moves(Draft& draft, Random& random);

/// Whether pv stays on the span of its transmitter and op away from 0 and 100 % except for a share
/// of the samples of at most `most_at_limit`.
[[nodiscard]] bool stays_in_range(const Scenario& scenario, const Series& series,
                                  double most_at_limit);

/// A draft whose loop is stable, within its limits and shows its effects, and what it records;
/// `attempts` counts the loops that were drawn and thrown away.
struct Finished {
  Draft draft;
  Series series;
  int attempts = 0;
};
[[nodiscard]] Finished finish(std::string_view kind, std::uint64_t seed,
                              Size size = Size::realistic);

}  // namespace loopscope::tests::effects
