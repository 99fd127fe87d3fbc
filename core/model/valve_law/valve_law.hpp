#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/model/vectors/eight_numbers.hpp"

namespace loopscope::core::model {

/// How a valve that sticks and jumps follows its controller output. Band S and jump J in % of op,
/// 0 <= J <= S; with fd = (S - J) / 2 every law of op at the samples moves as mv = op - d fd, d the
/// direction of motion, and with J = 0 `kano` and `he` are the play of a linkage of full width S.
enum class ValveLaw {
  choudhury,  ///< printed flow chart: rests until |op - op at its last turn| > S
  kano,  ///< Kano et al. 2004: rests when op turns or stands still; until op is J ahead or S back
  he,    ///< He et al. 2007: rests at every sample; until |op - mv| > (S + J) / 2
};
[[nodiscard]] std::string_view name(ValveLaw law);

/// What pressure and stem do while op is held (valve_between_samples.hpp). Laws `he` and `kano`
/// only.
struct BetweenSamples {
  double actuator_lag_samples = 0.0;  ///< time constant of the pressure; 0 = acts at the samples
  double stem_lag_samples = 0.0;      ///< `kano`: with which a moving stem follows it
  double resting_speed = 0.0;         ///< `kano`: slower stems come to rest; bands S per sample
};

/// The valve and where it comes from: at the first op it has just stopped after moving in the
/// direction +1 (up) or -1 (down), so mv = op - direction (S - J) / 2, unless it stands elsewhere.
/// A recording does not say which; a caller that does not know tries both.
struct Valve {
  ValveLaw law = ValveLaw::kano;
  double stickband_percent = 0.0;  ///< S, deadband plus stickband
  double slip_jump_percent = 0.0;  ///< J, 0 to S
  double start_direction = 1.0;    ///< +1 or -1
  BetweenSamples between{};
  std::optional<double> start_percent{};  ///< where it stands before the first op
  [[nodiscard]] bool acts_at_samples() const { return between.actuator_lag_samples <= 0.0; }
};

/// mv(k), % of op, for op(k), %: equal lengths, any number of samples. Where op is NaN the valve
/// stands where it is; NaN before the first op. Bit for bit the same on every processor.
/// Throws std::invalid_argument unless 0 <= J <= S and the lengths are equal.
void run_valve(const Valve& valve, std::span<const double> op, std::span<double> mv);

/// The same, spelled out.
inline void run_valve(ValveLaw law, double stickband_percent, double slip_jump_percent,
                      double start_direction, std::span<const double> op, std::span<double> mv) {
  run_valve({law, stickband_percent, slip_jump_percent, start_direction, {}}, op, mv);
}

/// The same of one to eight valves of one law that act at the samples, side by side: mv(k)[i] is
/// where valves[i] stands. The first four share their direction at the start, and so do the others,
/// or the law is `he`, which asks for none. mv beyond the last valve means nothing.
void run_valves(std::span<const Valve> valves, std::span<const double> op,
                std::span<EightNumbers> mv);

/// What op does at a sample, as valves see it.
template <typename Element>
struct OpStep {
  Element op;
  Element before;     ///< op a sample earlier
  Element direction;  ///< of op's last motion, +1 or -1
  Element kept;       ///< 0 = op turned, or stood still for the second time: a moving valve stops
  Element turned;     ///< 0 or 1
};

/// Follows op, the same for every valve that sees it.
template <typename Element>
struct OpMotion {
  Element previous = 0;
  Element direction = 1;  ///< of op's last motion
  bool stood_still = true;

  OpStep<Element> take(Element op) {
    const Element slope = op - previous;
    const bool still = slope == 0;
    const bool turned = slope * direction < 0;
    const bool stopped = turned || (still && stood_still);
    direction = turned ? -direction : direction;
    stood_still = still;
    const Element before = previous;
    previous = op;
    return {op, before, direction, Element(stopped ? 0 : 1), Element(turned ? 1 : 0)};
  }
};

/// Calls f with the law as a constant of the compiler: f.template operator()<law>().
template <typename Function>
void with_law(ValveLaw law, Function&& f) {
  switch (law) {
    case ValveLaw::choudhury:
      return f.template operator()<ValveLaw::choudhury>();
    case ValveLaw::kano:
      return f.template operator()<ValveLaw::kano>();
    case ValveLaw::he:
      return f.template operator()<ValveLaw::he>();
  }
}

}  // namespace loopscope::core::model
