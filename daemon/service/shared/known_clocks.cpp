#include "daemon/service/shared/known_clocks.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "daemon/service/threads/worker_identity.hpp"
#include "storage/error.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kSetClockRight =
    "set the clock that is wrong; where the results server's is right, let a person say so: "
    "loopscope maintain --config F --accept-clock";

std::int64_t host_now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

double seconds_between(std::int64_t from_us, std::int64_t to_us) {
  return static_cast<double>(to_us - from_us) * 1e-6;
}

}  // namespace

KnownClocks::KnownClocks() : KnownClocks({host_now_us, Steady::now}) {}
KnownClocks::KnownClocks(Here here) : here_(std::move(here)) {}

void KnownClocks::note_historian(const std::string& source, const storage::ServerClock& clock) {
  const std::lock_guard lock(mutex_);
  historians_.insert_or_assign(source, Reading{clock, here_.elapsed()});
}

void KnownClocks::keep_historians(const std::vector<std::string>& sources) {
  const std::lock_guard lock(mutex_);
  std::erase_if(historians_, [&](const auto& known) {
    return std::ranges::find(sources, known.first) == sources.end();
  });
}

void KnownClocks::accept(storage::AcceptedClocks accepted) {
  const std::lock_guard lock(mutex_);
  accepted_ = std::move(accepted);
}

KnownClocks::State KnownClocks::note_results(const storage::ServerClock& clock) {
  const std::lock_guard lock(mutex_);
  results_ = Reading{clock, here_.elapsed()};
  return judge();
}

storage::ClockCheck KnownClocks::check() {
  return [this](const storage::ServerClock& clock) {
    if (const auto why = refusal(note_results(clock))) throw *why;
  };
}

bool KnownClocks::is_wrong(const std::string& source) {
  const std::lock_guard lock(mutex_);
  if (!results_) return false;
  const std::vector<ClockReading> wrong = judge().judgement.wrong_historians;
  return std::ranges::find(wrong, "historian " + source, &ClockReading::clock) != wrong.end();
}

std::int64_t KnownClocks::now_us(const Reading& reading) const {
  return reading.clock.now_us +
         std::chrono::duration_cast<std::chrono::microseconds>(here_.elapsed() - reading.at)
             .count();
}

KnownClocks::State KnownClocks::judge() const {
  const std::int64_t results_us = now_us(*results_);
  State state{{"host " + host_name(), seconds_between(results_us, here_.now_us())}, {}, {}};
  for (const auto& [source, reading] : historians_) {
    if (reading.clock.started_us == results_->clock.started_us) continue;
    state.historians.push_back(
        {"historian " + source, seconds_between(results_us, now_us(reading))});
  }
  state.judgement = judge_clocks(state.host, state.historians, accepted_);
  return state;
}

std::optional<storage::DatabaseError> refusal(const KnownClocks::State& state) {
  using Results = ClockJudgement::Results;
  if (state.judgement.results == Results::believed) return std::nullopt;
  std::vector<std::string> others;
  for (const ClockReading& historian : state.historians) {
    others.push_back(fmt::format("{} ({})", historian.clock, difference_text(historian.ahead_s)));
  }
  others.push_back(fmt::format("{} ({})", state.host.clock, difference_text(state.host.ahead_s)));
  const bool wrong = state.judgement.results == Results::wrong;
  const std::string what =
      fmt::format("nothing is claimed or written, because {}; compared with it: {}",
                  wrong ? "the clock of the results server is wrong"
                        : "nobody confirms the results server's clock",
                  fmt::join(others, ", "));
  return storage::DatabaseError(what, kSetClockRight, storage::Remedy::retry);
}

}  // namespace loopscope::daemon
