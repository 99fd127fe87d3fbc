#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/hos/bicoherence/bicoherence.hpp"
#include "core/hos/coupling/overlap.hpp"
#include "core/hos/coupling/testable_cells.hpp"

namespace loopscope::core::hos {

/// What the squared bicoherence of one record says, in figures whose null is known.
struct QuadraticStatistics {
  double mean = 1.0;     ///< mean of K bic2 over the testable cells; about 1 for Gaussian signals
  double largest = 0.0;  ///< largest -ln p of a single cell
};

/// Tests over the triangle of bifrequencies, first pass: closed forms, no random numbers.
///
/// Null of `mean`: Pearson III with the moments of Overlap. Null of `largest`: the smallest p of as
/// many independent cells as the correlated ones are worth. Neither depends on the spectrum, since
/// a bicoherence is a ratio, cells that share a main lobe are left out, and a cell's p is taken
/// given the spectra it multiplies (coherence_test.hpp).
class QuadraticTest {
 public:
  /// Throws std::invalid_argument for settings out of range.
  explicit QuadraticTest(const Settings& settings);

  /// From the last estimate of `bicoherence`; `bic2` is what it returned, not empty. `mean` is 1
  /// and `largest` 0 when no cell is testable.
  [[nodiscard]] QuadraticStatistics measure(const Bicoherence& bicoherence,
                                            std::span<const double> bic2) const;

  /// ngi_p: probability that a linear Gaussian signal has this mean or a larger one from so many
  /// segments (K >= 2); 1 when no cell is testable.
  [[nodiscard]] double mean_p(const QuadraticStatistics& found, std::size_t segments) const;

  /// nli_p: probability that a signal of one bicoherence everywhere, so a linear one with skewed
  /// innovations, has a cell as coherent as the largest; the level is taken from the mean.
  [[nodiscard]] double largest_p(const QuadraticStatistics& found) const;

  /// p of one cell that was looked for in the whole triangle, against Gaussian noise; nullopt
  /// outside the testable cells.
  [[nodiscard]] std::optional<double> peak_p(const Bicoherence& bicoherence, Bifrequency at) const;

 private:
  struct Segments;
  [[nodiscard]] double evidence(const Bicoherence& bicoherence, Bifrequency at,
                                Segments& segments) const;
  [[nodiscard]] double independent_cells() const;

  Settings settings_;
  const Overlap* overlap_;
  TestableCells cells_;
};

}  // namespace loopscope::core::hos
