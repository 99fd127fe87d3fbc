#include "core/model/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace loopscope::core::model {
namespace {

using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Collinear columns (a PI law ties op to pv) share their weight instead of breaking the solution.
constexpr double kRidge = 1e-9;

/// The whitened columns of a structure: pv, numerator, effects, offset, and zeros up to the width.
struct Design {
  Table table;
  Index used = 0;           ///< columns in use, pv included
  Index taps = 1;  ///< of these, after pv, the answer of the process to flow
};

std::vector<double> flow_of(const LoopData& data, const Structure& structure) {
  std::vector<double> flow = data.op;
  for (const EffectPtr& effect : structure.effects) effect->shape_flow(flow);
  return flow;
}

void put(Table& table, Index column, const std::vector<double>& values, std::size_t shift = 0) {
  const auto n = static_cast<std::size_t>(table.rows());
  for (std::size_t k = 0; k < n; ++k) {
    table(static_cast<Index>(k), column) = values[k < shift ? 0 : k - shift];
  }
}

std::vector<Column> effect_columns(const Structure& structure, const std::vector<double>& flow) {
  std::vector<Column> columns;
  std::vector<double> response;
  for (const EffectPtr& effect : structure.effects) {
    if (effect->column_count() == 0) continue;
    if (response.empty()) response = answer(structure.process, flow);
    effect->add_columns({flow, response, structure.process}, columns);
  }
  return columns;
}

Design make_design(const LoopData& data, const Structure& structure) {
  const std::vector<double> flow = flow_of(data, structure);
  std::vector<double> response(data.size());
  respond(structure.process, flow, response);
  const std::vector<Column> extra = effect_columns(structure, flow);
  const std::size_t taps = structure.two_taps ? 2 : 1;
  const std::size_t used = 1 + taps + extra.size() + 1 + (structure.process.integrating ? 1 : 0);
  const std::size_t width = (used + 3) / 4 * 4;
  Design design;
  design.used = static_cast<Index>(used);
  design.taps = static_cast<Index>(taps);
  design.table.setZero(static_cast<Index>(data.size()), static_cast<Index>(width));
  put(design.table, 0, data.pv);
  put(design.table, 1, response);
  if (structure.two_taps) put(design.table, 2, response, 1);
  for (std::size_t c = 0; c < extra.size(); ++c) put(design.table, static_cast<Index>(1 + taps + c), extra[c]);
  const auto offset = static_cast<Index>(1 + taps + extra.size());
  design.table.col(offset).setOnes();
  if (structure.process.integrating) {
    design.table.col(offset + 1) = VectorXd::LinSpaced(design.table.rows(), -1.0, 1.0);
  }
  whiten(structure.noise, {design.table.data(), static_cast<std::size_t>(design.table.size())}, width);
  return design;
}

/// Sum over the rows of row' row. The rows are gathered first: one product of two tall tables runs
/// several times faster than one for each of the many short blocks.
MatrixXd gram(const Table& table, Index columns, const std::vector<Range>& rows) {
  Index count = 0;
  for (const Range& range : rows) count += static_cast<Index>(range.size());
  Table gathered(count, columns);
  Index next = 0;
  for (const Range& range : rows) {
    const auto size = static_cast<Index>(range.size());
    gathered.middleRows(next, size) = table.block(static_cast<Index>(range.first), 0, size, columns);
    next += size;
  }
  return gathered.transpose() * gathered;
}

VectorXd solve(const MatrixXd& normal, const VectorXd& right) {
  const VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  scaled.diagonal().array() += kRidge;
  return scale.asDiagonal() * scaled.ldlt().solve(scale.asDiagonal() * right);
}

double mean_square(const std::vector<double>& values, const std::vector<Range>& rows) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Range& range : rows) {
    for (std::size_t k = range.first; k < range.end; ++k) sum += values[k] * values[k];
    count += range.size();
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

struct Solution {
  Design design;
  VectorXd coefficients;
  VectorXd errors;
  double fit_error = 0.0;
};

Solution solve_structure(const LoopData& data, const Structure& structure) {
  Solution solution;
  solution.design = make_design(data, structure);
  const Index columns = solution.design.used - 1;
  const MatrixXd normal = gram(solution.design.table, solution.design.used, data.rows.fit);
  solution.coefficients = solve(normal.block(1, 1, columns, columns), normal.block(1, 0, columns, 1));
  solution.errors = solution.design.table.col(0) -
                    solution.design.table.middleCols(1, columns) * solution.coefficients;
  const std::vector<double> errors(solution.errors.begin(), solution.errors.end());
  solution.fit_error = mean_square(errors, data.rows.fit);
  return solution;
}

/// Where the nonlinear parameters of a structure live, and how far they may go.
struct Handle {
  enum class Kind { noise_pole, noise_zero, pole, second_pole } kind;
  std::size_t index = 0;
  double low = 0.0, high = 0.0;

  [[nodiscard]] double& of(Structure& structure) const {
    switch (kind) {
      case Kind::noise_pole: return structure.noise.poles[index];
      case Kind::noise_zero: return structure.noise.zeros[index];
      case Kind::pole: return structure.process.pole;
      case Kind::second_pole: break;
    }
    return structure.process.second_pole;
  }
};

std::vector<Handle> handles_of(const Structure& structure) {
  using Kind = Handle::Kind;
  constexpr double kAnywhere = 4.0;  // make_invertible() holds the zeros
  std::vector<Handle> handles;
  for (std::size_t i = 0; i < structure.noise.order; ++i) {
    handles.push_back({Kind::noise_pole, i, -0.95, 1.0});
    handles.push_back({Kind::noise_zero, i, -kAnywhere, kAnywhere});
  }
  if (!structure.process.integrating) handles.push_back({Kind::pole, 0, 0.0, 0.999});
  if (structure.second_order) handles.push_back({Kind::second_pole, 0, 0.0, 0.995});
  return handles;
}

/// -z^-1 / (1 - root z^-1) of a signal.
void lag_sensitivity(double root, const VectorXd& signal, double* out, Index stride) {
  double state = 0.0;
  double before = 0.0;
  for (Index k = 0; k < signal.size(); ++k) {
    state = root * state + before;
    out[k * stride] = -state;
    before = signal[k];
  }
}

/// -z^-(index + 1) / C(z) of a signal.
void zero_sensitivity(const NoiseModel& noise, std::size_t index, const VectorXd& signal, double* out, Index stride) {
  double y1 = 0.0, y2 = 0.0, y3 = 0.0;
  const auto shift = static_cast<Index>(index + 1);
  for (Index k = 0; k < signal.size(); ++k) {
    const double input = k < shift ? 0.0 : signal[k - shift];
    const double y = input - noise.zeros[0] * y1 - noise.zeros[1] * y2 - noise.zeros[2] * y3;
    out[k * stride] = -y;
    y3 = y2;
    y2 = y1;
    y1 = y;
  }
}

Table sensitivities(const Solution& solution, Structure structure, const std::vector<Handle>& handles) {
  Table result(solution.errors.size(), static_cast<Index>(handles.size()));
  const VectorXd answer = solution.design.table.middleCols(1, solution.design.taps) * solution.coefficients.head(solution.design.taps);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    double* out = result.data() + h;
    switch (handles[h].kind) {
      case Handle::Kind::noise_pole: lag_sensitivity(handles[h].of(structure), solution.errors, out, result.cols()); break;
      case Handle::Kind::noise_zero: zero_sensitivity(structure.noise, handles[h].index, solution.errors, out, result.cols()); break;
      default: lag_sensitivity(handles[h].of(structure), answer, out, result.cols());
    }
  }
  return result;
}

