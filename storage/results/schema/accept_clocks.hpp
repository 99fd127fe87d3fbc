#pragma once

#include "storage/connection_settings.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// The results server's clock and what a person has said of those that differ.
struct ResultsTime {
  ServerClock clock;
  AcceptedClocks accepted;
};

/// As the schema's owner sees it. Throws DatabaseError.
[[nodiscard]] ResultsTime results_time(const ConnectionSettings& owner);

/// A person says that the results server's clock is the right one beside these, whose differences
/// are known from now on (seconds ahead); what was said before is forgotten, also by an empty map.
/// One transaction; throws DatabaseError.
void accept_clocks(const ConnectionSettings& owner, const AcceptedClocks& clocks);

}  // namespace loopscope::storage
