#include "core/model/fit/newton_step.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "core/model/response/whitening.hpp"
#include "core/model/vectors/number_pair.hpp"
#include "core/model/vectors/recursion-inl.hpp"

namespace loopscope::core::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Where a nonlinear parameter of a structure lives, and how far it may go.
struct Handle {
  enum class Kind { noise_pole, noise_zero, process_pole };
  Kind kind;
  double* value;
  double low, high;
  std::size_t index = 0;  ///< of a noise zero: its power of z^-1, less one
};

std::vector<Handle> handles_of(Structure& structure) {
  using enum Handle::Kind;
  constexpr double kAnywhere = 4.0;  // make_invertible() holds the zeros
  std::vector<Handle> handles;
  for (std::size_t i = 0; i < structure.noise.order; ++i) {
    handles.push_back({noise_pole, &structure.noise.poles[i], -0.95, 1.0});
    handles.push_back({noise_zero, &structure.noise.zeros[i], -kAnywhere, kAnywhere, i});
  }
  ProcessShape& process = structure.process;
  if (!process.integrating) handles.push_back({process_pole, &process.pole, 0.0, 0.999});
  if (structure.second_order) handles.push_back({process_pole, &process.second_pole, 0.0, 0.995});
  return handles;
}

/// -z^-1 / (1 - root z^-1) of the signals that two handles move.
void fill_pair(const Handle& a, const Handle& b, Signal signal_a, Signal signal_b, double* out_a,
               double* out_b, std::size_t samples) {
  run_recursion(
      NumberPair{*a.value, *b.value}, NumberPair{}, samples,
      [&](std::size_t k) {
        return k == 0 ? NumberPair{} : NumberPair{signal_a[k - 1], signal_b[k - 1]};
      },
      [&](std::size_t k, NumberPair value) {
        out_a[k] = -value[0];
        out_b[k] = -value[1];
      });
}

/// The errors through 1 / C(z), at rest before the record: all zeros move shifts of it.
VectorXd behind_zeros(const NoiseModel& noise, const VectorXd& errors) {
  VectorXd result(errors.size());
  double y1 = 0.0, y2 = 0.0, y3 = 0.0;
  for (Index k = 0; k < errors.size(); ++k) {
    const double known = errors[k] - noise.zeros[1] * y2 - noise.zeros[2] * y3;
    const double y = known - noise.zeros[0] * y1;
    result[k] = y;
    y3 = y2;
    y2 = y1;
    y1 = y;
  }
  return result;
}

void fill_zeros(const NoiseModel& noise, const VectorXd& errors, const std::vector<Handle>& handles,
                MatrixXd& result) {
  const VectorXd behind = behind_zeros(noise, errors);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (handles[h].kind != Handle::Kind::noise_zero) continue;
    const auto shift = std::min(static_cast<Index>(handles[h].index + 1), errors.size());
    auto column = result.col(static_cast<Index>(h));
    column.head(shift).setZero();
    column.tail(errors.size() - shift) = -behind.head(errors.size() - shift);
  }
}

/// What a process pole moves where the rows are fewer than the samples: the answer passes the pole
/// at the rate of op, and is whitened at that of the rows.
void fill_process_pole(const LoopData& data, const Solution& solution, const NoiseModel& noise,
                       const Handle& pole, std::span<double> result) {
  std::vector<double> answer = solution.design.response;
  weigh({solution.coefficients[0], 0.0}, answer);
  std::vector<double> moved(answer.size());
  fill_pair(pole, pole, answer.data(), answer.data(), moved.data(), moved.data(), moved.size());
  keep_rows(data.grid, moved);
  whiten(noise, moved, result);
}

