#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/analysis_worker.hpp"
#include "daemon/service/shared/shared_services.hpp"
#include "daemon/text/failure.hpp"
#include "storage/results/results_database.hpp"
#include "storage/stage_cost.hpp"

namespace loopscope::daemon {

/// Where the workers of a pass get their loops from. Thread-safe.
class ClaimSource {
 public:
  virtual ~ClaimSource() = default;
  /// The worker's next batch; may wait for one. Empty = nothing is left for it. Throws
  /// storage::DatabaseError.
  virtual std::vector<storage::ClaimedLoop> next(AnalysisWorker& worker) = 0;
  /// The worker has brought them to their end.
  virtual void done(const std::vector<storage::ClaimedLoop>& claims,
                    const storage::WriteCount& count) = 0;
  /// How much of the work is done.
  [[nodiscard]] virtual std::size_t settled() const = 0;
};

/// What a pass is made of.
struct PassPlan {
  ClaimSource& source;
  std::size_t workers = 1;
  std::size_t total = 0;            ///< settled() at the end
  std::string_view unit = "loops";  ///< of the progress bar, in the plural
};

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

/// Runs workers on a thread pool until the source has nothing left, with a progress bar on a
/// terminal. SIGTERM or SIGINT requests `stop`, whose token `tools` have: what is in hand is
/// finished, and the pass ends early. Throws the first storage::DatabaseError of the results
/// database after every worker has stopped. `enabled` is left to the caller.
[[nodiscard]] PassResult run_workers(const std::shared_ptr<const config::Settings>& settings,
                                     SharedServices& tools, std::stop_source stop,
                                     const PassPlan& plan);

/// One full pass over all enabled loops on all cores. Loops that another worker holds are left to
/// it; suspects, which may be what kills the process, come one by one at the end. Throws what
/// run_workers() throws.
[[nodiscard]] PassResult run_pass(const std::shared_ptr<const config::Settings>& settings,
                                  SharedServices& tools, std::stop_source stop);

}  // namespace loopscope::daemon
