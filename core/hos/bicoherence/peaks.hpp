#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/transforms/settings.hpp"

namespace loopscope::core::hos {

/// A peak of the squared bicoherence.
struct Peak {
  double f1 = 0.0;    ///< cycles per sample, 0 to 0.5, f1 >= f2
  double f2 = 0.0;    ///< cycles per sample
  double bic2 = 0.0;  ///< squared bicoherence, 0 to 1
  /// Against Gaussian noise, corrected for the whole triangle; nullopt = the three frequencies
  /// share main lobes, where a single line looks coupled to itself
  std::optional<double> p;
};

/// Squared bicoherence that the largest of `bifrequencies` (L) values exceeds with a probability
/// of about alpha when nothing is coupled: ln(L / alpha) / K. By the published null K bic2 is
/// exponential (eq. 9 with one bifrequency); L is Bonferroni's correction, close to the truth in
/// spite of correlated neighbours (core/hos/MEASURED.md). May exceed 1. K, L and alpha above 0.
[[nodiscard]] double peak_level(std::size_t segments, std::size_t bifrequencies, double alpha);

/// The strongest distinct peaks of a squared bicoherence over the principal domain of
/// settings.dft_length, strongest first, at most settings.max_peaks.
///
/// A peak exceeds all its neighbours and peak_level(), and lies outside the window's main lobe
/// around every stronger one: within that lobe a single coupled triple of lines is seen several
/// times. Frequencies are bin centres, k / dft_length cycles per sample. `p` is not computed.
///
/// Made once per settings (in range; not checked here) and used for many estimates; takes memory
/// only where it finds more candidates than ever before. One object per thread.
class PeakFinder {
 public:
  explicit PeakFinder(const Settings& settings);

  /// `bic2` over the domain, from `segments` (K >= 1); the peaks are valid until the next call.
  std::span<const Peak> find(std::span<const double> bic2, std::size_t segments);

 private:
  struct Candidate {
    std::size_t index = 0;  // in the domain
    Bifrequency at;
    double bic2 = 0.0;
  };
  void find_candidates(std::span<const double> bic2, double level);
  [[nodiscard]] bool is_distinct(const Candidate& next) const;

  Settings settings_;
  PrincipalDomain domain_;
  double lobe_;  // half width, bins
  std::vector<Candidate> candidates_;
  std::vector<Candidate> kept_;
  std::vector<Peak> peaks_;
};

/// The same, once.
[[nodiscard]] std::vector<Peak> find_peaks(std::span<const double> bic2, std::size_t segments,
                                           const Settings& settings);

}  // namespace loopscope::core::hos
