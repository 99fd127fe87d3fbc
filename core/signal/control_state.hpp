#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/signal/loop_window.hpp"
#include "core/signal/op_range.hpp"

namespace loopscope::core::signal {

/// How many samples the controller was run in which way.
struct ModeCounts {
  std::size_t manual = 0;
  std::size_t automatic = 0;  ///< or cascade
  std::size_t unknown = 0;
  [[nodiscard]] std::size_t known() const { return manual + automatic; }
};
[[nodiscard]] ModeCounts count_modes(std::span<const ControlMode> mode);

/// Whether nine in ten of the recorded samples lie beyond `least` (>= 0, in the error's unit) on
/// one and the same side of 0. False where none is recorded.
[[nodiscard]] bool keeps_its_sign(std::span<const double> error, double least = 0.0);

/// Why no controller acts.
enum class NotActing {
  none,             ///< one does
  mode,             ///< manual, tracking or out of service, by the recorded mode
  constant_output,  ///< op stands still although the error moves
};

/// Whether a controller acted, over the window.
struct ControlState {
  std::optional<double> acting_fraction;  ///< of the samples that tell, 0 to 1; nullopt = none does
  NotActing reason = NotActing::none;     ///< of the larger part of the time without one
  /// First sample of the unbroken stretch without a controller that reaches the window's end;
  /// nullopt = one acts at the end.
  std::optional<std::size_t> lost_at;
  /// Share of the samples with op at an end of its range; of an inferred one only those that are
  /// held there under a lasting error (op_scale.hpp). nullopt = no range, or op not recorded.
  std::optional<double> at_limit_fraction;
  /// That is most of the window, and its error keeps its sign: a controller acts, and can do no
  /// more.
  bool held_at_limit = false;
  std::optional<double> wound_up_percent;  ///< 0 or 100: op is held there at the window's end

  /// A controller acted for more than half of the window, or nothing tells; false is a state, and
  /// no fault of the loop.
  [[nodiscard]] bool controlling() const;
};

/// What is asked; series are empty (not recorded) or of one length.
struct ControlRecord {
  std::span<const double> op_percent;  ///< op units where no range is known
  std::span<const double> error;       ///< sp - pv, whatever the mode
  std::span<const ControlMode> mode;
  RangeSource range = RangeSource::unknown;  ///< where the ends come from
};

/// By the mode where it is recorded, and by op: one that is constant but for how it is read back,
/// or stands for 300 samples and ten times longer than it usually does while the error moves, is
/// nobody's answer to it, whatever the mode says; op at an end of its range under a lasting error
/// is. One that a hand moves now and then is nobody's either, where no mode says automatic.
[[nodiscard]] ControlState find_control_state(const ControlRecord& record);

}  // namespace loopscope::core::signal
