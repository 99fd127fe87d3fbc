#include "daemon/service/shared/results_link.hpp"

#include <limits>
#include <string>

#include "daemon/service/historians/storage_settings.hpp"

namespace loopscope::daemon {

storage::ResultsDatabase& ResultsLink::database() {
  if (database_) return *database_;
  storage::ResultsDatabase fresh(results_connection(*settings_), clocks_.check(), watermarks_);
  // The views flag loops by these; they follow the settings of the worker that connected last.
  const config::FlagSettings& flags = settings_->flags;
  fresh.set_parameter("list_false_share", flags.list_false_share);
  fresh.set_parameter("list_leave_share", flags.list_leave_share);
  fresh.set_parameter("list_least_probability", flags.list_least_probability);
  fresh.set_parameter("list_leave_probability", flags.list_leave_probability);
  fresh.set_parameter("false_discovery_rate", flags.false_discovery_rate);
  fresh.set_parameter("false_discovery_dependence",
                      flags.false_discovery_dependence == "arbitrary" ? 1.0 : 0.0);
  fresh.set_parameter("min_confidence", flags.min_confidence);
  return database_.emplace(std::move(fresh));
}

bool ResultsLink::may_pass(const storage::DatabaseError& error) {
  // Class 53: no disk, no memory, no connection left. Somebody will make room.
  return error.remedy() != storage::Remedy::give_up || error.sqlstate().starts_with("53");
}

bool ResultsLink::is_stale(const storage::DatabaseError& error) {
  // Class 42: the schema is not what it was; 0A: what was kept of a statement no longer fits it.
  // Who connects anew is told why.
  return error.remedy() == storage::Remedy::reconnect || error.sqlstate().starts_with("42") ||
         error.sqlstate().starts_with("0A");
}

double ResultsLink::patience_s(RetryLimit perseverance) const {
  return perseverance == RetryLimit::endless ? std::numeric_limits<double>::infinity()
                                             : settings_->schedule.lease_s;
}

void ResultsLink::say(const storage::DatabaseError& error) {
  faults_.fault(kSubject, std::string(error.what()) + " HINT: " + error.hint(), this);
}

}  // namespace loopscope::daemon
