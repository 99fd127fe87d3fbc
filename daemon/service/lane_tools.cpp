#include "daemon/service/lane_tools.hpp"

#include <string>

#include "core/diagnosis/diagnose.hpp"
#include "core/hos/triple_sums.hpp"

namespace loopscope::daemon {

LaneTools::LaneTools(std::size_t workers, Perseverance how_long)
    : metrics(
          {LOOPSCOPE_VERSION, core::kAlgorithmRevision, std::string(core::hos::processor_path())}),
      cores(workers),
      perseverance(how_long) {}

}  // namespace loopscope::daemon
