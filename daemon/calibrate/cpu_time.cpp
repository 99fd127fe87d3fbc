#include "daemon/calibrate/cpu_time.hpp"

#include <ctime>

namespace loopscope::daemon {

double thread_cpu_s() {
  constexpr double kNanosecond_s = 1e-9;
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + kNanosecond_s * static_cast<double>(time.tv_nsec);
}

}  // namespace loopscope::daemon
