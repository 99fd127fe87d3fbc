#pragma once

#include <cstddef>
#include <vector>

namespace loopscope::core::simulate {

/// G(z^-1) = z^-delay (b0 + b1 z^-1) / (1 - pole z^-1): the form of eq. 20. Its input and output
/// are distances from the operating point (% of flow in, pv units out).
struct ProcessModel {
  std::size_t delay_samples = 3;  ///< >= 1: a sampled process answers after one sample at least
  double b0 = 1.45;
  double b1 = -1.0;
  double pole = 0.8;  ///< -1 to 1; 1 = integrating (a level)
};

/// One running process, at rest at its operating point.
class Process {
 public:
  /// Throws std::invalid_argument for a delay of 0 or a pole outside -1 to 1.
  explicit Process(const ProcessModel& model);

  /// The output at this sample; it depends on earlier inputs only.
  [[nodiscard]] double output() const { return output_; }

  /// Takes this sample's input and moves on to the next sample.
  void advance(double input);

 private:
  [[nodiscard]] double input_before(std::size_t samples) const;

  ProcessModel model_;
  std::vector<double> inputs_;  ///< ring of the last delay + 1 inputs
  std::size_t newest_ = 0;
  double output_ = 0.0;
};

}  // namespace loopscope::core::simulate
