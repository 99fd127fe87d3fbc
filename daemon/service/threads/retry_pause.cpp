#include "daemon/service/threads/retry_pause.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::daemon {
namespace {

constexpr double kFirst_s = 0.25;
/// Beyond any longest pause; larger exponents would only overflow.
constexpr int kMostTriesCounted = 20;

}  // namespace

double RetryPause::next_s() {
  const double whole_s =
      std::min(std::ldexp(kFirst_s, std::min(tries_, kMostTriesCounted)), longest_s_);
  ++tries_;
  return std::uniform_real_distribution<double>(0.5 * whole_s, whole_s)(random_);
}

}  // namespace loopscope::daemon
