#include "daemon/service/shared/judge_clocks.hpp"

#include <cmath>
#include <fmt/format.h>

namespace loopscope::daemon {
namespace {

/// Where it stands beside the results server's, once what a person has accepted is taken off.
double corrected_s(const ClockReading& reading, const storage::AcceptedClocks& accepted) {
  const auto known = accepted.find(reading.clock);
  if (known == accepted.end() || !clocks_agree(reading.ahead_s, known->second)) {
    return reading.ahead_s;
  }
  return 0.0;
}

}  // namespace

bool clocks_agree(double ahead_s, double other_ahead_s) {
  return std::abs(ahead_s - other_ahead_s) <= kClockTolerance_s;
}

ClockJudgement judge_clocks(const ClockReading& host, const std::vector<ClockReading>& historians,
                            const storage::AcceptedClocks& accepted) {
  using Results = ClockJudgement::Results;
  const double host_s = corrected_s(host, accepted);
  int for_results = 0;
  ClockJudgement judgement;
  for (const ClockReading& historian : historians) {
    const double historian_s = corrected_s(historian, accepted);
    const bool with_results = clocks_agree(historian_s, 0.0);
    const bool with_host = clocks_agree(historian_s, host_s);
    for_results += int{with_results} - int{with_host};
    if (!with_results && !with_host) judgement.wrong_historians.push_back(historian);
  }
  if (clocks_agree(host_s, 0.0)) return judgement;
  judgement.results = for_results > 0   ? Results::believed
                      : for_results < 0 ? Results::wrong
                                        : Results::open;
  judgement.host_is_wrong = judgement.results == Results::believed;
  return judgement;
}

std::string difference_text(double ahead_s) {
  const auto minutes = std::llround(std::abs(ahead_s) / 60.0);
  if (minutes == 0) return "the same time";
  constexpr long long kHour = 60;
  constexpr long long kDay = 24 * kHour;
  const auto days = minutes / kDay;
  const auto hours = minutes % kDay / kHour;
  const std::string size = days > 0    ? fmt::format("{} d {} h", days, hours)
                           : hours > 0 ? fmt::format("{} h {} min", hours, minutes % kHour)
                                       : fmt::format("{} min", minutes);
  return size + (ahead_s > 0.0 ? " ahead" : " behind");
}

}  // namespace loopscope::daemon
