#include "daemon/lab/calibrate/calibration.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "daemon/lab/calibrate/record_seed.hpp"
#include "daemon/service/threads/in_threads.hpp"

namespace loopscope::daemon {
namespace {

void add(const RecordOutcome& outcome, FamilyTally& tally) {
  for (std::size_t i = 0; i < kRecordTests; ++i) {
    if (!outcome.p[i]) continue;
    ++tally.tests[i].computed;
    for (std::size_t level = 0; level < kLevels.size(); ++level) {
      if (*outcome.p[i] <= kLevels[level]) ++tally.tests[i].rejected[level];
    }
  }
  tally.estimate_s += outcome.estimate_s;
  tally.analyse_s += outcome.analyse_s;
}

}  // namespace

std::vector<FamilyTally> tally_families(std::span<const core::simulate::CalibrationFamily> families,
                                        std::size_t records, std::size_t threads,
                                        const std::function<void()>& record_done) {
  std::vector<FamilyTally> tallies;
  for (const auto& family : families) tallies.push_back({family, {}, 0.0, 0.0});
  std::mutex mutex;
  in_threads(families.size() * records, threads, [&]() -> IndexedTask {
    const auto tester = std::make_shared<RecordTester>(core::hos::Settings{});
    return [&, tester](std::size_t index) {
      const auto& family = families[index / records];
      const std::uint64_t seed = record_seed(family.name, index % records);
      const RecordOutcome outcome = tester->test(family.draw(family.samples, seed));
      const std::lock_guard lock(mutex);
      add(outcome, tallies[index / records]);
      record_done();
    };
  });
  return tallies;
}

BinomialShare binomial_share(std::size_t successes, std::size_t trials) {
  if (trials == 0 || successes > trials) {
    throw std::invalid_argument("binomial share: more successes than trials, or no trial");
  }
  using Law = boost::math::binomial;
  constexpr double kEachSide = 0.025;
  const auto found = static_cast<double>(successes);
  const auto all = static_cast<double>(trials);
  return {found / all, Law::find_lower_bound_on_p(all, found, kEachSide),
          Law::find_upper_bound_on_p(all, found, kEachSide)};
}

}  // namespace loopscope::daemon
