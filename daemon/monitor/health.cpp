#include "daemon/monitor/health.hpp"

#include <fmt/format.h>
#include <utility>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::size_t kMostReasonBytes = 512;

HealthAnswer answer(const std::vector<std::string>& reasons) {
  if (reasons.empty()) return {true, "ok\n"};
  HealthAnswer answer{false, ""};
  for (const std::string& reason : reasons)
    answer.text += plain_line(reason, kMostReasonBytes) + '\n';
  return answer;
}

double seconds(Health::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Health::Health(WhyNotLive why_not_live, HealthLimits limits, std::function<Clock::time_point()> now)
    : why_not_live_(std::move(why_not_live)), now_(std::move(now)), limits_(limits) {}

void Health::set_limits(HealthLimits limits) {
  const std::lock_guard lock(mutex_);
  limits_ = limits;
}

void Health::results_answered() {
  const std::lock_guard lock(mutex_);
  answered_at_ = now_();
  schema_refusal_.reset();
}

void Health::schema_refused(std::string why) {
  const std::lock_guard lock(mutex_);
  answered_at_ = now_();
  schema_refusal_ = std::move(why);
}

void Health::set(const storage::ScheduleHealth& schedule) {
  const std::lock_guard lock(mutex_);
  lag_s_ = schedule.lag_s;
}

void Health::set_clock_refusal(std::optional<std::string> why) {
  const std::lock_guard lock(mutex_);
  clock_refusal_ = std::move(why);
}

HealthAnswer Health::live() const {
  const std::optional<std::string> reason = why_not_live_();
  return reason ? answer({*reason}) : answer({});
}

HealthAnswer Health::ready() const {
  const std::lock_guard lock(mutex_);
  return answer(why_not_ready());
}

std::vector<std::string> Health::why_not_ready() const {
  if (!answered_at_) return {"results database: not reached since the start"};
  std::vector<std::string> reasons;
  const double silence_s = seconds(now_() - *answered_at_);
  if (silence_s > limits_.max_silence_s) {
    reasons.push_back(fmt::format("results database: no answer for {:.0f} s, at most {:.0f} s",
                                  silence_s, limits_.max_silence_s));
  }
  if (schema_refusal_) reasons.push_back("schema: " + *schema_refusal_);
  if (clock_refusal_) reasons.push_back("clock: " + *clock_refusal_);
  if (lag_s_ > limits_.max_lag_s) {
    reasons.push_back(fmt::format("lag: the most overdue loop waits for {:.0f} s, at most {:.0f} s",
                                  lag_s_, limits_.max_lag_s));
  }
  return reasons;
}

}  // namespace loopscope::daemon
