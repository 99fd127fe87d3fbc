#include "daemon/service/threads/pauses.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>

namespace loopscope::daemon {
namespace {

constexpr double kFirst_s = 0.25;
/// Beyond any longest pause; larger exponents would only overflow.
constexpr int kMostTriesCounted = 20;

/// All workers of a plant are spread over so much.
constexpr double kSpread_s = 0.05;
/// A source that may be tried again now is tried by whoever was first.
constexpr double kLeastPause_s = 0.1;

double spread_s() {
  thread_local std::minstd_rand random{std::random_device{}()};
  return std::uniform_real_distribution<double>(0.0, kSpread_s)(random);
}

}  // namespace

bool sleep_for(const std::stop_token& stop, std::chrono::duration<double> pause) {
  std::mutex mutex;
  std::condition_variable_any never;  // only the stop ends the wait before its time
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, pause, [] { return false; });
  return !stop.stop_requested();
}

double RetryPause::next_s() {
  const double whole_s =
      std::min(std::ldexp(kFirst_s, std::min(tries_, kMostTriesCounted)), longest_s_);
  ++tries_;
  return std::uniform_real_distribution<double>(0.5 * whole_s, whole_s)(random_);
}

double idle_pause_s(const Look& look, double poll_s, std::optional<double> source_opens_in_s,
                    RetryPause& pause) {
  const bool nothing_due = look.next_due_in_s > 0.0;
  if (!look.failed && (look.worked || nothing_due)) pause.reset();
  if (!look.failed && nothing_due) return std::min(look.next_due_in_s + spread_s(), poll_s);
  const double longest_s = std::max(source_opens_in_s.value_or(poll_s), kLeastPause_s) + spread_s();
  return std::min({pause.next_s(), longest_s, poll_s});
}

}  // namespace loopscope::daemon
