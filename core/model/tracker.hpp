#pragma once

#include "core/model/lane_basis.hpp"
#include "core/model/valve_lanes.hpp"

namespace loopscope::core::model {
inline namespace LOOPSCOPE_PATH {

inline constexpr std::size_t kTrackers = 8;

/// Where the lanes start, in half bands off the place that the law has: small ones put drift
/// right, large ones a slip that was missed. The last lane takes the other end of the band.
inline constexpr std::array<float, kTrackers> kOffsets = {0.0F,   0.04F, -0.04F, 0.12F,
                                                          -0.12F, 0.35F, -0.35F, 0.0F};

/// track_valve(): `kTrackers` valves side by side. Number is of floats, and no longer than that.
template <typename Number>
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
  static constexpr std::size_t kTogether = kElements<Number>;
  static constexpr std::size_t kVectors = kTrackers / kTogether;
  using Lanes = ValveLanes<Number, kVectors>;
  using LaneValues = typename Lanes::Numbers;

  static double at(const LaneValues& values, std::size_t lane) {
    return static_cast<double>(values[lane / kTogether][lane % kTogether]);
  }
  static void put(LaneValues& values, std::size_t lane, double value) {
    values[lane / kTogether][lane % kTogether] = static_cast<float>(value);
  }
  static Number all(double value) { return Number{} + static_cast<float>(value); }

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
    const Number limit = Number{} + reach;
    LaneValues offsets;
    std::memcpy(&offsets, kOffsets.data(), sizeof(offsets));
    for (std::size_t v = 0; v < kVectors; ++v) {
      const Number wanted = gap + offsets[v] * band;
      const Number above = wanted < -limit ? -limit : wanted;
      chosen_.position[v] = op - (above > limit ? limit : above);
    }
    put(chosen_.position, 0, static_cast<double>(op - gap));
    put(chosen_.position, kTrackers - 1,
        static_cast<double>(gap > 0 ? op - gap + band : op - gap - band));
    return chosen_.position;
  }

  /// Evenly over the band, at the start of the record, where nothing is known. The printed chart
  /// counts from op, not from the position: there it has no limit but op's own reach.
  LaneValues spread_widely() {
    const double op = record_.op[0];
    double limit = static_cast<double>(friction_.breakaway);
    if (valve_.law == ValveLaw::choudhury) {
      const auto [low, high] = std::ranges::minmax(record_.op);
      limit = std::max(-low, high);
    }
    for (std::size_t lane = 1; lane < kTrackers; ++lane) {
      const double share = (2.0 * static_cast<double>(lane) - 1.0) / (kTrackers - 1.0) - 1.0;
      put(chosen_.position, lane, op - share * limit);
    }
    return chosen_.position;
  }

  /// Squared errors of every lane on the counted rows from `begin` to `seen`; `at_end` is where the
  /// lanes are at `end`.
  template <ValveLaw law>
  LaneValues run_stretch(std::size_t begin, std::size_t end, std::size_t seen, Lanes& at_end) {
    Lanes lanes = chosen_;
    LaneValues* mv = move_on<law>(begin, end, lanes, &mv_[kInputLags]);
    at_end = lanes;
    move_on<law>(end, seen, lanes, mv);
    return costs_of(begin, seen);
  }

  /// mv of every lane by row; returns where that of row `end` stands.
  template <ValveLaw law>
  LaneValues* move_on(std::size_t begin, std::size_t end, Lanes& moving, LaneValues* mv) const {
    Lanes lanes = moving;
    const typename Lanes::Friction friction = friction_;
    const std::size_t steps = record_.steps_per_row;
    const Number share = all(1.0 / static_cast<double>(steps));
    const OpStep<float>* op = record_.steps.data() + begin * steps;
    for (std::size_t row = begin; row < end; ++row, ++mv) {
      LaneValues sum{};
      for (std::size_t step = 0; step < steps; ++step) {
        lanes.template step<law>(friction, *op++);
        for (std::size_t v = 0; v < kVectors; ++v) sum[v] += lanes.position[v];
      }
      for (std::size_t v = 0; v < kVectors; ++v) (*mv)[v] = sum[v] * share;
    }
    moving = lanes;
    return mv;
  }

