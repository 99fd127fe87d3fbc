#pragma once

#include <complex>
#include <vector>

#include "tests/effects/scenario.hpp"

namespace loopscope::tests::effects {

/// The frequency response of a sampled process (no effects, no curves) and of the loop that a PI
/// controller makes with it; frequencies in radians per sample.
class LoopFrequency {
 public:
  explicit LoopFrequency(const Process& process);

  /// Factor on kc that brings the loop to the edge of stability.
  [[nodiscard]] double gain_margin(const Controller& controller) const;
  [[nodiscard]] double peak_sensitivity(const Controller& controller) const;
  [[nodiscard]] double sensitivity(const Controller& controller, double frequency) const;
  /// |pv per flow| of the process alone.
  [[nodiscard]] double process_gain(double frequency) const;

 private:
  using Complex = std::complex<double>;

  [[nodiscard]] Complex process_at(double frequency) const;
  [[nodiscard]] std::vector<Complex> open_loop(const Controller& controller) const;

  std::vector<double> impulse_;  ///< response to a pulse of op over one sample, less `slope_`
  double slope_ = 0.0;           ///< that an integrating process keeps
  std::vector<double> grid_;
  std::vector<Complex> on_grid_;
};

}  // namespace loopscope::tests::effects
