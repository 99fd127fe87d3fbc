#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/model/answer_lanes.hpp"
#include "core/model/answer_sums.hpp"
#include "core/model/effects/valve.hpp"
#include "core/model/fit.hpp"

namespace loopscope::core::model {

/// Numbers side by side: they hide what each of them waits for. Of 2, 3 and 4 the last is fastest.
inline constexpr std::size_t kVectorsAtOnce = 4;

/// What every batch shares, in the digits of its numbers.
template <typename Element>
struct BatchRecord {
  const Structure& structure;
  std::span<const Range> rows;
  std::size_t samples;
  std::vector<OpStep<Element>> steps;         ///< of op
  std::vector<std::vector<Element>> columns;  ///< the steady ones
};

/// Where a lane is put elsewhere than its law has it.
template <typename Element>
struct LaneRestart {
  std::size_t at_sample;
  std::size_t lane;
  Element position;
};

/// Valves of one law and direction at the start, from op to their sums. Number is NumberPair or
/// ShortNumbers. As few valves as there are: what is left of the lanes repeats the last one.
template <typename Number>
class ValveBatch {
 public:
  using Element = typename ElementOf<Number>::type;
  static constexpr std::size_t kTogether = sizeof(Number) / sizeof(Element);
  static constexpr std::size_t kLanes = kTogether * kVectorsAtOnce;
  using Valves = ValveLanes<Number, kVectorsAtOnce>;
  using Numbers = typename Valves::Numbers;

  ValveBatch(const BatchRecord<Element>& shared, std::span<const ValveEffect* const> valves)
      : shared_(shared),
        delay_(std::min(shared.structure.process.delay_samples, shared.samples)),
        sums_(shared.rows, shared.columns, shared.structure.two_taps ? 2 : 1) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      put_in(lane, *valves[std::min(lane, valves.size() - 1)]);
    }
    std::ranges::stable_sort(restarts_, {}, &LaneRestart<Element>::at_sample);
  }

  template <ValveLaw law>
  void run() {
    step<law>();
    AnswerLanes<Number, kVectorsAtOnce> answers(shared_.structure.process, shared_.structure.noise,
                                                valves_.position);
    // The sample before a stretch stands in front of it: the second tap is a sample later.
    std::array<Numbers, kStretch + 1> x;
    for (std::size_t first = 0; first < shared_.samples; first += kStretch) {
      const std::size_t count = std::min(kStretch, shared_.samples - first);
      follow<law>(first, count, &x[1]);
      answers.run(&x[1], count);
      if (first == 0) x[0] = x[1];
      sums_.add(first, count, x.data());
      x[0] = x[count];
    }
  }

  /// Of one lane, see ValveAnswers.
  [[nodiscard]] Eigen::MatrixXd products(std::size_t lane) const { return sums_.products(lane); }

 private:
  /// Samples at a time: few enough to stay near the processor between the steps.
  static constexpr std::size_t kStretch = 64;

  void put_in(std::size_t lane, const ValveEffect& valve) {
    const std::size_t v = lane / kTogether, i = lane % kTogether;
    const FrictionIn<Element> friction(valve.valve());
    friction_[v].band[i] = friction.band;
    friction_[v].jump[i] = friction.jump;
    friction_[v].breakaway[i] = friction.breakaway;
    friction_[v].lag[i] = friction.lag;
    const Element op = shared_.steps.front().op;
    const auto direction = static_cast<Element>(valve.valve().start_direction);
    valves_.position[v][i] = op - direction * friction.lag;
    valves_.turn[v][i] = op;
    for (const ValveRestart& restart : valve.restarts()) {
      restarts_.push_back(
          {restart.at_sample, lane, static_cast<Element>(restart.position_percent)});
    }
  }

  /// The valves at the next sample of op.
  template <ValveLaw law>
  void step() {
    for (; restart_ < restarts_.size() && restarts_[restart_].at_sample == now_; ++restart_) {
      const LaneRestart<Element>& restart = restarts_[restart_];
      valves_.position[restart.lane / kTogether][restart.lane % kTogether] = restart.position;
    }
    valves_.template step<law>(friction_, shared_.steps[now_++]);
  }

  /// Where the valves are from sample `first` on, the dead time later.
  template <ValveLaw law>
  void follow(std::size_t first, std::size_t count, Numbers* positions) {
    std::size_t k = 0;
    for (; k < count && first + k <= delay_; ++k) positions[k] = valves_.position;
    while (k < count) {
      const std::size_t until =
          restart_ < restarts_.size() ? restarts_[restart_].at_sample : shared_.samples;
      if (until <= now_) {
        step<law>();
        positions[k++] = valves_.position;
        continue;
      }
      const std::size_t free = std::min(count - k, until - now_);
      Valves valves = valves_;
      const OpStep<Element>* steps = &shared_.steps[now_];
      for (std::size_t i = 0; i < free; ++i) {
        valves.template step<law>(friction_, steps[i]);
        positions[k + i] = valves.position;
      }
      valves_ = valves;
      now_ += free;
      k += free;
    }
  }

  const BatchRecord<Element>& shared_;
  std::size_t delay_;
  AnswerSums<Number, kVectorsAtOnce> sums_;
  std::array<FrictionIn<Number>, kVectorsAtOnce> friction_{};
  Valves valves_;
  std::vector<LaneRestart<Element>> restarts_;
  std::size_t restart_ = 0, now_ = 0;
};

}  // namespace loopscope::core::model
