#include "tests/plants/network/run_plants.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace loopscope::tests::network {
namespace {

/// One plant in so many has its source where a stream goes back to the first unit.
constexpr std::size_t kRecycle = 8;

struct Job {
  std::uint64_t seed = 0;
  Origin origin = Origin::valve;
};

std::vector<Job> jobs_of(const Options& options) {
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < options.plants; ++k)
    jobs.push_back({options.seed + k, k % kRecycle == 0 ? Origin::recycle : Origin::valve});
  for (std::size_t k = 0; k < options.outside; ++k)
    jobs.push_back({options.seed + k, Origin::outside});
  return jobs;
}

class Workers {
 public:
  explicit Workers(const Options& options)
      : options_(options), jobs_(jobs_of(options)), outcomes_(jobs_.size()) {}

  std::vector<Outcome> run() {
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < options_.threads; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(outcomes_);
  }

 private:
  void work() {
    const Extras extras{options_.criteria, !options_.evidence_file.empty()};
    for (std::size_t job = next_++; job < jobs_.size(); job = next_++) try {
        outcomes_[job] = run_plant(jobs_[job].seed, jobs_[job].origin, extras);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        next_ = jobs_.size();
      }
  }

  const Options& options_;
  std::vector<Job> jobs_;
  std::vector<Outcome> outcomes_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<Outcome> run_plants(const Options& options) {
  return Workers(options).run();
}

}  // namespace loopscope::tests::network
