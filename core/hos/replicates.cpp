#include "core/hos/replicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/hos/harmonic_test.hpp"
#include "core/hos/nli_p.hpp"
#include "core/hos/null_laws.hpp"

namespace loopscope::core::hos {
namespace {

/// Records drawn. Sixty know the mean of an exponential variable to 13 % and the standard deviation
/// to 9 %; more gained nothing on sticking valves and skewed noise (README, "Second pass").
constexpr std::size_t kRecords = 60;

struct Spread {
  double mean = 0.0;
  double std = 0.0;
};

Spread spread_of(const std::vector<double>& values) {
  Spread spread;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) spread.mean += value / count;
  for (const double value : values) {
    spread.std += (value - spread.mean) * (value - spread.mean) / (count - 1.0);
  }
  spread.std = std::sqrt(spread.std);
  return spread;
}

/// p to the power 1 / mean of -ln p, where that mean is above 1 by more than two of its standard
/// errors.
double stretched_p(double p, const std::vector<double>& evidence) {
  if (evidence.size() < 2) return p;
  const double mean = spread_of(evidence).mean;
  const double chance = 2.0 / std::sqrt(static_cast<double>(evidence.size()));
  return mean > 1.0 + chance ? std::pow(p, 1.0 / mean) : p;
}

double evidence_of(double p) {
  return -std::log(std::max(p, std::numeric_limits<double>::min()));
}

}  // namespace

Replicates::Replicates(const LinearModel& model, const TestedSpectra& tested,
                       const QuadraticTest& test, std::optional<double> period,
                       std::uint64_t seed) {
  std::mt19937_64 random(seed);
  // All records are of one length and miss the same samples: what the first one takes serves all.
  std::optional<HarmonicTest> harmonic_test;
  if (period) harmonic_test.emplace(*period);
  std::vector<double> record;
  std::optional<TestedSpectra> spectra;
  for (std::size_t i = 0; i < kRecords; ++i) {
    model.draw(tested.signal(), random, record);
    if (spectra) {
      spectra->look_at(record);
    } else {
      spectra.emplace(record, tested.precautions(), tested.settings(), tested.kernels());
    }
    std::optional<HarmonicStatistics> harmonics;
    if (harmonic_test) harmonics = harmonic_test->measure(record, nullptr, tested.kernels());
    QuadraticStatistics quadratic;
    if (!spectra->bic2().empty()) {
      quadratic = test.measure(spectra->bicoherence(), spectra->bic2());
      mean_.push_back(quadratic.mean);
    }
    nli_.push_back(evidence_of(hos::nli_p(test, quadratic, harmonics)));
    if (harmonics) cubic_.push_back(harmonics->cubic_evidence);
  }
}

double Replicates::mean_p(double mean) const {
  if (mean_.size() < 2) return 1.0;
  const Spread spread = spread_of(mean_);
  return mean_law_upper(mean, spread.mean, spread.std);
}

double Replicates::nli_p(double first_pass_p) const {
  return stretched_p(first_pass_p, nli_);
}

double Replicates::cubic_p(double first_pass_p) const {
  return stretched_p(first_pass_p, cubic_);
}

}  // namespace loopscope::core::hos
