#include "core/model/selection/multi_step_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace loopscope::core::model {
namespace {

constexpr std::size_t kMostAhead = 10;
constexpr std::size_t kFewestAhead = 3;
constexpr std::size_t kRowsPerAhead = 200;

std::size_t rows_ahead(const LoopData& rows) {
  return std::clamp(rows.rows.score_count() / kRowsPerAhead, kFewestAhead, kMostAhead);
}

std::vector<double> impulse_response(const NoiseModel& noise, std::size_t count) {
  const auto a = autoregression(noise);
  std::vector<double> psi(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    if (k == 0) psi[k] = 1.0;
    if (k > 0 && k <= kMostNoiseOrder) psi[k] = noise.zeros[k - 1];
    for (std::size_t i = 1; i <= std::min(k, kMostNoiseOrder); ++i) psi[k] -= a[i - 1] * psi[k - i];
  }
  return psi;
}

/// Sum of squares over the held-out rows whose errors are all held out.
double squares_ahead(const std::vector<Range>& held_out, const Fit& fit, std::size_t ahead) {
  const std::vector<double> psi = impulse_response(fit.structure.noise, ahead);
  double sum = 0.0;
  for (const Range& range : held_out) {
    for (std::size_t k = range.first + ahead - 1; k < range.end; ++k) {
      double error = 0.0;
      for (std::size_t j = 0; j < ahead; ++j) error += psi[j] * fit.innovations[k - j];
      sum += error * error;
    }
  }
  return sum;
}

}  // namespace

double multi_step_evidence(const LoopData& rows, const Fit& before, const Fit& after) {
  const std::size_t ahead = rows_ahead(rows);
  const double ratio =
      squares_ahead(rows.rows.score, before, ahead) / squares_ahead(rows.rows.score, after, ahead);
  const double apart = static_cast<double>(rows.rows.score_count()) / static_cast<double>(ahead);
  return ratio > 0.0 ? apart * std::log(ratio) : 0.0;
}

}  // namespace loopscope::core::model
