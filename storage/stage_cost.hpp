#pragma once

#include <cstddef>
#include <string>

namespace loopscope::storage {

/// Where the time of a worker went, in seconds that passed on the clock, summed over the loops that
/// it brought to their end. The work on the rows takes a core; fetching and writing wait for the
/// databases most of the time.
struct StageCost {
  std::size_t loops = 0;      ///< brought to their end, unchanged and set aside ones included
  std::size_t analysed = 0;   ///< windows that were analysed anew
  std::size_t modelled = 0;   ///< of those, with a loop model
  std::size_t values = 0;     ///< values in the windows that were read
  double claim_s = 0.0;       ///< taking loops from the schedule, asking what is stored of them
  double fetch_s = 0.0;       ///< rows out of the historian, waiting for a connection included
  double prepare_s = 0.0;     ///< masks, gaps, archive, oscillation
  double statistics_s = 0.0;  ///< higher-order statistics, shapes, performance
  double model_s = 0.0;       ///< the loop model
  double decide_s = 0.0;      ///< verdict and its words, digest, JSON
  double write_s = 0.0;       ///< rows into the results
  double wait_s = 0.0;        ///< for a core that is free to analyse
};

/// `sum` grown by `more`.
void add(StageCost& sum, const StageCost& more);
/// What `later` has more than `earlier`, of which it is a continuation.
[[nodiscard]] StageCost difference(const StageCost& later, const StageCost& earlier);

/// Who the cost belongs to: a row of loopscope.stage_cost per hour.
struct CostBearer {
  std::string host;
  int lane = 0;  ///< the worker of its process; costs of two do not wait for each other
};

}  // namespace loopscope::storage
