#include "core/model/valve_tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/model/valve_lanes.hpp"

namespace loopscope::core::model {
namespace {

constexpr std::size_t kLanes = 8;
constexpr std::size_t kTogether = 4;  ///< lanes in a vector
constexpr std::size_t kVectors = kLanes / kTogether;
using Lanes = ValveLanes<ShortNumbers, kVectors>;
using LaneValues = Lanes::Numbers;

double at(const LaneValues& values, std::size_t lane) {
  return static_cast<double>(values[lane / kTogether][lane % kTogether]);
}

void put(LaneValues& values, std::size_t lane, double value) {
  values[lane / kTogether][lane % kTogether] = static_cast<float>(value);
}

ShortNumbers all(double value) {
  return ShortNumbers{} + static_cast<float>(value);
}

/// Where the lanes start, in half bands off the place that the law has: small ones put drift
/// right, large ones a slip that was missed. The last lane takes the other end of the band.
constexpr LaneValues kOffsets = {{{0.0F, 0.04F, -0.04F, 0.12F}, {-0.12F, 0.35F, -0.35F, 0.0F}}};

class Tracker {
 public:
  Tracker(const TrackedRecord& record, const Valve& valve, const LaggedModel& model)
      : record_(record),
        valve_(valve),
        friction_(valve),
        model_(model),
        price_(kCorrectionPrice * model.residual / static_cast<double>(record.rows.rows)),
        path_(record.rows.output.size()) {
    explain_without_valve();
    for (std::size_t lag = 0; lag < kInputLags; ++lag) {
      weights_[lag] = all(model.weights[kOutputLags + 1 + lag]);
    }
    chosen_.start(friction_, static_cast<float>(valve.start_direction),
                  static_cast<float>(record.op[0]));
  }

  template <ValveLaw law>
  void run(std::size_t rows_per_stretch) {
    mv_.resize(kInputLags + rows_per_stretch + kInputLags);
    for (std::size_t begin = 0; begin < path_.size(); begin += rows_per_stretch) {
      const std::size_t end = std::min(path_.size(), begin + rows_per_stretch);
      // What a lane does shows in pv after the delay only.
      const std::size_t seen = std::min(path_.size(), end + kInputLags);
      recall(begin);
      const LaneValues starts = begin == 0 ? spread_widely() : spread_around(begin);
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
      rest_[k] = static_cast<float>(rest);
    }
  }

  /// The rows before a stretch, the same for all lanes; before the record there was nothing.
  void recall(std::size_t begin) {
    for (std::size_t lag = 1; lag <= kInputLags; ++lag) {
      mv_[kInputLags - lag].fill(all(begin < lag ? 0.0 : path_[begin - lag]));
    }
  }

  /// Puts the lanes around the chosen valve; the last one at the other end of the band.
  LaneValues spread_around(std::size_t begin) {
    const auto op = static_cast<float>(record_.op[begin * record_.steps_per_row - 1]);
    const float band = friction_.breakaway;
    const float gap = op - chosen_.position[0][0];
    const float reach = valve_.law == ValveLaw::choudhury ? std::abs(gap) + band : band;
    const ShortNumbers limit = ShortNumbers{} + reach;
    for (std::size_t v = 0; v < kVectors; ++v) {
      const ShortNumbers wanted = gap + kOffsets[v] * band;
      const ShortNumbers above = wanted < -limit ? -limit : wanted;
      chosen_.position[v] = op - (above > limit ? limit : above);
    }
    put(chosen_.position, 0, static_cast<double>(op - gap));
    put(chosen_.position, kLanes - 1,
        static_cast<double>(gap > 0 ? op - gap + band : op - gap - band));
    return chosen_.position;
  }

  /// Evenly over the band, at the start of the record, where nothing is known. The printed chart
  /// counts from op, not from the position: there it has no limit but op's own reach.
  LaneValues spread_widely() {
    const double op = record_.op[0];
    const auto [low, high] = std::ranges::minmax(record_.op);
    const bool printed = valve_.law == ValveLaw::choudhury;
    const double limit = printed ? std::max(-low, high) : static_cast<double>(friction_.breakaway);
    for (std::size_t lane = 1; lane < kLanes; ++lane) {
      const double share = (2.0 * static_cast<double>(lane) - 1.0) / (kLanes - 1.0) - 1.0;
      put(chosen_.position, lane, op - share * limit);
    }
    return chosen_.position;
  }

  /// mv of every lane by row, from `begin` to `seen`; `at_end` is where the lanes are at `end`.
  template <ValveLaw law>
  LaneValues run_stretch(std::size_t begin, std::size_t end, std::size_t seen, Lanes& at_end) {
    Lanes lanes = chosen_;
    LaneValues costs{};
    const Lanes::Friction friction = friction_;
    const std::size_t steps = record_.steps_per_row;
    const ShortNumbers share = all(1.0 / static_cast<double>(steps));
    const OpStep<float>* op = &record_.steps[begin * steps];
    LaneValues* mv = &mv_[kInputLags];
    for (std::size_t row = begin; row < seen; ++row, ++mv) {
      if (record_.rows.counted[row] != 0) {
        add_costs(rest_[row], mv, costs);
      }
      LaneValues sum{};
      for (std::size_t step = 0; step < steps; ++step) {
        lanes.step<law>(friction, *op++);
        for (std::size_t v = 0; v < kVectors; ++v) {
          sum[v] += lanes.position[v];
        }
      }
      for (std::size_t v = 0; v < kVectors; ++v) {
        (*mv)[v] = sum[v] * share;
      }
      if (row + 1 == end) {
        at_end = lanes;
      }
    }
    return costs;
  }

  /// Adds the squared errors of a row; `mv` points to that row.
  void add_costs(float rest, const LaneValues* mv, LaneValues& costs) const {
    LaneValues error;
    error.fill(ShortNumbers{} + rest);
    for (std::size_t lag = 0; lag < kInputLags; ++lag) {
      --mv;
      for (std::size_t v = 0; v < kVectors; ++v) {
        error[v] -= weights_[lag] * (*mv)[v];
      }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
      costs[v] += error[v] * error[v];
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
    chosen_.position.fill(all(at(at_end.position, best)));
    chosen_.turn.fill(all(at(at_end.turn, best)));
    chosen_.moving.fill(Lanes::Mask{} + at_end.moving[best / kTogether][best % kTogether]);
    for (std::size_t row = begin; row < end; ++row) {
      path_[row] = at(mv_[row - begin + kInputLags], best);
    }
  }

  const TrackedRecord& record_;
  Valve valve_;
  Lanes::Friction friction_;
  const LaggedModel& model_;
  std::array<ShortNumbers, kInputLags> weights_{};  ///< of mv
  double price_;
  std::vector<LaneValues> mv_;  ///< of one stretch by row, kInputLags rows before and after it
  std::vector<double> path_;    ///< mv of the chosen lanes by row
  std::vector<float> rest_;
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

std::vector<OpStep<float>> op_steps(std::span<const double> op) {
  std::vector<OpStep<float>> steps;
  steps.reserve(op.size());
  OpMotion<float> motion{op.empty() ? 0.0F : static_cast<float>(op[0])};
  for (const double value : op) {
    steps.push_back(motion.take(static_cast<float>(value)));
  }
  return steps;
}

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
