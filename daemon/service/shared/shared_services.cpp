#include "daemon/service/shared/shared_services.hpp"

#include <string>
#include <utility>

#include "core/diagnosis/diagnose.hpp"
#include "core/hos/bicoherence/triple_sums.hpp"

namespace loopscope::daemon {

SharedServices::SharedServices(std::size_t free_cores, RetryLimit how_long,
                               std::stop_token stop_requested)
    : stop(std::move(stop_requested)),
      metrics(
          {LOOPSCOPE_VERSION, core::kAlgorithmRevision, std::string(core::hos::processor_path())}),
      cores(free_cores),
      perseverance(how_long) {}

std::vector<std::string> SharedServices::sources_away() {
  std::vector<std::string> away;
  for (const auto& [source, left] : historians.closed()) away.push_back(source);
  return away;
}

}  // namespace loopscope::daemon
