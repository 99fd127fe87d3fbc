#include "daemon/service/windows/loop_facts.hpp"

#include "core/signal/window_digest.hpp"

namespace loopscope::daemon {

core::LoopFacts loop_facts(const storage::CatalogueEntry& loop,
                           const core::signal::LoopWindow& window) {
  core::LoopFacts facts{.integrating = core::is_integrating_type(loop.loop_type),
                        .seed = core::signal::window_seed(window)};
  if (loop.pv_range) {
    facts.pv_span = loop.pv_range->high - loop.pv_range->low;
    facts.pv_low = loop.pv_range->low;
  }
  return facts;
}

}  // namespace loopscope::daemon