MatrixXd sensitivities(const LoopData& data, const Solution& solution, const Structure& structure,
                       const std::vector<Handle>& handles) {
  const Index samples = solution.errors.size();
  MatrixXd result(samples, static_cast<Index>(handles.size()));
  fill_zeros(structure.noise, solution.errors, handles, result);
  const VectorXd answer =
      solution.design.answers() * solution.coefficients.head(solution.design.taps);
  const auto moved = [&](std::size_t h) {
    return handles[h].kind == Handle::Kind::process_pole ? answer.data() : solution.errors.data();
  };
  std::vector<std::size_t> poles;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (handles[h].kind == Handle::Kind::process_pole && !data.grid.every_sample()) {
      fill_process_pole(data, solution, structure.noise, handles[h],
                        column(result, static_cast<Index>(h)));
    } else if (handles[h].kind != Handle::Kind::noise_zero) {
      poles.push_back(h);
    }
  }
  for (std::size_t i = 0; i < poles.size(); i += 2) {
    // An odd one out runs beside itself.
    const std::size_t h = poles[i], other = poles[std::min(i + 1, poles.size() - 1)];
    fill_pair(handles[h], handles[other], moved(h), moved(other),
              result.col(static_cast<Index>(h)).data(),
              result.col(static_cast<Index>(other)).data(), static_cast<std::size_t>(samples));
  }
  return result;
}

/// Products over the fit rows of regressors and sensitivities with one another, and with the errors
/// in the last column. Those of the regressors are known from the solution.
MatrixXd joint_products(const LoopData& data, const Solution& solution, const MatrixXd& moves) {
  const Index terms = solution.design.terms();
  const Index count = moves.cols();
  std::vector<Signal> right = solution.design.columns();
  right[0] = solution.errors.data();
  std::vector<Signal> left;
  for (Index h = 0; h < count; ++h) left.push_back(moves.col(h).data());
  const MatrixXd crossed = products(left, right, data.rows.fit);

  MatrixXd joint(terms + count, terms + count + 1);
  const auto known = solution.normal.bottomRightCorner(terms, terms);
  joint.topLeftCorner(terms, terms) = known;
  joint.col(terms + count).head(terms) =
      solution.normal.col(0).tail(terms) - known * solution.coefficients;
  joint.col(terms + count).tail(count) = crossed.col(0);
  joint.block(terms, 0, count, terms) = crossed.rightCols(terms);
  joint.block(0, terms, terms, count) = crossed.rightCols(terms).transpose();
  joint.block(terms, terms, count, count) = products(left, data.rows.fit);
  return joint;
}

VectorXd scale_of(const MatrixXd& normal) {
  const VectorXd diagonal = normal.diagonal().array() + kPrior;
  return diagonal.cwiseSqrt().cwiseInverse();
}

Eigen::LDLT<MatrixXd> factors_of(const MatrixXd& normal, const VectorXd& scale) {
  MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  scaled.diagonal().setOnes();
  scaled.diagonal().array() += kRidge;
  return scaled.ldlt();
}

}  // namespace

VectorXd solve_normal(const MatrixXd& normal, const VectorXd& right) {
  const VectorXd scale = scale_of(normal);
  return scale.asDiagonal() * factors_of(normal, scale).solve(scale.asDiagonal() * right);
}

MatrixXd inverse_of_normal(const MatrixXd& normal) {
  const VectorXd scale = scale_of(normal);
  return scale.asDiagonal() * factors_of(normal, scale).solve(MatrixXd(scale.asDiagonal()));
}

NewtonStep::NewtonStep(const LoopData& data, const Solution& solution, const Structure& structure)
    : structure_(structure),
      squares_(solution.fit_error * static_cast<double>(data.rows.fit_count())),
      joint_(joint_products(data, solution,
                            sensitivities(data, solution, structure, handles_of(structure_)))) {}

NextStructure NewtonStep::take(double damping) const {
  NextStructure next{structure_};
  const std::vector<Handle> handles = handles_of(next.structure);
  const auto count = static_cast<Index>(handles.size());
  const Index size = joint_.rows();
  MatrixXd damped = joint_.leftCols(size);
  damped.diagonal().tail(count) *= 1.0 + damping;
  const VectorXd step = -solve_normal(damped, joint_.col(size));
  next.promise = squares_ > 0.0 ? -step.dot(joint_.col(size)) / squares_ : 0.0;
  const auto moves = step.tail(count);
  for (Index h = 0; h < count; ++h) {
    const Handle& handle = handles[static_cast<std::size_t>(h)];
    *handle.value = std::clamp(*handle.value + moves(h), handle.low, handle.high);
  }
  make_invertible(next.structure.noise);
  return next;
}

}  // namespace loopscope::core::model
