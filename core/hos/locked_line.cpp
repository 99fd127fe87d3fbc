#include "core/hos/locked_line.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace loopscope::core::hos {

double line_lock(const Spectra& spectra) {
  using Row = Eigen::Map<const Eigen::VectorXd>;
  const auto row = static_cast<Eigen::Index>(spectra.row_length());
  double largest = 0.0;
  for (std::size_t k = 1; k < spectra.frequencies(); ++k) {
    const double real = Row(spectra.real(k), row).sum();
    const double imaginary = Row(spectra.imaginary(k), row).sum();
    const double power = spectra.total_power(k);
    if (power > 0.0) largest = std::max(largest, (real * real + imaginary * imaginary) / power);
  }
  return largest;
}

bool has_locked_line(const Spectra& spectra) {
  constexpr double kFalse = 1e-3;
  return line_lock(spectra) > std::log(static_cast<double>(spectra.frequencies()) / kFalse);
}

}  // namespace loopscope::core::hos
