#pragma once

#include <functional>
#include <optional>

#include "config/settings.hpp"
#include "daemon/service/shared/results_link.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "storage/error.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::daemon {

/// Compares the clocks of the results server, of this host and of the historians, and tells
/// metrics and log of those that are wrong. Where all that are known agree only the results server
/// is asked, else every historian too. Returns why nothing may be
/// claimed or written; nullopt = it may. Throws storage::DatabaseError when the results database
/// does not answer.
std::optional<storage::DatabaseError> compare_clocks(const config::Settings& settings,
                                                     SharedServices& tools, ResultsLink& results);

/// How the results server's clock, which `results_clock` reads, stands beside the others. Where all
/// that are known agree nobody else is asked, else every historian too. Throws what `results_clock`
/// throws.
[[nodiscard]] KnownClocks::State look_at_clocks(
    const config::Settings& settings, SharedServices& tools,
    const std::function<storage::ServerClock()>& results_clock);

/// Asks the clocks of all historians that answer and notes them; never throws for one that does
/// not.
void ask_historians(const config::Settings& settings, SharedServices& tools);

}  // namespace loopscope::daemon
