#include "core/plant/lead.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/signal/gaps.hpp"
#include "core/signal/loop_window.hpp"

namespace loopscope::core::plant {
namespace {

constexpr double kStepsAPeriod = 8.0;
constexpr Eigen::Index kLags = 4;  // half a period: as good as a whole one, and half the rows
constexpr std::size_t kMostSteps = 4000;
constexpr std::size_t kLongestBridge = 8;  // steps: a period
/// A pair's gain is asked of every record of some length, the direct one of all members' pasts
/// together only where it can be had.
constexpr double kRowsACoefficient = 6.0;
constexpr double kRowsACoefficientOfAll = 3.0;
/// Of the grid, below which a signal would take the rows of all: it is left out.
constexpr double kLeastKnown = 0.8;
/// Of a pair: a constant, and pv and op of both.
constexpr double kCoefficientsOfPair = 1.0 + 4.0 * static_cast<double>(kLags);
/// Of the median of the members' spans: shorter records are left out where all of them together
/// have too little in common for a pair.
constexpr double kLeastSpan = 0.5;
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
    if (!(to_s > from_s)) return 0;
    // Without a member the span has no end.
    return static_cast<std::size_t>(
        std::min((to_s - from_s) / step_s, static_cast<double>(kMostSteps)));
  }
};

/// Means of the samples about every step, less the mean of all.
signal::Samples on_grid(const MemberLoop& loop, std::span<const double> values,
                        const TimeGrid& grid) {
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

/// A loop's signals on the grid, the one that is foretold first.
using Signals = std::vector<signal::Samples>;

bool is_known(const signal::Samples& samples) {
  const auto known = std::ranges::count_if(samples, [](double v) { return std::isfinite(v); });
  return static_cast<double>(known) >= kLeastKnown * static_cast<double>(samples.size());
}

/// Empty where even pv was hardly recorded.
Signals signals_of(const MemberLoop& loop, const TimeGrid& grid) {
  Signals signals{on_grid(loop, loop.pv.empty() ? loop.error : loop.pv, grid)};
  if (!is_known(signals.front())) return {};
  if (loop.op.empty()) return signals;
  signals.push_back(on_grid(loop, loop.op, grid));
  if (!is_known(signals.back())) signals.pop_back();
  return signals;
}

/// Without those whose records are short beside the others'.
std::vector<std::size_t> of_like_spans(std::span<const MemberLoop> loops,
                                       std::span<const std::size_t> members) {
  const auto span_s = [&](std::size_t i) {
    return static_cast<double>(loops[i].error.size()) * loops[i].sample_interval_s;
  };
  std::vector<double> spans;
  for (const std::size_t i : members) spans.push_back(span_s(i));
  std::vector<std::size_t> kept;
  if (spans.empty()) return kept;
  std::ranges::nth_element(spans, spans.begin() + std::ssize(spans) / 2);
  const double median_s = spans[spans.size() / 2];
  for (const std::size_t i : members)
    if (span_s(i) >= kLeastSpan * median_s) kept.push_back(i);
  return kept;
}

using Columns = std::vector<Eigen::Index>;

/// Products of every signal's present and its past, over the rows that all loops recorded: column
/// 0 is a constant, signal s has its present in column 1 + s (kLags + 1), then its lags.
class Regression {
 public:
  explicit Regression(const std::vector<Signals>& loops) {
    std::vector<const signal::Samples*> all;
    for (const Signals& signals : loops) {
      firsts_.push_back(column(static_cast<Eigen::Index>(all.size())));
      counts_.push_back(static_cast<Eigen::Index>(signals.size()));
      for (const signal::Samples& one : signals) all.push_back(&one);
    }
    add_up(all);
  }

  [[nodiscard]] bool long_enough() const {
    return rows_ >= kRowsACoefficient * kCoefficientsOfPair;
  }
  /// Whether all pasts can stand in one regression.
  [[nodiscard]] bool long_enough_for_all() const {
    return rows_ >= kRowsACoefficientOfAll * static_cast<double>(past_of_all().size());
  }
  [[nodiscard]] double gain(std::size_t from, std::size_t to) const {
    Columns past{0};
    add_past(past, to);
    return gain(from, to, past);
  }
  [[nodiscard]] double direct_gain(std::size_t from, std::size_t to) const {
    Columns past{0};
    for (std::size_t loop = 0; loop < firsts_.size(); ++loop)
      if (loop != from) add_past(past, loop);
    return gain(from, to, past);
  }

 private:
  static Eigen::Index column(Eigen::Index signal) { return 1 + signal * (kLags + 1); }

  void add_up(const std::vector<const signal::Samples*>& all) {
    const auto signals = static_cast<Eigen::Index>(all.size());
    const auto steps = static_cast<Eigen::Index>(all.front()->size());
    Eigen::VectorXd row(column(signals));
    products_.setZero(row.size(), row.size());
    row(0) = 1.0;
    for (Eigen::Index k = kLags; k < steps; ++k) {
      for (Eigen::Index s = 0; s < signals; ++s)
        for (Eigen::Index lag = 0; lag <= kLags; ++lag)
          row(column(s) + lag) =
              (*all[static_cast<std::size_t>(s)])[static_cast<std::size_t>(k - lag)];
      if (!row.allFinite()) continue;
      products_.selfadjointView<Eigen::Lower>().rankUpdate(row);
      rows_ += 1.0;
    }
    products_ = products_.selfadjointView<Eigen::Lower>();
  }

  void add_past(Columns& columns, std::size_t loop) const {
    for (Eigen::Index s = 0; s < counts_[loop]; ++s)
      for (Eigen::Index lag = 1; lag <= kLags; ++lag)
        columns.push_back(firsts_[loop] + s * (kLags + 1) + lag);
  }
  [[nodiscard]] Columns past_of_all() const {
    Columns columns{0};
    for (std::size_t loop = 0; loop < firsts_.size(); ++loop) add_past(columns, loop);
    return columns;
  }

  /// What the past of `from` adds to `past`.
  [[nodiscard]] double gain(std::size_t from, std::size_t to, Columns past) const {
    const double without = left(firsts_[to], past);
    const auto known = static_cast<double>(past.size());
    add_past(past, from);
    const double with = left(firsts_[to], past);
    if (!(with > 0.0)) return 0.0;
    return std::max(0.0,
                    std::log(without / with) - (static_cast<double>(past.size()) - known) / rows_);
  }

  /// Sum of squares of a signal's present that these columns do not foretell.
  [[nodiscard]] double left(Eigen::Index present, const Columns& columns) const {
    Eigen::MatrixXd past = products_(columns, columns);
    // Series that hardly move must not divide by zero.
    past.diagonal() *= 1.0 + 1e-9;
    const Eigen::VectorXd cross = products_(columns, present);
    const double whole = products_(present, present);
    return std::max(1e-12 * whole, whole - cross.dot(past.ldlt().solve(cross)));
  }

  Eigen::MatrixXd products_;
  Columns firsts_;  // present of every loop's first signal
  Columns counts_;  // signals of every loop
  double rows_ = 0.0;
};

}  // namespace

