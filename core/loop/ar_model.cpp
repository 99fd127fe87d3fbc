#include "core/loop/ar_model.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::loop {
namespace {

/// Rows per coefficient below which the fit follows the noise.
constexpr double kRowsPerCoefficient = 5.0;
/// Keeps the equations of a noise-free sinusoid (rank 2) solvable; far below any measured noise.
constexpr double kRidge = 1e-10;

using ConstSeries = Eigen::Map<const Eigen::VectorXd>;

/// Normal equations of the regression; entry (i, j) is sum_t x(t - i) x(t - j), i, j = 0 .. p.
struct Products {
  Eigen::MatrixXd sums;
  double rows = 0.0;
};

/// Adds the rows of one run without gaps. Along a diagonal the sums differ by their end terms only,
/// so that a run costs p products per sample instead of p^2 / 2.
void add_run(const double* x, std::size_t length, std::size_t order, Products& products) {
  if (length <= order) return;
  const auto size = static_cast<Eigen::Index>(order + 1);
  Eigen::MatrixXd run(size, size);
  for (std::size_t j = 0; j <= order; ++j) {
    const auto rows = static_cast<Eigen::Index>(length - order);
    run(0, static_cast<Eigen::Index>(j)) =
        ConstSeries(x + order, rows).dot(ConstSeries(x + order - j, rows));
  }
  for (Eigen::Index i = 1; i < size; ++i) {
    for (Eigen::Index j = i; j < size; ++j) {
      const auto first = static_cast<std::ptrdiff_t>(order);
      const auto last = static_cast<std::ptrdiff_t>(length);
      run(i, j) = run(i - 1, j - 1) + x[first - i] * x[first - j] - x[last - i] * x[last - j];
    }
  }
  products.sums.triangularView<Eigen::Upper>() += run;
  products.rows += static_cast<double>(length - order);
}

std::vector<double> standardised(std::span<const double> series, const signal::Spread& spread) {
  std::vector<double> result(series.size());
  std::transform(series.begin(), series.end(), result.begin(),
                 [&](double v) { return (v - spread.mean) / spread.std; });
  return result;
}

Products collect_products(const std::vector<double>& x, std::size_t order) {
  const auto size = static_cast<Eigen::Index>(order + 1);
  Products products{Eigen::MatrixXd::Zero(size, size), 0.0};
  const auto recorded = [](double v) { return std::isfinite(v); };
  for (auto first = x.begin(); first != x.end();) {
    first = std::find_if(first, x.end(), recorded);
    const auto last = std::find_if_not(first, x.end(), recorded);
    if (first != last) {
      add_run(&*first, static_cast<std::size_t>(last - first), order, products);
    }
    first = last;
  }
  return products;
}

}  // namespace

std::optional<ArModel> fit_ar(std::span<const double> series, std::size_t order) {
  const auto spread = signal::measure_spread(series);
  if (!spread || spread->constant()) return std::nullopt;
  const Products products = collect_products(standardised(series, *spread), order);
  const auto coefficients = static_cast<double>(order + 1);
  if (products.rows < kRowsPerCoefficient * coefficients) return std::nullopt;

  const auto size = static_cast<Eigen::Index>(order);
  const Eigen::MatrixXd full = products.sums.selfadjointView<Eigen::Upper>();
  Eigen::MatrixXd past = full.bottomRightCorner(size, size);
  past.diagonal().array() += kRidge * products.rows;
  const Eigen::VectorXd target = full.col(0).tail(size);
  const Eigen::VectorXd solution = past.ldlt().solve(target);
  const double residual = std::max(0.0, full(0, 0) - solution.dot(target));
  // The products are of the series in units of its standard deviation.
  const double share = residual / (products.rows - coefficients);
  if (!solution.allFinite()) return std::nullopt;
  return ArModel{{solution.begin(), solution.end()}, share};
}

std::vector<double> impulse_response(const ArModel& model, std::size_t count) {
  const std::size_t order = model.coefficients.size();
  const std::vector<double> backwards(model.coefficients.rbegin(), model.coefficients.rend());
  const auto terms = static_cast<Eigen::Index>(order);
  // At rest before the impulse.
  std::vector<double> psi(order + count, 0.0);
  if (count > 0) psi[order] = 1.0;
  for (std::size_t k = 1; k < count; ++k) {
    psi[order + k] = ConstSeries(backwards.data(), terms).dot(ConstSeries(&psi[k], terms));
  }
  return {psi.end() - static_cast<std::ptrdiff_t>(count), psi.end()};
}

}  // namespace loopscope::core::loop
