#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace loopscope::tests::process {

enum class PlantKind {
  evaporator,       ///< forced circulation, Newell and Lee (1989)
  reactor_recycle,  ///< reactor, separator and recycle, Luyben (1993)
  column,           ///< binary distillation, Wood and Berry (1973)
  four_tanks,       ///< quadruple tank, Johansson (2000)
};

/// What makes the oscillation.
enum class Cause {
  none,
  sticking_valve,   ///< of the source
  dead_band,        ///< play in the source's valve
  sawtooth_sensor,  ///< the source's sensor drifts and is set right again and again
  tight_loop,       ///< the source's controller
  outside_wave,     ///< in a supply: no loop is the source
};

/// Share of the error's variance from which a loop carries the oscillation.
inline constexpr double kCarryingShare = 0.25;

/// One loop as a historian keeps it, and what is true of it.
struct ProcessLoop {
  std::string name;  ///< "FIC-101"
  std::string type;  ///< "flow", "level", "temperature", "pressure", "composition"
  bool integrating = false;
  double interval_s = 1.0;
  double start_s = 0.0;            ///< of the first sample; one clock for the plant
  std::vector<double> sp, pv, op;  ///< sp and pv in physical units, op in %; NaN = not recorded
  double low = 0.0;                ///< of the sensor's span
  double high = 100.0;
  /// Variance of what the cause changes in sp - pv (against the same plant with the same noise
  /// without it) by the variance of sp - pv, at most 1.
  double share = 0.0;
  double pv_share = 0.0;    ///< the same of pv
  double line_share = 0.0;  ///< of `share` what lies within 15 % of the period and its harmonics
  /// share of at least kCarryingShare, half of that in the lines, at least four samples a period
  /// and eight periods in the record.
  bool carries = false;
};

struct ProcessPlant {
  PlantKind kind = PlantKind::evaporator;
  Cause cause = Cause::none;
  std::vector<ProcessLoop> loops;
  /// Whose valve, sensor or controller it is; of a cascade the loop that moves the valve.
  std::optional<std::size_t> source;
  std::vector<std::pair<std::size_t, std::size_t>> cascades;  ///< master, slave
  double period_s = 0.0;   ///< of the source's or the wave's oscillation; 0 = none
  std::size_t drafts = 0;  ///< that were drawn until one was shaken by its cause
};

/// The same for the same seed. With a cause, a source oscillates (twelve periods, five samples a
/// period at least) and two more loops carry it: drafts in which they do not are thrown away.
/// Throws std::runtime_error when no draft will do.
[[nodiscard]] ProcessPlant draw_process_plant(PlantKind kind, Cause cause, std::uint64_t seed);

}  // namespace loopscope::tests::process
