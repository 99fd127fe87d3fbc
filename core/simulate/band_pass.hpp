#pragma once

#include <array>
#include <span>
#include <vector>

namespace loopscope::core::simulate {

/// Digital Butterworth band pass made from a second-order low-pass prototype by the bilinear
/// transform with prewarped edges: two second-order sections, gain 1 at the centre.
class BandPass {
 public:
  /// Edges in cycles per sample, 0 < low < high < 0.5; anything else throws std::invalid_argument.
  BandPass(double low, double high);

  /// The filter's answer to `input`, started at rest; same length.
  [[nodiscard]] std::vector<double> filter(std::span<const double> input) const;

  /// |H(f)|, f in cycles per sample.
  [[nodiscard]] double magnitude(double frequency) const;

 private:
  /// gain (1 - z^-2) / (1 + a1 z^-1 + a2 z^-2)
  struct Section {
    double gain = 1.0;
    double a1 = 0.0;
    double a2 = 0.0;
  };
  std::array<Section, 2> sections_;
};

}  // namespace loopscope::core::simulate
