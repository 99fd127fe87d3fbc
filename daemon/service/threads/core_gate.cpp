#include "daemon/service/threads/core_gate.hpp"

#include <sys/resource.h>
#include <unistd.h>

namespace loopscope::daemon {

void yield_to_analysis(int nice) {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nice);
}

}  // namespace loopscope::daemon
