#include "core/model/valve_tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/valve_lanes.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kLanes = 8;
constexpr std::size_t kPairs = kLanes / 2;
using Lanes = ValveLanes<NumberPair, kPairs>;
using LaneValues = Lanes::Numbers;

double at(const LaneValues& values, std::size_t lane) {
  return values[lane / 2][lane % 2];
}

void put(LaneValues& values, std::size_t lane, double value) {
  values[lane / 2][lane % 2] = value;
}

/// Where the lanes start, in half bands off the place that the law has: small ones put drift
/// right, large ones a slip that was missed. The last lane takes the other end of the band.
constexpr std::array<double, kLanes - 1> kOffsets = {0.0, 0.04, -0.04, 0.12, -0.12, 0.35, -0.35};

class Tracker {
 public:
  Tracker(const TrackedRecord& record, const Valve& valve, const LaggedModel& model)
      : record_(record),
        valve_(valve),
        friction_(valve),
        model_(model),
        price_(kCorrectionPrice * model.residual / static_cast<double>(record.rows.rows)),
        mv_(record.rows.output.size() + kInputLags),
        path_(record.rows.output.size()) {
    explain_without_valve();
    chosen_.start(friction_, valve.start_direction, record.op[0]);
    for (const double op : record.op) {
      reach_ = std::max(reach_, std::abs(op));
    }
  }

  template <ValveLaw law>
  void run(std::size_t rows_per_stretch) {
    for (std::size_t begin = 0; begin < path_.size(); begin += rows_per_stretch) {
      const std::size_t end = std::min(path_.size(), begin + rows_per_stretch);
      // What a lane does shows in pv after the delay only.
      const std::size_t seen = std::min(path_.size(), end + kInputLags);
      const LaneValues starts = spread(begin);
      Lanes at_end = chosen_;
      const LaneValues costs = run_stretch<law>(begin, end, seen, at_end);
      choose(begin, end, starts, costs, at_end);
    }
  }

  TrackedValve result();

 private:
  /// pv less its own past's share of the prediction.
  void explain_without_valve() {
    const auto& y = record_.rows.output;
    rest_.resize(y.size());
    for (std::size_t k = kOutputLags; k < y.size(); ++k) {
      double rest = y[k] - model_.weights[kOutputLags];
      for (std::size_t i = 0; i < kOutputLags; ++i) {
        rest -= model_.weights[i] * y[k - 1 - i];
      }
      rest_[k] = rest;
    }
  }

  /// Puts the lanes around the chosen valve; evenly over the band at the start of the record,
  /// where nothing is known.
  LaneValues spread(std::size_t begin) {
    const double op = chosen_.motion.previous;
    const double gap = op - at(chosen_.position, 0);
    for (std::size_t lane = 1; lane < kLanes; ++lane) {
      put(chosen_.turn, lane, at(chosen_.turn, 0));
      put(chosen_.moving, lane, at(chosen_.moving, 0));
      put(chosen_.position, lane, op - (begin == 0 ? first_gap(lane) : next_gap(lane, gap)));
    }
    return chosen_.position;
  }

  /// Distance of op from the valve in a lane at the start of the record. The printed chart counts
  /// from op, not from the position: there it has no limit but op's own reach.
  [[nodiscard]] double first_gap(std::size_t lane) const {
    const double share = (2.0 * static_cast<double>(lane) - 1.0) / (kLanes - 1.0) - 1.0;
    return share * (valve_.law == ValveLaw::choudhury ? reach_ : friction_.breakaway);
  }

  /// The same later, for a chosen valve with that gap.
  [[nodiscard]] double next_gap(std::size_t lane, double gap) const {
    const double band = friction_.breakaway;
    const double limit = valve_.law == ValveLaw::choudhury ? std::abs(gap) + band : band;
    const double other_end = gap > 0.0 ? gap - band : gap + band;
    const double wanted = lane < kOffsets.size() ? gap + kOffsets[lane] * band : other_end;
    return std::clamp(wanted, -limit, limit);
  }

