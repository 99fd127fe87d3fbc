#include "daemon/service/threads/core_gate.hpp"

#include <sys/resource.h>
#include <unistd.h>

namespace loopscope::daemon {

void yield_to_analysis() {
  constexpr int kNice = 10;
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNice);
}

}  // namespace loopscope::daemon
