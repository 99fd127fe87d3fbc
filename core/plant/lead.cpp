#include "core/plant/lead.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/signal/gaps.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {
namespace {

constexpr double kStepsAPeriod = 8.0;
constexpr Eigen::Index kLags = 8;
constexpr std::size_t kMostSteps = 4000;
constexpr std::size_t kLongestBridge = 8;  // steps: a period
constexpr double kRowsACoefficient = 6.0;
/// A sum of gains as small as this is noise: such a loop leads nowhere.
constexpr double kFaintLead = 0.02;

/// A grid of time that all loops share.
struct TimeGrid {
  double from_s = std::numeric_limits<double>::lowest();
  double to_s = std::numeric_limits<double>::max();
  double step_s = 0.0;

  TimeGrid(std::span<const MemberLoop> loops, std::span<const std::size_t> members, double period_s)
      : step_s(period_s / kStepsAPeriod) {
    for (const std::size_t i : members) {
      const double start_s = static_cast<double>(loops[i].start_us) * 1e-6;
      from_s = std::max(from_s, start_s);
      to_s = std::min(
          to_s, start_s + loops[i].sample_interval_s * static_cast<double>(loops[i].error.size()));
      step_s = std::max(step_s, loops[i].sample_interval_s);
    }
  }
  [[nodiscard]] std::size_t size() const {
    return to_s > from_s ? std::min(kMostSteps, static_cast<std::size_t>((to_s - from_s) / step_s))
                         : 0;
  }
};

/// Means of the samples about every step, less the mean of all.
signal::Samples on_grid(const MemberLoop& loop, const TimeGrid& grid) {
  const std::span<const double> values = loop.pv.empty() ? loop.error : loop.pv;
  signal::Samples sums(grid.size(), 0.0), counts(grid.size(), 0.0);
  const double start_s = static_cast<double>(loop.start_us) * 1e-6 - grid.from_s;
  double total = 0.0, count = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double place =
        std::round((start_s + static_cast<double>(k) * loop.sample_interval_s) / grid.step_s);
    if (!std::isfinite(values[k]) || place < 0.0 || place >= static_cast<double>(sums.size()))
      continue;
    sums[static_cast<std::size_t>(place)] += values[k];
    counts[static_cast<std::size_t>(place)] += 1.0;
    total += values[k], count += 1.0;
  }
  for (std::size_t j = 0; j < sums.size(); ++j)
    sums[j] = counts[j] > 0.0 ? sums[j] / counts[j] - total / count : signal::kMissing;
  signal::bridge_gaps(sums, kLongestBridge);
  return sums;
}

/// Products of every loop's present and its past, over the rows that all loops recorded: column
/// 0 is a constant, loop m has its present in column 1 + m (kLags + 1), then its lags.
class Regression {
 public:
  explicit Regression(const std::vector<signal::Samples>& series) {
    const auto loops = static_cast<Eigen::Index>(series.size());
    const auto steps = static_cast<Eigen::Index>(series.front().size());
    Eigen::VectorXd row(1 + loops * (kLags + 1));
    products_.setZero(row.size(), row.size());
    row(0) = 1.0;
    for (Eigen::Index k = kLags; k < steps; ++k) {
      for (Eigen::Index m = 0; m < loops; ++m)
        for (Eigen::Index lag = 0; lag <= kLags; ++lag)
          row(present(m) + lag) =
              series[static_cast<std::size_t>(m)][static_cast<std::size_t>(k - lag)];
      if (!row.allFinite()) continue;
      products_.selfadjointView<Eigen::Lower>().rankUpdate(row);
      rows_ += 1.0;
    }
    products_ = products_.selfadjointView<Eigen::Lower>();
  }

  [[nodiscard]] bool long_enough() const {
    return rows_ >= kRowsACoefficient * static_cast<double>(2 * kLags + 1);
  }
  [[nodiscard]] double gain(Eigen::Index from, Eigen::Index to) const {
    const double without = left(to, {}), with = left(to, from);
    if (!(with > 0.0)) return 0.0;
    return std::max(0.0, std::log(without / with) - static_cast<double>(kLags) / rows_);
  }

 private:
  static Eigen::Index present(Eigen::Index loop) { return 1 + loop * (kLags + 1); }

  /// Sum of squares of a loop that its own past and that of another one do not foretell.
  [[nodiscard]] double left(Eigen::Index loop, std::optional<Eigen::Index> other) const {
    std::vector<Eigen::Index> columns{0};
    for (Eigen::Index lag = 1; lag <= kLags; ++lag) columns.push_back(present(loop) + lag);
    if (other)
      for (Eigen::Index lag = 1; lag <= kLags; ++lag) columns.push_back(present(*other) + lag);
    Eigen::MatrixXd past = products_(columns, columns);
    // Series that hardly move must not divide by zero.
    past.diagonal() *= 1.0 + 1e-9;
    const Eigen::VectorXd cross = products_(columns, present(loop));
    const double whole = products_(present(loop), present(loop));
    return std::max(1e-12 * whole, whole - cross.dot(past.ldlt().solve(cross)));
  }

  Eigen::MatrixXd products_;
  double rows_ = 0.0;
};

}  // namespace

std::vector<Lead> find_leads(std::span<const MemberLoop> loops,
                             std::span<const std::size_t> members, double period_s) {
  const auto asked = members.first(std::min(kMostLeading, members.size()));
  const TimeGrid grid(loops, asked, period_s);
  if (asked.size() < 2 || grid.size() <= static_cast<std::size_t>(kLags)) return {};
  std::vector<signal::Samples> series;
  for (const std::size_t i : asked) series.push_back(on_grid(loops[i], grid));
  const Regression regression(series);
  if (!regression.long_enough()) return {};
  std::vector<Lead> leads;
  for (std::size_t a = 0; a < asked.size(); ++a)
    for (std::size_t b = 0; b < asked.size(); ++b) {
      if (a == b) continue;
      const double gain =
          regression.gain(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      if (gain > 0.0) leads.push_back({asked[a], asked[b], gain});
    }
  std::ranges::stable_sort(leads, std::ranges::greater(), &Lead::gain);
  return leads;
}

double net_lead(std::span<const Lead> leads, std::size_t loop) {
  double out = 0.0, in = 0.0;
  for (const Lead& lead : leads) {
    if (lead.from == loop) out += lead.gain;
    if (lead.to == loop) in += lead.gain;
  }
  return (out - in) / (out + in + kFaintLead);
}

}  // namespace loopscope::core::plant