/// The Gauss-Newton step of the nonlinear parameters, the coefficients following.
VectorXd newton_step(const LoopData& data, const Solution& solution, const Structure& structure,
                     const std::vector<Handle>& handles, double damping) {
  const Index columns = solution.design.used - 1;
  const auto count = static_cast<Index>(handles.size());
  Table joint(solution.errors.size(), 1 + columns + count);
  joint.col(0) = solution.errors;
  joint.middleCols(1, columns) = solution.design.table.middleCols(1, columns);
  joint.rightCols(count) = sensitivities(solution, structure, handles);
  MatrixXd normal = gram(joint, joint.cols(), data.rows.fit);
  normal.diagonal().tail(count) *= 1.0 + damping;
  const VectorXd step = solve(normal.block(1, 1, columns + count, columns + count),
                              -normal.block(1, 0, columns + count, 1));
  return step.tail(count);
}

/// The numerator that the last fit found, of gain 1; a gain of about nothing has none.
std::array<double, 2> numerator_of(const Structure& structure, const VectorXd& coefficients) {
  if (!structure.two_taps) return {1.0, 0.0};
  const double sum = coefficients[0] + coefficients[1];
  const double size = std::abs(coefficients[0]) + std::abs(coefficients[1]);
  if (std::abs(sum) < 0.05 * size) return {1.0, 0.0};
  return {coefficients[0] / sum, coefficients[1] / sum};
}

