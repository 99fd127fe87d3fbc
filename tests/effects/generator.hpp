#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/effects/noise_family.hpp"

namespace loopscope::tests::effects {

/// %: at an end of the controller's range.
[[nodiscard]] inline bool is_at_limit(double op) {
  return op < 0.01 || op > 99.99;
}
/// Of the samples.
[[nodiscard]] double share_at_limit(std::span<const double> op);
/// The largest of any stretch as long as a record (what is shorter counts as if the rest were
/// free).
[[nodiscard]] double worst_share_at_limit(std::span<const double> op);
/// Largest share of a record's samples with op at a limit; more where the kind says so.
inline constexpr double kMostAtLimit = 0.005;

/// A figure that the effect was made with, in the words and units of the results.
struct TrueParameter {
  std::string
      name;  ///< S, J, width, low, high, curvature, period_s, amplitude, at, size, ratio, ...
  std::string unit;  ///< "%", "pv", "s", "1/h", "" = a ratio
  double value = 0.0;
};

struct TrueEffect {
  std::string effect;  ///< a word of the contract's effects table
  std::vector<TrueParameter> parameters;
  std::string law;  ///< the physical law behind it
};

enum class Group {
  healthy,  ///< no effect: still, moving, tight, sluggish
  single,   ///< one effect of the catalogue
  pair,     ///< two of them
  unknown,  ///< what no effect of the catalogue describes
};

struct KindInfo {
  std::string name;
  Group group = Group::healthy;
  std::vector<std::string> effects;   ///< in the record; empty for healthy and unknown
  std::vector<std::string> verdicts;  ///< each of them is right
  bool hardware_is_wrong = false;     ///< an effect of valve, process or sensor is wrong
};

/// How large the effects are beside load and noise.
enum class Size {
  realistic,  ///< an effect that is spread over the record shows in the one-step error
  faint,      ///< as drawn: many effects are lost in the noise
};

/// Process and controller in the record's units.
struct TrueLoop {
  bool integrating = false;
  double gain = 0.0;  ///< pv per %; integrating: pv per % and second
  double time_constant_s = 0.0;
  double second_time_constant_s = 0.0;  ///< 0 = none
  double delay_s = 0.0;
  double controller_gain = 0.0;  ///< % per pv
  double integral_time_s = 0.0;
  double peak_sensitivity = 0.0;  ///< Ms of the loop without its effects
};

struct Truth {
  KindInfo kind;
  std::vector<TrueEffect> effects;
  TrueLoop loop;
  /// Mean square of the one-step innovations of load and sensor noise (rounding noise and holding
  /// included), everything else known; pv units squared.
  double floor = 0.0;
  double noise_std = 0.0;  ///< of pv in the loop without effects, set point at rest, pv units
  /// What the effects add to the one-step error of the best linear model, by the floor.
  double explainable = 0.0;
};

/// A recording of 4096 samples; op and mv in %.
struct Record {
  double interval_s = 1.0;
  std::vector<double> sp;
  std::vector<double> pv;
  std::vector<double> op;
  std::vector<double> mv;  ///< hidden from the diagnosis
  Truth truth;
};

/// In the order of the report.
[[nodiscard]] const std::vector<KindInfo>& all_kinds();

/// `noise` other than Gaussian is put into a loop that was drawn with Gaussian noise; whether its
/// effects show in it is not asked again, and error_floor is that of Gaussian noise.
///
/// The same record for the same kind, seed, size and noise on every machine of one floating-point
/// behaviour. Throws std::invalid_argument for an unknown kind.
[[nodiscard]] Record generate(std::string_view kind, std::uint64_t seed,
                              Size size = Size::realistic,
                              NoiseFamily noise = NoiseFamily::gaussian);

/// The same loop with the same effects and set point over another stretch of time: load and noise
/// are drawn anew for each `stretch`, 0 = the record of generate(). Whether the effects show in it
/// is not asked.
[[nodiscard]] Record generate_stretch(std::string_view kind, std::uint64_t seed,
                                      std::uint64_t stretch);

/// The loop of generate() over a longer time: `before` samples without its effects, then `behind`
/// with them, as from one sample to the next (simulate_onset). The set point repeats its course,
/// load and noise are drawn anew. `truth` is that of generate(), without what is explainable.
[[nodiscard]] Record generate_onset(std::string_view kind, std::uint64_t seed, std::size_t before,
                                    std::size_t behind);

}  // namespace loopscope::tests::effects
