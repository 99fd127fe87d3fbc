#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace loopscope::core::simulate {

/// Law of independent samples, each with mean 0 and variance 1.
enum class Innovation {
  gaussian,
  exponential,  ///< skewness 2, excess kurtosis 6
  uniform,      ///< symmetric, excess kurtosis -1.2
  laplace,      ///< symmetric, excess kurtosis 3
};
[[nodiscard]] std::string_view name(Innovation law);

/// `samples` independent numbers of that law; the seed fixes them on every platform whose
/// mathematical library agrees.
[[nodiscard]] std::vector<double> innovations(Innovation law, std::size_t samples,
                                              std::uint64_t seed);

}  // namespace loopscope::core::simulate