  /// mv of every lane by row, from `begin` to `seen`; `at_end` is where the lanes are at `end`.
  template <ValveLaw law>
  LaneValues run_stretch(std::size_t begin, std::size_t end, std::size_t seen, Lanes& at_end) {
    Lanes lanes = chosen_;
    LaneValues costs{};
    const double share = 1.0 / static_cast<double>(record_.steps_per_row);
    for (std::size_t row = begin; row < seen; ++row) {
      if (record_.rows.counted[row] != 0) {
        add_costs(row, costs);
      }
      LaneValues sum{};
      for (std::size_t step = 0; step < record_.steps_per_row; ++step) {
        lanes.step<law>(friction_, record_.op[row * record_.steps_per_row + step]);
        for (std::size_t pair = 0; pair < kPairs; ++pair) {
          sum[pair] += lanes.position[pair];
        }
      }
      for (std::size_t pair = 0; pair < kPairs; ++pair) {
        mv_[row + kInputLags][pair] = sum[pair] * share;
      }
      if (row + 1 == end) {
        at_end = lanes;
      }
    }
    return costs;
  }

  void add_costs(std::size_t row, LaneValues& costs) const {
    LaneValues error;
    error.fill(NumberPair{} + rest_[row]);
    for (std::size_t lag = 1; lag <= kInputLags; ++lag) {
      const double weight = model_.weights[kOutputLags + lag];
      const LaneValues& mv = mv_[row + kInputLags - lag];
      for (std::size_t pair = 0; pair < kPairs; ++pair) {
        error[pair] -= weight * mv[pair];
      }
    }
    for (std::size_t pair = 0; pair < kPairs; ++pair) {
      costs[pair] += error[pair] * error[pair];
    }
  }

  void choose(std::size_t begin, std::size_t end, const LaneValues& starts, const LaneValues& costs,
              const Lanes& at_end) {
    std::size_t best = 0;
    for (std::size_t lane = 1; lane < kLanes; ++lane) {
      const double bar = at(costs, best) + (best == 0 ? 0.0 : price_);
      best = at(costs, lane) + price_ < bar ? lane : best;
    }
    if (best != 0) {
      ++corrections_;
      restarts_.push_back({begin * record_.steps_per_row, at(starts, best)});
    }
    chosen_ = at_end;
    put(chosen_.position, 0, at(at_end.position, best));
    put(chosen_.turn, 0, at(at_end.turn, best));
    put(chosen_.moving, 0, at(at_end.moving, best));
    for (std::size_t row = begin; row < end; ++row) {
      path_[row] = at(mv_[row + kInputLags], best);
      mv_[row + kInputLags].fill(NumberPair{} + path_[row]);
    }
  }

  const TrackedRecord& record_;
  Valve valve_;
  Friction friction_;
  const LaggedModel& model_;
  double price_;
  double reach_ = 0.0;          ///< how far op goes from its mean
  std::vector<LaneValues> mv_;  ///< by row, kInputLags rows of nothing in front
  std::vector<double> path_;    ///< mv of the chosen lanes by row
  std::vector<double> rest_;
  std::vector<ValveRestart> restarts_;
  std::size_t corrections_ = 0;
  Lanes chosen_;  ///< lane 0 is the valve itself
};

TrackedValve Tracker::result() {
  TrackedValve tracked;
  tracked.model = fit_lagged(record_.rows, path_);
  tracked.corrections = corrections_;
  tracked.restarts = std::move(restarts_);
  tracked.evidence = static_cast<double>(record_.rows.rows) *
                         std::log(record_.linear_residual / tracked.model.residual) -
                     kCorrectionPrice * static_cast<double>(corrections_);
  return tracked;
}

}  // namespace

TrackedValve track_valve(const TrackedRecord& record, const Valve& valve, const LaggedModel& model,
                         std::size_t rows_per_stretch) {
  Tracker tracker(record, valve, model);
  with_law(valve.law, [&]<ValveLaw law>() { tracker.run<law>(rows_per_stretch); });
  return tracker.result();
}

LaggedModel fit_untracked(const TrackedRecord& record, const Valve& valve) {
  std::vector<double> mv(record.op.size());
  run_valve(valve, record.op, mv);
  std::vector<double> by_row(record.rows.output.size());
  const double share = 1.0 / static_cast<double>(record.steps_per_row);
  for (std::size_t row = 0; row < by_row.size(); ++row) {
    for (std::size_t step = 0; step < record.steps_per_row; ++step) {
      by_row[row] += share * mv[row * record.steps_per_row + step];
    }
  }
  return fit_lagged(record.rows, by_row);
}

}  // namespace loopscope::core::model
