#include "tests/effects/explainable.hpp"

#include <Eigen/Dense>
#include <memory>
#include <utility>

namespace loopscope::tests::effects {
namespace {

/// Left to the start of the process and of the filter, neither of which is known.
constexpr std::size_t kSettling = kSamples / 10;

/// One-step errors of the past that the next is foretold from: more than a noise model of the order
/// that a record of this length bears.
constexpr int kPast = 12;

using Columns = std::vector<std::vector<double>>;

/// Plays a recorded op, and before it its first value so that the lags start at rest.
class Played final : public Valve {
 public:
  explicit Played(std::vector<double> op) : op_(std::move(op)) {}
  double step(double) override {
    const std::size_t sample = substep_++ / kSubsteps;
    return sample < kRunIn ? op_.front() : op_[sample - kRunIn];
  }

 private:
  std::vector<double> op_;
  std::size_t substep_ = 0;
};

/// pv of the linear process without load and noise, open loop.
std::vector<double> response(const Process& linear, const std::vector<double>& op) {
  Scenario open_loop;
  open_loop.process = linear;
  open_loop.controller.kc = 0.0;
  open_loop.op0 = op.front();
  open_loop.sp.assign(kRunIn + kSamples, 0.0);
  open_loop.valve = [&op] { return std::make_unique<Played>(op); };
  return simulate(open_loop).pv;
}

double white_variance(const Scenario& scenario) {
  return scenario.noise_sd * scenario.noise_sd + scenario.quantum * scenario.quantum / 12.0;
}

std::vector<double> earlier(std::vector<double> values) {
  values.insert(values.begin(), values.front());
  values.pop_back();
  return values;
}

std::vector<double> ramp() {
  std::vector<double> values;
  for (std::size_t k = 0; k < kSamples; ++k)
    values.push_back(static_cast<double>(k) / static_cast<double>(kSamples));
  return values;
}

/// What a linear model of pv may be made of.
Columns regressors(const Process& linear, const std::vector<double>& op) {
  const std::vector<double> now = response(linear, op);
  Columns all = {now, earlier(now), std::vector<double>(kSamples, 1.0)};
  if (linear.integrating) all.push_back(ramp());
  return all;
}

Predictor filter_of(const Scenario& scenario) {
  return predictor(scenario.load, white_variance(scenario), scenario.hold);
}

std::vector<double> less(std::vector<double> values, const std::vector<double>& other) {
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= other[k];
  return values;
}

/// A noise model that is fitted to the record foresees of an effect what lasts longer than a
/// sample.
void add_past(Columns& columns, std::vector<double> unforeseen) {
  for (int i = 0; i < kPast; ++i) columns.push_back(unforeseen = earlier(std::move(unforeseen)));
}

Eigen::VectorXd vector_of(const std::vector<double>& values, std::size_t first) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()))
      .tail(static_cast<Eigen::Index>(values.size() - first));
}

/// Mean square of what least squares on the columns leaves.
double left_over(const std::vector<double>& target, const Columns& columns) {
  const Eigen::VectorXd wanted = vector_of(target, kSettling);
  Eigen::MatrixXd given(wanted.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    given.col(static_cast<Eigen::Index>(i)) = vector_of(columns[i], kSettling);
  const Eigen::VectorXd fit = given.colPivHouseholderQr().solve(wanted);
  return (wanted - given * fit).squaredNorm() / static_cast<double>(wanted.size());
}

}  // namespace

double explainable(const Recorded& record) {
  const Predictor filter = predictor(record.scenario.load, white_variance(record.scenario), 1);
  Columns columns;
  const auto made_of = regressors(record.base.process, record.series.op);
  for (const auto& values : made_of) columns.push_back(filter.innovations(values));
  const std::vector<double> target = filter.innovations(record.series.pv);
  add_past(columns, less(target, columns.front()));
  return left_over(target, columns) / realised_floor(record.scenario, record.series) - 1.0;
}

double floor_of(const Scenario& scenario) {
  return filter_of(scenario).variance / scenario.hold;
}

double realised_floor(const Scenario& scenario, const Series& series) {
  const auto hold = static_cast<std::size_t>(scenario.hold);
  std::vector<double> renewed;
  for (std::size_t k = 0; k < kSamples; ++k)
    if ((k + kRunIn) % hold == 0) renewed.push_back(series.stochastic[k]);
  const std::vector<double> innovations = filter_of(scenario).innovations(renewed);
  const Eigen::VectorXd settled = vector_of(innovations, innovations.size() / 10);
  return settled.squaredNorm() / static_cast<double>(settled.size()) / scenario.hold;
}

}  // namespace loopscope::tests::effects
