#include "tests/plants/process/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/plants/process/running_loop.hpp"
#include "tests/plants/process/valve.hpp"

namespace loopscope::tests::process {
namespace {

/// Supplies are slow: they move once in so many steps.
constexpr long kStepsAnUpset = 4;

long last_step(const PlantPlan& plan, const std::vector<Window>& windows) {
  long longest = 0;
  for (const Window& window : windows)
    longest =
        std::max(longest, window.every * static_cast<long>(window.samples) + window.end_early);
  return std::lround(plan.settle_s / plan.step_s) + longest;
}

/// A historian's samples lie on the beat of its interval.
long first_step(long last, const Window& window) {
  const long beat = (last - window.end_early) / window.every;
  return (beat - static_cast<long>(window.samples) + 1) * window.every;
}

class RunningStream {
 public:
  RunningStream(const StreamPlan& plan, double step_s)
      : plan_(plan),
        valve_(plan.valve, step_s, 100.0 * plan.nominal / plan.full),
        fresh_(1.0 - std::exp(-step_s / plan.hydraulic_lag_s)),
        flow_(plan.nominal) {}

  double step(double op, double drive, const std::vector<double>& upsets) {
    const double supply = plan_.supply ? 1.0 + upsets[*plan_.supply] : 1.0;
    const double wanted = plan_.full * valve_.step(op) / 100.0 * drive * supply;
    return flow_ += fresh_ * (wanted - flow_);
  }

 private:
  const StreamPlan& plan_;
  Valve valve_;
  double fresh_;
  double flow_;
};

/// Masters before their slaves, as a control system scans a cascade.
std::vector<std::size_t> scan_order(const std::vector<LoopPlan>& loops) {
  const auto depth = [&loops](std::size_t loop) {
    int above = 0;
    for (std::optional<std::size_t> master = loops[loop].master; master;
         master = loops[*master].master)
      ++above;
    return above;
  };
  std::vector<std::size_t> order(loops.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, depth);
  return order;
}

class RunningPlant {
 public:
  RunningPlant(const PlantPlan& plan, const std::vector<Window>& windows)
      : plan_(plan),
        process_(plan.process()),
        last_(last_step(plan, windows)),
        upset_values_(plan.upsets.size(), 0.0),
        order_(scan_order(plan.loops)),
        mover_(plan.streams.size()) {
    std::uint64_t part = 0;
    for (const UpsetPlan& upset : plan.upsets)
      upsets_.emplace_back(upset, plan.step_s * kStepsAnUpset,
                           seed_of_part(plan.noise_seed, ++part));
    for (const StreamPlan& stream : plan.streams) {
      streams_.emplace_back(stream, plan.step_s);
      flows_.push_back(stream.nominal);
    }
    loops_.reserve(plan.loops.size());
    for (std::size_t i = 0; i < plan.loops.size(); ++i) {
      loops_.emplace_back(plan.loops[i], plan.step_s, seed_of_part(plan.noise_seed, 100 + i),
                          windows[i], first_step(last_, windows[i]));
      if (plan.loops[i].valve) mover_[*plan.loops[i].valve] = i;
    }
  }

  std::vector<Record> run() {
    for (long step = 0; step <= last_; ++step) {
      advance(step);
      if (std::ranges::any_of(loops_, &RunningLoop::out_of_span)) return {};
    }
    std::vector<Record> records;
    for (RunningLoop& loop : loops_) records.push_back(loop.take());
    return records;
  }

 private:
  void advance(long step) {
    if (step % kStepsAnUpset == 0)
      std::ranges::transform(upsets_, upset_values_.begin(), &Upset::step);
    for (const std::size_t i : order_) {
      loops_[i].scan(step, measured(plan_.loops[i]), setpoint(plan_.loops[i]));
      loops_[i].record(step);
    }
    for (std::size_t s = 0; s < streams_.size(); ++s)
      flows_[s] = streams_[s].step(position(s), process_->drive(s), upset_values_);
    process_->step(flows_, upset_values_, plan_.step_s);
  }

  [[nodiscard]] double measured(const LoopPlan& loop) const {
    return loop.flow_of ? flows_[*loop.flow_of] : process_->value(loop.value);
  }

  [[nodiscard]] std::optional<double> setpoint(const LoopPlan& loop) const {
    if (loop.master) return loops_[*loop.master].op_as_setpoint(loop);
    if (loop.ratio_to) return loop.ratio * loops_[*loop.ratio_to].ratio_base();
    return std::nullopt;
  }

  /// A stream that no loop moves stays as it is.
  [[nodiscard]] double position(std::size_t stream) const {
    const StreamPlan& plan = plan_.streams[stream];
    return mover_[stream] ? loops_[*mover_[stream]].op() : 100.0 * plan.nominal / plan.full;
  }

  const PlantPlan& plan_;
  std::unique_ptr<UnitProcess> process_;
  long last_;
  std::vector<Upset> upsets_;
  std::vector<double> upset_values_;
  std::vector<RunningStream> streams_;
  std::vector<double> flows_;
  std::vector<std::size_t> order_;  ///< of the loops' scans
  std::vector<RunningLoop> loops_;
  std::vector<std::optional<std::size_t>> mover_;  ///< the loop whose output is the valve's
};

}  // namespace

std::vector<Record> simulate(const PlantPlan& plan, const std::vector<Window>& windows) {
  return RunningPlant(plan, windows).run();
}

std::vector<Record> simulate(const PlantPlan& plan, Window window) {
  return simulate(plan, std::vector<Window>(plan.loops.size(), window));
}

}  // namespace loopscope::tests::process
