#pragma once

#include <memory>

#include "config/settings.hpp"
#include "storage/results/results_database.hpp"

namespace loopscope::daemon {

/// One full pass over all enabled loops on all workers, with a progress bar on a terminal. SIGTERM
/// or SIGINT finishes what is in hand and ends early. Throws the first storage::DatabaseError of
/// the results database after every worker has stopped.
storage::WriteCount run_pass(const std::shared_ptr<const config::Settings>& settings);

}  // namespace loopscope::daemon
