#pragma once

#include <cstddef>
#include <vector>

namespace loopscope::tests::process {

/// Power of a series by frequency, behind a Hann window and without its straight line.
class Spectrum {
 public:
  explicit Spectrum(const std::vector<double>& series);

  /// Sum between two frequencies in cycles a sample, in the unit of total().
  [[nodiscard]] double power(double low, double high) const;
  [[nodiscard]] double total() const { return sums_.back(); }
  /// Within 15 % of a frequency and of its harmonics to the fifth.
  [[nodiscard]] double line_power(double frequency) const;
  /// Where a seventh of an octave holds most, not below `lowest`; cycles a sample.
  [[nodiscard]] double strongest(double lowest) const;

 private:
  std::size_t length_ = 1;    ///< of the transform
  std::vector<double> sums_;  ///< of the power below each line
};

[[nodiscard]] double variance(const std::vector<double>& series);
[[nodiscard]] std::vector<double> difference(const std::vector<double>& a,
                                             const std::vector<double>& b);

}  // namespace loopscope::tests::process
