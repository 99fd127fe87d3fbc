#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/hos/linear_model.hpp"
#include "core/hos/quadratic_test.hpp"
#include "core/hos/tested_spectra.hpp"

namespace loopscope::core::hos {

/// The statistics of records drawn from a linear model, and the tails fitted on them.
class Replicates {
 public:
  /// Draws the records: as long as the record of `tested`, missing where it is, with its
  /// precautions. `period` of the harmonics in samples,
  /// nullopt for none.
  Replicates(const LinearModel& model, const TestedSpectra& tested, const QuadraticTest& test,
             std::optional<double> period, std::uint64_t seed);

  /// Probability of this mean squared bicoherence: Pearson III with the moments of the replicates,
  /// at least as skewed as for Gaussian noise.
  [[nodiscard]] double mean_p(double mean) const;
  /// First-pass p-values against Gaussian noise, made right for this noise: -ln p is exponential
  /// with mean 1 under Gaussian noise and with the replicates' mean, if that is larger, here.
  [[nodiscard]] double nli_p(double first_pass_p) const;
  [[nodiscard]] double cubic_p(double first_pass_p) const;

 private:
  std::vector<double> mean_;
  std::vector<double> nli_;    // -ln p of the first pass
  std::vector<double> cubic_;  // the same
};

}  // namespace loopscope::core::hos
