#include "daemon/report/text/event_words.hpp"

#include <cmath>

#include "core/model/results/phrases.hpp"
#include "daemon/report/text/verdict_words.hpp"

namespace loopscope::daemon {

std::string lag_words(const storage::PlantOscillationRow::Member& member,
                      const storage::PlantOscillationRow& event) {
  if (!event.source_name || member.role == "source") return {};
  return core::model::in_time(std::abs(member.lag_s)) + (member.lag_s < 0.0 ? " ahead" : " behind");
}

std::string role_and_lag(const storage::PlantOscillationRow::Member& member,
                         const storage::PlantOscillationRow& event) {
  const std::string lag = lag_words(member, event);
  return in_words(member.role) + (lag.empty() ? "" : ", " + lag);
}

}  // namespace loopscope::daemon
