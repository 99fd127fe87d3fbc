#include "tests/plants/network/run_plants.hpp"

#include "tests/support/in_threads.hpp"

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

}  // namespace

std::vector<Outcome> run_plants(const Options& options) {
  const std::vector<Job> jobs = jobs_of(options);
  const Extras extras{options.criteria, !options.evidence_file.empty()};
  std::vector<Outcome> outcomes(jobs.size());
  in_threads(jobs.size(), options.threads, [&](std::size_t job) {
    outcomes[job] = run_plant(jobs[job].seed, jobs[job].origin, extras);
  });
  return outcomes;
}

}  // namespace loopscope::tests::network
