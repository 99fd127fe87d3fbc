#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "core/model/results/explanation.hpp"

namespace loopscope::core::model {

/// A polynomial in z^-1, the constant first.
using Polynomial = std::vector<double>;

[[nodiscard]] Polynomial product(const Polynomial& left, const Polynomial& right);
/// Of any two lengths.
[[nodiscard]] Polynomial sum(const Polynomial& left, const Polynomial& right);
/// At this z^-1; exp(-i w) for w radians per sample.
[[nodiscard]] std::complex<double> value(const Polynomial& polynomial,
                                         std::complex<double> inverse_z);

/// pv / op as the samples see it: z^-delay numerator / denominator.
struct SampledProcess {
  Polynomial numerator;           ///< pv units per %
  Polynomial denominator;         ///< first coefficient 1
  std::size_t delay_samples = 1;  ///< 1 = pv answers at the next sample
};

/// The process behind a zero-order hold, exactly; `delay_s` is rounded to samples and counts the
/// sample that the hold costs, so a process without dead time has one sample. With `integrating`,
/// time_constant_s is a lag before the integrator and the second one is not used. Throws
/// std::invalid_argument unless the interval is > 0 and every figure is finite.
[[nodiscard]] SampledProcess sample_process(const ProcessFit& fit, double interval_s);

/// Frequency response at w radians per sample.
[[nodiscard]] std::complex<double> response(const SampledProcess& process, double w);

}  // namespace loopscope::core::model
