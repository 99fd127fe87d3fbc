#include "daemon/service/batches/batch.hpp"

#include <algorithm>
#include <spdlog/spdlog.h>

#include "daemon/service/windows/slot.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {

void set_aside(const storage::ClaimedLoop& claim, const Failure& failure, Batch& batch) {
  const double pause_s = retry_pause_s(claim.attempts);
  if (claim.past) {
    spdlog::error("loop \"{}\" failed at its window up to {}: {} HINT: {}", claim.loop.name,
                  format_time(claim.past->end_us), failure.what(), failure.hint());
  } else {
    spdlog::error("loop \"{}\" failed, next try in {:.0f} s: {} HINT: {}", claim.loop.name, pause_s,
                  failure.what(), failure.hint());
  }
  if (!batch.first_failure) batch.first_failure = failure;
  batch.failed.push_back(
      {claim.loop.loop_id, claim.fence, failure.what(), pause_s, true, claim.kept_due_us()});
}

bool is_set_aside(std::int64_t loop_id, const Batch& batch) {
  return std::ranges::find(batch.failed, loop_id, &storage::FailedLoop::loop_id) !=
         batch.failed.end();
}

void postpone(const Claims& claims, const Failure& failure, double pause_s, Batch& batch) {
  if (!batch.first_failure) batch.first_failure = failure;
  for (const storage::ClaimedLoop* claim : claims) {
    if (is_set_aside(claim->loop.loop_id, batch)) continue;
    batch.failed.push_back(
        {claim->loop.loop_id, claim->fence, failure.what(), pause_s, false, claim->kept_due_us()});
  }
}

}  // namespace loopscope::daemon
