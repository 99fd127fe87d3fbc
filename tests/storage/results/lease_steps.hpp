#pragma once

#include <cstddef>
#include <ostream>
#include <rapidcheck.h>

namespace loopscope::storage {

inline constexpr std::size_t kLeaseWorkers = 3;

/// What can happen.
enum class Deed {
  claim,
  claim_next,
  claim_suspect,
  complete,
  complete_without_row,
  fail,
  release,
  extend,
  repeat,  ///< the last finish once more, as after an answer that was lost
  stall,   ///< a lease ends; the worker does not know
  be_due,
};

/// What happens, and to whom.
struct Step {
  Deed deed = Deed::claim;
  std::size_t worker = 0;
  std::size_t which = 0;  ///< among the loops, or among those that the worker believes to hold
};

/// For the history that RapidCheck shows when it finds one that does not hold.
std::ostream& operator<<(std::ostream& out, const Step& step);

[[nodiscard]] rc::Gen<Step> any_step();

}  // namespace loopscope::storage
