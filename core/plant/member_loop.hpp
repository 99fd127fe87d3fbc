#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace loopscope::core::plant {

/// What a loop's own verdict blames, in the families that matter to its neighbours.
enum class Fault {
  none,         ///< healthy, or not judged
  friction,     ///< the valve sticks, has play or is too large: what makes a loop cycle
  valve,        ///< the valve saturates or has the wrong characteristic
  process,      ///< process nonlinearity or change
  sensor,       ///< sensor fault
  tuning,       ///< tight or sluggish
  disturbance,  ///< comes from outside the loop
  unexplained,  ///< nonlinear or structured without a named cause
};

/// What the loop's own diagnosis says, as far as it speaks for or against its being the source of
/// an oscillation that others share. All of it stands in the results schema as well.
struct OwnFindings {
  Fault fault = Fault::none;
  double confidence = 0.0;  ///< of the verdict, 0 to 1
  /// Probabilities beside the verdict, 0 to 1, since causes may stand together: that the valve
  /// sticks, has play or is too large; that something outside the loop disturbs it. 0 = not
  /// weighed.
  double friction_p = 0.0;
  double outside_p = 0.0;
};

/// A longer span of a loop's error that ends with its record, at coarser steps (means).
struct LongerRecord {
  double sample_interval_s = 1.0;  ///< > 0
  std::int64_t start_us = 0;       ///< microseconds UTC since 1970
  std::span<const double> error;   ///< sp - pv, pv units; NaN = missing; empty = there is none
};

/// One loop as the plant sees it. The spans are one length, sample k taken at
/// start_us + k sample_interval_s; NaN = missing. They have to outlive the call.
struct MemberLoop {
  std::int64_t id = 0;             ///< of the catalogue; the caller's
  std::string name;                ///< for statements
  double sample_interval_s = 1.0;  ///< > 0
  std::int64_t start_us = 0;       ///< microseconds UTC since 1970
  std::span<const double> error;   ///< sp - pv, pv units
  std::span<const double> sp;      ///< pv units; empty = not recorded
  std::span<const double> pv;      ///< pv units; empty = not recorded
  std::span<const double> op;      ///< any unit; empty = not recorded
  LongerRecord longer;             ///< for the search of slow swings only
  OwnFindings own;
};

}  // namespace loopscope::core::plant
