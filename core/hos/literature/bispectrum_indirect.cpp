#include "core/hos/literature/bispectrum_indirect.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/hos/kernels/principal_domain.hpp"
#include "core/hos/literature/cumulants.hpp"

namespace loopscope::core::hos {
namespace {

/// exp(-2 pi i k lag / M) for k = 1..bins (rows) and lag = -max_lag..max_lag (columns).
Eigen::MatrixXcd fourier(std::size_t bins, std::size_t max_lag, std::size_t dft_length) {
  const auto lags = static_cast<Eigen::Index>(max_lag);
  Eigen::MatrixXcd matrix(static_cast<Eigen::Index>(bins), 2 * lags + 1);
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      const double turns =
          static_cast<double>((k + 1) * (column - lags)) / static_cast<double>(dft_length);
      matrix(k, column) = std::polar(1.0, -2.0 * std::numbers::pi * turns);
    }
  }
  return matrix;
}

void apply_lag_window(Eigen::MatrixXd& cumulant, std::size_t max_lag) {
  const auto lags = static_cast<std::ptrdiff_t>(max_lag);
  for (std::ptrdiff_t t1 = -lags; t1 <= lags; ++t1) {
    for (std::ptrdiff_t t2 = -lags; t2 <= lags; ++t2) {
      cumulant(lags + t1, lags + t2) *=
          parzen(t1, max_lag) * parzen(t2, max_lag) * parzen(t1 - t2, max_lag);
    }
  }
}

}  // namespace

double parzen(std::ptrdiff_t lag, std::size_t max_lag) {
  const double u = std::abs(static_cast<double>(lag)) / static_cast<double>(max_lag);
  if (u >= 1.0) {
    return 0.0;
  }
  return u <= 0.5 ? 1.0 - 6.0 * u * u * (1.0 - u) : 2.0 * std::pow(1.0 - u, 3);
}

std::vector<std::complex<double>> bispectrum_indirect(std::span<const double> signal,
                                                      const Settings& settings) {
  validate(settings);
  const std::size_t max_lag = settings.segment_length / 2;
  Eigen::MatrixXd cumulant = third_order_cumulant(signal, max_lag);
  if (cumulant.size() == 0) {
    return {};
  }
  apply_lag_window(cumulant, max_lag);
  const PrincipalDomain domain(settings.dft_length);
  const Eigen::MatrixXcd along1 = fourier(settings.dft_length / 2, max_lag, settings.dft_length);
  const auto rows = static_cast<Eigen::Index>(domain.rows());
  const Eigen::MatrixXcd plane = along1 * cumulant * along1.topRows(rows).transpose();
  std::vector<std::complex<double>> bispectrum(domain.size());
  for (std::size_t i = 0; i < bispectrum.size(); ++i) {
    const Bifrequency at = domain.at(i);
    bispectrum[i] =
        plane(static_cast<Eigen::Index>(at.k1 - 1), static_cast<Eigen::Index>(at.k2 - 1));
  }
  return bispectrum;
}

}  // namespace loopscope::core::hos
