#pragma once

namespace loopscope::core::simulate {

/// Play in the linkage between actuator and stem.
struct ValveDeadband {
  double width_percent = 2.0;  ///< full width of the play, % of op, 0 to 100
};

/// One valve with play: mv stands until op pushes it with one side of the play, then follows half
/// a width behind: mv = max(op - w/2, min(op + w/2, mv before)). Starts in the middle of the play.
class ValveWithPlay {
 public:
  /// Throws std::invalid_argument for a width outside 0 to 100.
  explicit ValveWithPlay(const ValveDeadband& deadband);

  /// Valve position in % for the next controller output in %.
  double next(double op_percent);

 private:
  double half_width_;
  bool started_ = false;
  double position_ = 0.0;
};

}  // namespace loopscope::core::simulate
