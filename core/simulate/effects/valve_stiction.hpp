#pragma once

#include <string_view>

namespace loopscope::core::simulate {

/// The two valve laws; they are different valves, not two ways to write one.
enum class StictionLaw {
  choudhury,  ///< the flow chart of figure 6, as the paper's text of section 5.4 words it
  kano,       ///< Kano, Maruta, Kugemoto and Shimizu 2004: keeps the direction of the last motion
};
[[nodiscard]] std::string_view name(StictionLaw law);

/// A valve that sticks and jumps.
struct ValveStiction {
  double stickband_percent = 3.0;  ///< S, deadband plus stickband, % of op, 0 to 100
  double slip_jump_percent = 1.0;  ///< J, 0 to S, % of op
  StictionLaw law = StictionLaw::choudhury;
};

/// One valve with that law; starts at rest where the first input puts it.
///
/// Both laws move as mv = op - d (S - J) / 2 with d the direction of motion (+1, -1), and stop
/// where op stops or turns back. What they ask before moving again:
/// - choudhury: |op - op_stop| > S, where every reversal of op, also one of the resting valve,
///   makes that op the new op_stop. Small reversals (noise) can so hold a valve for ever.
/// - kano: d (op - op_stop) > J to go on in the same direction, < -S to go the other way.
///   op_stop stays where the valve stopped.
class StickingValve {
 public:
  /// Throws std::invalid_argument unless 0 <= J <= S <= 100.
  explicit StickingValve(const ValveStiction& stiction);

  /// Valve position in % for the next controller output in %.
  double next(double op_percent);

 private:
  void start(double op_percent);
  void judge_motion(double op_percent);
  [[nodiscard]] bool breaks_loose_choudhury(double op_percent) const;
  [[nodiscard]] bool breaks_loose_kano(double op_percent) const;

  ValveStiction stiction_;
  bool started_ = false;
  bool stuck_ = true;
  double previous_op_ = 0.0;
  double stop_op_ = 0.0;
  double position_ = 0.0;
  double direction_ = 1.0;      ///< of the valve's last motion
  double op_direction_ = 0.0;   ///< of op's last motion; 0 = none yet
  bool op_stood_still_ = true;  ///< op did not change at the last sample
};

}  // namespace loopscope::core::simulate
