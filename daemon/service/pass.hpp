#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>

#include "config/settings.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "daemon/text/failure.hpp"
#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// What a pass did.
struct PassResult {
  storage::WriteCount count;
  std::size_t loops = 0;                 ///< brought to their end by this pass
  std::size_t enabled = 0;               ///< in the catalogue when it began
  int signal = 0;                        ///< SIGTERM or SIGINT that ended it early; 0 = none
  std::optional<Failure> first_failure;  ///< why loops were set aside; nullopt = none was
  storage::StageCost cost;               ///< summed over the workers
  double elapsed_s = 0.0;                ///< from the first claim to the last write
};

/// One full pass over all enabled loops on all cores, with a progress bar on a terminal. Loops
/// that another worker holds are left to it; suspects, which may be what kills the process, come
/// one by one at the end. SIGTERM or SIGINT requests `stop`, whose token `tools` have: what is
/// in hand is finished, and the pass ends early. Throws the first storage::DatabaseError of the
/// results database after every worker has stopped.
[[nodiscard]] PassResult run_pass(const std::shared_ptr<const config::Settings>& settings,
                                  SharedServices& tools, std::stop_source stop);

}  // namespace loopscope::daemon
