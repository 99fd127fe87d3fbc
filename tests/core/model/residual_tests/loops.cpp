#include "tests/core/model/residual_tests/loops.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/simulate/innovations.hpp"
#include "core/simulate/random.hpp"
#include "tests/generators/values.hpp"

namespace loopscope::core::model::tests {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

double mean_of(const Series& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The sign of the last motion of more than a tenth of op's standard deviation.
Series direction_of(const Series& op) {
  const double band = 0.1 * loopscope::tests::generators::standard_deviation(op);
  Series direction(op.size());
  double turning = op.front();
  double now = 0.0;
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (op[k] > turning + (now > 0.0 ? 0.0 : band)) now = 1.0, turning = op[k];
    if (op[k] < turning - (now < 0.0 ? 0.0 : band)) now = -1.0, turning = op[k];
    direction[k] = now;
  }
  return direction;
}

void modulate(Series& r) {
  for (std::size_t k = 0; k < r.size(); ++k)
    r[k] *= 1.0 + 0.3 * std::sin(6.0 * std::numbers::pi * static_cast<double>(k) /
                                 static_cast<double>(r.size()));
}

void make_garch(Series& r) {
  double variance = 1.0;
  double last = 0.0;
  for (double& value : r) {
    variance = 0.7 + 0.1 * last * last + 0.2 * variance;
    last = value *= std::sqrt(variance);
  }
}

}  // namespace

std::string_view name(White kind) {
  switch (kind) {
    case White::gaussian:
      return "Gaussian";
    case White::exponential:
      return "exponential";
    case White::laplace:
      return "Laplace";
    case White::modulated:
      return "Gaussian, std 0.7 to 1.3";
    case White::garch:
      return "GARCH(1,1) 0.1, 0.2";
    case White::garch_laplace:
      return "GARCH(1,1) 0.1, 0.2, Laplace";
  }
  return "";
}

Series white(White kind, std::size_t samples, std::uint64_t seed) {
  using simulate::Innovation;
  const Innovation law = kind == White::exponential ? Innovation::exponential
                         : kind == White::laplace || kind == White::garch_laplace
                             ? Innovation::laplace
                             : Innovation::gaussian;
  Series r = simulate::innovations(law, samples, seed);
  if (kind == White::modulated) modulate(r);
  if (kind == White::garch || kind == White::garch_laplace) make_garch(r);
  return r;
}

ResidualView Questionable::view() const {
  return {innovation, op_percent, op_direction, response, pv, sample_interval_s};
}

Questionable closed_loop(const Series& innovation, std::uint64_t seed) {
  constexpr std::size_t kMoveEvery = 300;
  simulate::GaussianSource moves(~seed);
  const std::size_t size = innovation.size();
  Questionable loop{innovation, Series(size, 50.0), {}, Series(size), Series(size)};
  double noise = 0.0, x = 0.0, sp = 0.0, last_error = 0.0, op = 0.0;
  for (std::size_t k = 0; k < size; ++k) {
    noise = 0.98 * noise + innovation[k] - (k > 0 ? 0.5 * innovation[k - 1] : 0.0);
    x = 0.8 * x + 0.3 * (k >= 2 ? loop.op_percent[k - 2] - 50.0 : 0.0);
    if (k % kMoveEvery == 0) sp = 2.0 * moves.next();
    const double error = sp - x - noise;
    op += 0.25 * (error - last_error) + 0.05 * error;
    last_error = error;
    loop.op_percent[k] += op;
    loop.response[k] = x;
    loop.pv[k] = 50.0 + x + noise;
  }
  loop.op_direction = direction_of(loop.op_percent);
  return loop;
}

Questionable arx_residual(const simulate::LoopRecord& record) {
  constexpr Eigen::Index kPv = 3, kOp = 10, kStart = 10;
  const auto size = static_cast<Eigen::Index>(record.pv.size());
  const Eigen::ArrayXd pv =
      Eigen::Map<const Eigen::ArrayXd>(record.pv.data(), size) - mean_of(record.pv);
  const Eigen::ArrayXd op =
      Eigen::Map<const Eigen::ArrayXd>(record.op.data(), size) - mean_of(record.op);
  const Eigen::Index rows = size - kStart;
  Eigen::MatrixXd x(rows, kPv + kOp + 1);
  for (Eigen::Index j = 0; j < kPv; ++j) x.col(j) = pv.segment(kStart - 1 - j, rows).matrix();
  for (Eigen::Index j = 0; j < kOp; ++j) x.col(kPv + j) = op.segment(kStart - 1 - j, rows).matrix();
  x.rightCols(1).setOnes();
  const Eigen::VectorXd fit =
      (x.transpose() * x).ldlt().solve(x.transpose() * pv.tail(rows).matrix());
  const Eigen::VectorXd r = pv.tail(rows).matrix() - x * fit;

  Questionable loop{Series(record.pv.size(), kMissing), record.op, direction_of(record.op),
                    Series(record.pv.size(), 0.0),      record.pv, record.sample_interval_s};
  for (Eigen::Index k = kStart; k < size; ++k) {
    loop.innovation[static_cast<std::size_t>(k)] = r[k - kStart];
    double& answer = loop.response[static_cast<std::size_t>(k)];
    answer = fit[kPv + kOp];
    for (Eigen::Index j = 0; j < kPv; ++j)
      answer += fit[j] * loop.response[static_cast<std::size_t>(k - 1 - j)];
    for (Eigen::Index j = 0; j < kOp; ++j) answer += fit[kPv + j] * op[k - 1 - j];
  }
  return loop;
}

const TestOutcome* answer_of(const std::vector<TestOutcome>& answers, std::string_view question) {
  const auto found = std::find_if(
      answers.begin(), answers.end(),
      [question](const TestOutcome& answer) { return answer.question.name == question; });
  return found == answers.end() ? nullptr : &*found;
}

double p_of(const std::vector<TestOutcome>& answers, std::string_view question) {
  const TestOutcome* answer = answer_of(answers, question);
  return answer == nullptr ? kMissing : answer->question.p;
}

const Nomination* nomination_of(const std::vector<TestOutcome>& answers, std::string_view question,
                                EffectKind effect) {
  const TestOutcome* answer = answer_of(answers, question);
  if (answer == nullptr) return nullptr;
  const auto found =
      std::find_if(answer->nominations.begin(), answer->nominations.end(),
                   [effect](const Nomination& nomination) { return nomination.effect == effect; });
  return found == answer->nominations.end() ? nullptr : &*found;
}

void add_sinusoid(Series& signal, double period, double amplitude) {
  for (std::size_t k = 0; k < signal.size(); ++k)
    signal[k] += amplitude * std::sin(2.0 * std::numbers::pi * static_cast<double>(k) / period);
}

}  // namespace loopscope::core::model::tests
