#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace loopscope::core::simulate {

/// Law of samples, each with mean 0 and variance 1: independent ones, and two whose loudness
/// changes.
enum class Innovation {
  gaussian,
  exponential,   ///< skewness 2, excess kurtosis 6
  uniform,       ///< symmetric, excess kurtosis -1.2
  laplace,       ///< symmetric, excess kurtosis 3
  student_5,     ///< Student's t, 5 degrees of freedom: excess kurtosis 6
  student_3,     ///< 3 degrees: no fourth moment
  contaminated,  ///< normal, one in fifty five times as loud
  bursts,        ///< normal, five times as loud for a tenth of the time, 50 samples on average
  garch,         ///< variance 0.05 + 0.15 of the last square + 0.8 of the last variance
};
[[nodiscard]] std::string_view name(Innovation law);

/// `samples` numbers of that law; the seed fixes them on every platform whose
/// mathematical library agrees.
[[nodiscard]] std::vector<double> innovations(Innovation law, std::size_t samples,
                                              std::uint64_t seed);

}  // namespace loopscope::core::simulate
