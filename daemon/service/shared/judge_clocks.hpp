#pragma once

#include <string>
#include <vector>

#include "storage/server_clock.hpp"

namespace loopscope::daemon {

/// Clocks that differ by more than this do not agree. Nothing here needs better ones: settling
/// times and late rows are of the order of minutes, a clock that was never set, a wrong time zone
/// or a hardware clock in local time are wrong by half an hour and more.
inline constexpr double kClockTolerance_s = 600.0;

/// One clock beside that of the results server.
struct ClockReading {
  std::string clock;     ///< "host NAME" or "historian NAME"
  double ahead_s = 0.0;  ///< of the results server's
};

/// What is to be believed of the results server's clock, and which others are wrong.
struct ClockJudgement {
  enum class Results {
    believed,  ///< another clock agrees, or a person has said that it is right
    wrong,     ///< two others agree with each other and not with it
    open,      ///< no two agree, or as many speak for it as against it
  };
  Results results = Results::believed;
  bool host_is_wrong = false;
  std::vector<ClockReading> wrong_historians;
};

/// Weighs the clock of the results server, that of this host and those of historians. The one that
/// differs from two others is wrong; where the server and the host differ, the historians decide by
/// their number. `historians` are of servers of their own: one that the results server runs on
/// shares its clock and is no witness. A difference that a person has accepted, within
/// kClockTolerance_s, counts as none.
[[nodiscard]] ClockJudgement judge_clocks(const ClockReading& host,
                                          const std::vector<ClockReading>& historians,
                                          const storage::AcceptedClocks& accepted);

/// Whether these two tell the same time, within kClockTolerance_s.
[[nodiscard]] bool clocks_agree(double ahead_s, double other_ahead_s);

/// "5 h 2 min ahead" or "30 d 0 h behind": a difference in words, to two units.
[[nodiscard]] std::string difference_text(double ahead_s);

}  // namespace loopscope::daemon
