#include "tests/effects/draws.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "core/diagnosis/diagnose.hpp"
#include "tests/effects/window_of.hpp"

namespace loopscope::tests::effects {
namespace {

/// Evidence without a member `model` has no explanation.
template <typename Evidence>
const core::model::Explanation* model_of(const Evidence& evidence) {
  if constexpr (requires { evidence.model; })
    return evidence.model ? &*evidence.model : nullptr;
  else
    return nullptr;
}

Outcome run_draw(const std::string& kind, std::uint64_t seed, Size size) {
  using Clock = std::chrono::steady_clock;
  const Record record = generate(kind, seed, size);
  const core::signal::LoopWindow window = window_of(record);
  const core::LoopFacts facts{.integrating = record.truth.loop.integrating, .seed = seed};
  const auto start = Clock::now();
  const core::Diagnosis diagnosis = core::diagnose(window, {}, facts);
  const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
  Outcome outcome = judge(record, std::string(name(diagnosis.verdict.code)),
                          diagnosis.verdict.confidence, model_of(diagnosis.evidence));
  outcome.milliseconds = taken.count();
  return outcome;
}

/// Takes jobs by number until none is left or one has failed.
class Workers {
 public:
  explicit Workers(const Plan& plan)
      : plan_(plan), outcomes_(plan.kinds.size(), std::vector<Outcome>(plan.draws)) {}

  std::vector<std::vector<Outcome>> run() {
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < plan_.threads; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(outcomes_);
  }

 private:
  void work() {
    const std::size_t jobs = plan_.kinds.size() * plan_.draws;
    for (std::size_t job = next_++; job < jobs; job = next_++) try {
        const std::size_t kind = job / plan_.draws;
        const std::size_t draw = job % plan_.draws;
        outcomes_[kind][draw] = run_draw(plan_.kinds[kind], plan_.seed + draw, plan_.size);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        next_ = jobs;
      }
  }

  const Plan& plan_;
  std::vector<std::vector<Outcome>> outcomes_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<std::vector<Outcome>> run_draws(const Plan& plan) {
  return Workers(plan).run();
}

}  // namespace loopscope::tests::effects
