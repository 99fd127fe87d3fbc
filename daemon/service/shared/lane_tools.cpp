#include "daemon/service/shared/lane_tools.hpp"

#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "core/hos/bicoherence/triple_sums.hpp"

namespace loopscope::daemon {

LaneTools::LaneTools(std::size_t workers, Perseverance how_long)
    : metrics(
          {LOOPSCOPE_VERSION, core::kAlgorithmRevision, std::string(core::hos::processor_path())}),
      cores(workers),
      perseverance(how_long) {}

std::vector<std::string> LaneTools::sources_away() {
  std::vector<std::string> away;
  for (const auto& [source, left] : historians.closed()) away.push_back(source);
  return away;
}

}  // namespace loopscope::daemon