Structure moved(Structure structure, const std::vector<Handle>& handles, const VectorXd& step, double share) {
  for (std::size_t h = 0; h < handles.size(); ++h) {
    double& value = handles[h].of(structure);
    value = std::clamp(value + share * step(static_cast<Index>(h)), handles[h].low, handles[h].high);
  }
  make_invertible(structure.noise);
  return structure;
}

Fit finished(const LoopData& data, const Structure& structure, const Solution& solution) {
  Fit fit;
  fit.structure = structure;
  fit.coefficients.assign(solution.coefficients.begin(), solution.coefficients.end());
  fit.innovations.assign(solution.errors.begin(), solution.errors.end());
  fit.fit_error = solution.fit_error;
  fit.score_error = mean_square(fit.innovations, data.rows.score);
  fit.structure.process.numerator = numerator_of(structure, solution.coefficients);
  return fit;
}

}  // namespace

Fit evaluate(const LoopData& data, const Structure& structure) {
  return finished(data, structure, solve_structure(data, structure));
}

std::vector<double> deterministic_output(const LoopData& data, const Fit& fit) {
  Structure structure = fit.structure;
  structure.noise = {1, {}, {}};
  const Design design = make_design(data, structure);
  const Eigen::Map<const VectorXd> coefficients(fit.coefficients.data(), static_cast<Index>(fit.coefficients.size()));
  const VectorXd output = design.table.middleCols(1, design.used - 1) * coefficients;
  return {output.begin(), output.end()};
}

Fit polish(const LoopData& data, const Structure& start, int iterations) {
  constexpr double kWorthwhile = 1e-4;  // relative gain of a step below which the fit has settled
  Structure structure = start;
  Solution solution = solve_structure(data, structure);
  const std::vector<Handle> handles = handles_of(structure);
  double damping = 1e-3;
  for (int i = 0; i < iterations; ++i) {
    const VectorXd step = newton_step(data, solution, structure, handles, damping);
    const Structure next = moved(structure, handles, step, 1.0);
    Solution tried = solve_structure(data, next);
    if (tried.fit_error < solution.fit_error) {
      const double gained = 1.0 - tried.fit_error / solution.fit_error;
      structure = next;
      structure.process.numerator = numerator_of(structure, tried.coefficients);
      solution = std::move(tried);
      damping *= 0.1;
      if (gained < kWorthwhile) break;
    } else {
      damping = std::max(damping * 30.0, 1e-2);
      if (damping > 1e3) break;
    }
  }
  return finished(data, structure, solution);
}

}  // namespace loopscope::core::model