  /// An error waits for itself at every lag: those of a few rows side by side.
  LaneValues costs_of(std::size_t begin, std::size_t seen) const {
    constexpr std::size_t kRows = 4;
    LaneValues costs{};
    for (std::size_t row = begin; row < seen;) {
      const std::size_t counted = counted_from(row, std::min(seen, row + kRows));
      const LaneValues* mv = &mv_[kInputLags + (row - begin)];
      if (counted == kRows) {
        add_costs<kRows>(&rest_[row], mv, costs);
        row += kRows;
      } else {
        if (counted > 0) add_costs<1>(&rest_[row], mv, costs);
        ++row;
      }
    }
    return costs;
  }

  /// How many rows from the first on are counted without a gap.
  std::size_t counted_from(std::size_t first, std::size_t end) const {
    std::size_t row = first;
    while (row < end && record_.rows.counted[row] != 0) ++row;
    return row - first;
  }

  /// Adds the squared errors of so many rows; `mv` points to the first one.
  template <std::size_t rows>
  void add_costs(const float* rest, const LaneValues* mv, LaneValues& costs) const {
    NumberRow<Number, rows * kVectors> errors;
    for (std::size_t i = 0; i < rows * kVectors; ++i) errors[i] = Number{} + rest[i / kVectors];
    for (std::size_t lag = 0; lag < kInputLags; ++lag) {
      --mv;
      for (std::size_t i = 0; i < rows * kVectors; ++i)
        errors[i] -= weights_[lag] * mv[i / kVectors][i % kVectors];
    }
    for (std::size_t i = 0; i < rows * kVectors; ++i) costs[i % kVectors] += errors[i] * errors[i];
  }

  void choose(std::size_t begin, std::size_t end, const LaneValues& starts, const LaneValues& costs,
              const Lanes& at_end) {
    std::size_t best = 0;
    for (std::size_t lane = 1; lane < kTrackers; ++lane) {
      const double bar = at(costs, best) + (best == 0 ? 0.0 : price_);
      best = at(costs, lane) + price_ < bar ? lane : best;
    }
    if (best != 0) {
      ++corrections_;
      restarts_.push_back({begin * record_.steps_per_row, at(starts, best)});
    }
    chosen_.position.fill(all(at(at_end.position, best)));
    chosen_.turn.fill(all(at(at_end.turn, best)));
    chosen_.moving.fill(typename Lanes::Mask{} + at_end.moving[best / kTogether][best % kTogether]);
    for (std::size_t row = begin; row < end; ++row) {
      path_[row] = at(mv_[row - begin + kInputLags], best);
    }
  }

  const TrackedRecord& record_;
  Valve valve_;
  typename Lanes::Friction friction_;
  const LaggedModel& model_;
  NumberRow<Number, kInputLags> weights_{};  ///< of mv
  double price_;
  std::vector<LaneValues> mv_;  ///< of one stretch by row, kInputLags rows before and after it
  std::vector<double> path_;    ///< mv of the chosen lanes by row
  std::vector<float> rest_;
  std::vector<ValveRestart> restarts_;
  std::size_t corrections_ = 0;
  Lanes chosen_;  ///< lane 0 is the valve itself
};

template <typename Number>
TrackedValve Tracker<Number>::result() {
  TrackedValve tracked;
  tracked.model = fit_lagged(record_.rows, path_);
  tracked.corrections = corrections_;
  tracked.restarts = std::move(restarts_);
  tracked.evidence = static_cast<double>(record_.rows.rows) *
                         std::log(record_.linear_residual / tracked.model.residual) -
                     kCorrectionPrice * static_cast<double>(corrections_);
  return tracked;
}

/// track_valve().
template <typename Singles>
TrackedValve tracked(const TrackedRecord& record, const Valve& valve, const LaggedModel& model,
                     std::size_t rows_per_stretch) {
  Tracker<Singles> tracker(record, valve, model);
  with_law(valve.law, [&]<ValveLaw law>() { tracker.template run<law>(rows_per_stretch); });
  return tracker.result();
}

}  // namespace LOOPSCOPE_PATH
}  // namespace loopscope::core::model