std::vector<Lead> find_leads(std::span<const MemberLoop> loops,
                             std::span<const std::size_t> members, double period_s) {
  const auto strongest = members.first(std::min(kMostLeading, members.size()));
  std::vector<std::size_t> asked(strongest.begin(), strongest.end());
  TimeGrid grid(loops, asked, period_s);
  if (static_cast<double>(grid.size()) < kRowsACoefficient * kCoefficientsOfPair + kLags) {
    asked = of_like_spans(loops, strongest);
    grid = TimeGrid(loops, asked, period_s);
  }
  if (asked.size() < 2 || grid.size() <= static_cast<std::size_t>(kLags)) return {};
  std::vector<Signals> signals;
  std::vector<std::size_t> known;
  for (const std::size_t i : asked)
    if (Signals found = signals_of(loops[i], grid); !found.empty()) {
      signals.push_back(std::move(found));
      known.push_back(i);
    }
  asked = std::move(known);
  if (asked.size() < 2) return {};
  const Regression regression(signals);
  if (!regression.long_enough()) return {};
  const bool all = regression.long_enough_for_all();
  std::vector<Lead> leads;
  for (std::size_t a = 0; a < asked.size(); ++a)
    for (std::size_t b = 0; b < asked.size(); ++b) {
      if (a == b) continue;
      const Lead lead{asked[a], asked[b], regression.gain(a, b),
                      all ? regression.direct_gain(a, b) : 0.0};
      if (lead.gain > 0.0 || lead.direct > 0.0) leads.push_back(lead);
    }
  std::ranges::stable_sort(leads, std::ranges::greater(), &Lead::gain);
  return leads;
}

double net_lead(std::span<const Lead> leads, std::size_t loop, double Lead::*part) {
  double out = 0.0, in = 0.0;
  for (const Lead& lead : leads) {
    if (lead.from == loop) out += lead.*part;
    if (lead.to == loop) in += lead.*part;
  }
  return (out - in) / (out + in + kFaintLead);
}

}  // namespace loopscope::core::plant
