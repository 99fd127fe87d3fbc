#include "core/hos/linear/draw_missing.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "core/hos/linear/linear_model.hpp"
#include "core/hos/linear/prediction_errors.hpp"
#include "core/hos/numeric/magnitude.hpp"
#include "core/hos/numeric/normal_draw.hpp"

namespace loopscope::core::hos {
namespace {

/// Fits and draws in turn. The guesses are forgotten at the rate of the share that is missing: at
/// two thirds, 25 turns leave 4e-5 of them.
constexpr int kTurns = 25;
/// Free draws of a run before it is drawn sample by sample within its bounds, and sweeps then: the
/// turns are sweeps as well.
constexpr int kFreeDraws = 3;
constexpr int kSweeps = 5;
/// Longer runs are drawn in pieces, since the work of one grows with its cube.
constexpr std::size_t kLongestRun = 32;

struct Run {
  std::size_t first;
  Eigen::Index count;
};

std::vector<Run> runs_of(std::span<const double> record, const Holes& holes) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < record.size(); ++k) {
    if (std::isnan(holes.low[k]) || !std::isfinite(record[k])) continue;
    const bool goes_on = !runs.empty() &&
                         runs.back().first + static_cast<std::size_t>(runs.back().count) == k &&
                         static_cast<std::size_t>(runs.back().count) < kLongestRun;
    if (goes_on) {
      ++runs.back().count;
    } else {
      runs.push_back({k, 1});
    }
  }
  return runs;
}

std::vector<double> over(std::vector<double> values, double scale) {
  for (double& value : values) value /= scale;
  return values;
}

/// The record while it is being drawn.
class Drawing {
 public:
  Drawing(std::vector<double> record, Holes holes, std::uint64_t seed)
      : record_(std::move(record)), holes_(std::move(holes)), random_(seed) {}

  /// False when the record carries no model.
  bool turn(const std::vector<Run>& runs) {
    const std::optional<LinearModel> model = LinearModel::fit(record_);
    if (!model) return false;
    PredictionErrors errors(record_, model->coefficients(), mean());
    const double std = std::sqrt(errors.variance());
    if (!(std > 0.0)) return false;
    for (const Run& run : runs) draw(run, std, errors);
    return true;
  }

  [[nodiscard]] std::vector<double> take() { return std::move(record_); }

 private:
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    double count = 0.0;
    for (const double value : record_) {
      if (!std::isfinite(value)) continue;
      sum += value;
      count += 1.0;
    }
    return sum / std::max(count, 1.0);
  }

  /// A whole piece between bounds, which a free draw never meets with all its samples.
  [[nodiscard]] bool is_bounded_piece(const Run& run) const {
    if (run.count < static_cast<Eigen::Index>(kLongestRun)) return false;
    for (std::size_t k = run.first; k < run.first + kLongestRun; ++k) {
      if (!std::isfinite(holes_.low[k]) || !std::isfinite(holes_.high[k])) return false;
    }
    return true;
  }

  [[nodiscard]] bool within_bounds(const Run& run, const Eigen::VectorXd& change) const {
    for (Eigen::Index i = 0; i < run.count; ++i) {
      const std::size_t k = run.first + static_cast<std::size_t>(i);
      const double value = record_[k] + change[i];
      if (value < holes_.low[k] || value > holes_.high[k]) return false;
    }
    return true;
  }

  void draw(const Run& run, double std, PredictionErrors& errors) {
    Eigen::VectorXd gradient(run.count);
    Eigen::MatrixXd curvature(run.count, run.count);
    errors.expand(run.first, gradient, curvature);
    if (!(curvature.diagonal().minCoeff() > 0.0)) return;
    Eigen::VectorXd change;
    if (is_bounded_piece(run)) {
      change = draw_within(run, curvature.selfadjointView<Eigen::Lower>(), gradient, std);
    } else {
      const Eigen::LLT<Eigen::MatrixXd> factor(curvature);
      if (factor.info() != Eigen::Success) return;
      if (!draw_freely(run, factor, gradient, std, change)) {
        change = draw_within(run, curvature.selfadjointView<Eigen::Lower>(), gradient, std);
      }
    }
    for (Eigen::Index i = 0; i < run.count; ++i) {
      record_[run.first + static_cast<std::size_t>(i)] += change[i];
    }
    errors.change(run.first, change);
  }

  /// About the most probable values, with the covariance std^2 curvature^-1; false when no draw lay
  /// within the bounds.
  bool draw_freely(const Run& run, const Eigen::LLT<Eigen::MatrixXd>& factor,
                   const Eigen::VectorXd& gradient, double std, Eigen::VectorXd& change) {
    Eigen::VectorXd noise(gradient.size());
    for (int i = 0; i < kFreeDraws; ++i) {
      for (double& value : noise) value = std * normal_draw(random_);
      change = factor.matrixU().solve(noise) - factor.solve(gradient);
      if (within_bounds(run, change)) return true;
    }
    return false;
  }

  /// One sample after the other, each given the others (Gibbs).
  Eigen::VectorXd draw_within(const Run& run, const Eigen::MatrixXd& curvature,
                              Eigen::VectorXd gradient, double std) {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(run.count);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (Eigen::Index i = 0; i < run.count; ++i) {
        const std::size_t k = run.first + static_cast<std::size_t>(i);
        const double most_probable = change[i] - gradient[i] / curvature(i, i);
        const double drawn =
            normal_draw_within(record_[k] + most_probable, std / std::sqrt(curvature(i, i)),
                               holes_.low[k], holes_.high[k], random_) -
            record_[k];
        gradient += (drawn - change[i]) * curvature.col(i);
        change[i] = drawn;
      }
    }
    return change;
  }

  std::vector<double> record_;
  Holes holes_;
  std::mt19937_64 random_;
};

}  // namespace

std::vector<double> draw_missing(std::span<const double> record, const Holes& holes,
                                 std::uint64_t seed) {
  std::vector<double> drawn(record.begin(), record.end());
  if (holes.empty()) return drawn;
  const std::vector<Run> runs = runs_of(record, holes);
  if (runs.empty()) return drawn;
  // The model's squares would overflow or vanish for samples of 1e300 or 1e-300.
  const double scale = power_of_two_below(largest_magnitude(record));
  Drawing drawing(over(std::move(drawn), scale), {over(holes.low, scale), over(holes.high, scale)},
                  seed);
  for (int i = 0; i < kTurns; ++i) {
    if (!drawing.turn(runs)) break;
  }
  return over(drawing.take(), 1.0 / scale);
}

}  // namespace loopscope::core::hos
