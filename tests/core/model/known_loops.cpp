#include "tests/core/model/known_loops.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <numeric>
#include <random>

#include "core/model/controller/closed_loop.hpp"
#include "core/model/controller/simc.hpp"
#include "core/simulate/random.hpp"
#include "core/simulate/scenario.hpp"

namespace loopscope::core::model::known {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(engine_);
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }

 private:
  std::mt19937_64 engine_;
};

ProcessFit fit_of(const simulate::ProcessModel& model) {
  ProcessFit fit;
  fit.delay_s = static_cast<double>(model.delay_samples);
  fit.integrating = model.pole >= 1.0;
  fit.gain = (model.b0 + model.b1) / (fit.integrating ? 1.0 : 1.0 - model.pole);
  fit.time_constant_s = fit.integrating ? 0.0 : -1.0 / std::log(model.pole);
  return fit;
}

simulate::ProcessModel random_process(Draw& draw, bool integrating) {
  simulate::ProcessModel model{.delay_samples = static_cast<std::size_t>(draw.between(1.0, 11.0)),
                               .b0 = draw.log_between(0.4, 4.0),
                               .b1 = 0.0,
                               .pole = std::exp(-1.0 / draw.log_between(1.0, 33.0))};
  if (integrating) model.pole = 1.0;
  model.b0 *= integrating ? 0.03 : 1.0 - model.pole;
  return model;
}

KnownLoop draw_loop(Draw& draw) {
  KnownLoop loop;
  const bool integrating = draw.between(0.0, 3.0) < 1.0;
  loop.settings.process = random_process(draw, integrating);
  loop.process = fit_of(loop.settings.process);
  const ControllerLaw simc = simc_law(loop.process, 1.0);
  const double aggressive = draw.log_between(0.1, 2.0);
  loop.law = law(simc.gain * aggressive, simc.integral * aggressive * draw.between(0.5, 1.5) *
                                             (integrating ? aggressive : 1.0));
  loop.settings.controller = {.gain = loop.law.gain, .integral = loop.law.integral};
  const bool at_input = integrating || draw.between(0.0, 1.0) < 0.3;
  loop.settings.load = {
      .step_std = 0.1,
      .memory = draw.between(0.0, 1.0) < 0.3 ? 1.0 : draw.between(0.9, 0.995),
      .entry = at_input ? simulate::LoadEntry::process_input : simulate::LoadEntry::process_output};
  loop.settings.measurement_noise_std = std::max(0.0, draw.between(-0.05, 0.1));
  return loop;
}

double mean(const Series& series) {
  return std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
}

}  // namespace

void Records::renew_error() {
  for (std::size_t k = 0; k < pv.size(); ++k) error[k] = sp[k] - pv[k];
}

KnownLoop scenario(std::string_view name) {
  KnownLoop loop;
  loop.settings = simulate::scenario_loop(name);
  loop.process = fit_of(loop.settings.process);
  loop.law = law(loop.settings.controller.gain, loop.settings.controller.integral);
  return loop;
}

KnownLoop random_loop(std::uint64_t seed) {
  constexpr double kMostSensitive = 8.0;
  Draw draw(seed);
  for (;;) {
    KnownLoop loop = draw_loop(draw);
    if (close_loop(loop.process, loop.law, 1.0).peak_sensitivity < kMostSensitive) return loop;
  }
}

ControllerLaw law(double gain, double integral, std::size_t lag) {
  ControllerLaw result;
  result.found = true;
  result.gain = gain;
  result.integral = integral;
  result.lag = lag;
  return result;
}

Records run(const simulate::LoopSettings& settings, std::uint64_t seed) {
  simulate::LoopRecord record = simulate::simulate_loop(settings, seed);
  Series error = simulate::control_error(record);
  return {std::move(error), std::move(record.sp), std::move(record.op), std::move(record.pv)};
}

void blur(Records& records, double op_step, double pv_noise, std::uint64_t seed) {
  if (op_step > 0.0) {
    for (double& op : records.op) op = op_step * std::round(op / op_step);
  }
  double squares = 0.0;
  for (const double e : records.error) squares += e * e / static_cast<double>(records.error.size());
  simulate::GaussianSource noise(seed);
  for (double& pv : records.pv) pv += pv_noise * std::sqrt(squares) * noise.next();
  records.renew_error();
}

ControllerLaw find_law(const Records& records) {
  return find_controller_law(records.view());
}

ProcessFit off_by_a_fifth(ProcessFit fit, std::uint64_t seed) {
  Draw draw(seed);
  fit.gain *= draw.between(0.8, 1.2);
  fit.time_constant_s *= draw.between(0.8, 1.2);
  fit.second_time_constant_s *= draw.between(0.8, 1.2);
  return fit;
}

SampledProcess paper_process() {
  return {{1.45, -1.0}, {1.0, -0.8}, 3};
}

SampledProcess fit_without_delay(const Records& records, int order) {
  const int terms = 2 * order + 1;
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::VectorXd cross = Eigen::VectorXd::Zero(terms);
  const double pv_mean = mean(records.pv), op_mean = mean(records.op);
  for (std::size_t k = static_cast<std::size_t>(order); k < records.pv.size(); ++k) {
    Eigen::VectorXd x(terms);
    for (int i = 0; i < order; ++i)
      x[i] = records.pv[k - 1 - static_cast<std::size_t>(i)] - pv_mean;
    for (int i = 0; i <= order; ++i)
      x[order + i] = records.op[k - static_cast<std::size_t>(i)] - op_mean;
    squares += x * x.transpose();
    cross += x * (records.pv[k] - pv_mean);
  }
  const Eigen::VectorXd c = squares.ldlt().solve(cross);
  SampledProcess fit{{}, {1.0}, 0};
  for (int i = 0; i < order; ++i) fit.denominator.push_back(-c[i]);
  for (int i = 0; i <= order; ++i) fit.numerator.push_back(c[order + i]);
  return fit;
}

}  // namespace loopscope::core::model::known
