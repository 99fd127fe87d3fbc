#include "core/model/selection/steps_after_moves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/signal/order/spread.hpp"
#include "core/signal/setpoint_moves.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// A step's place is known to so many rows: its fit moves it about by four at first.
constexpr double kEarlyRows = 4.0;
constexpr double kLateRows = 8.0;
/// Of pv's standard deviation: the answer to a smaller move is nothing that a load step could pass
/// for, and a setpoint that comes out of another controller moves so much at every sample.
constexpr double kLeastMove = 0.1;
/// The dead time that the model has may be half of the one that it should have.
constexpr double kDeadTimes = 2.0;
/// More often it says nothing.
constexpr double kWorthSaying = 0.25;

/// sp while the controller was at work: in manual, where the error is missing beside a pv that is
/// not, nothing answers it, and it may go after pv.
std::vector<double> obeyed_setpoint(const ModelInput& input) {
  std::vector<double> sp(input.sp.begin(), input.sp.end());
  for (std::size_t k = 0; k < input.error.size(); ++k) {
    const bool in_manual = std::isnan(input.error[k]) && !std::isnan(input.pv[k]);
    if (in_manual) sp[k] = std::numeric_limits<double>::quiet_NaN();
  }
  return sp;
}

class Answers {
 public:
  Answers(const ModelInput& input, double samples_per_row, double delay_s)
      : interval_s_(input.sample_interval_s),
        early_(kEarlyRows * samples_per_row),
        late_(kDeadTimes * delay_s / interval_s_ + kLateRows * samples_per_row),
        answering_(input.sp.size(), false) {
    const auto pv = signal::measure_spread(input.pv);
    const double least = pv ? kLeastMove * pv->std : 0.0;
    for (const signal::SetpointMove& move : signal::find_setpoint_moves(obeyed_setpoint(input))) {
      if (std::abs(move.size) < least) continue;
      answer_to(move.first);
      answer_to(move.last);
    }
  }

  [[nodiscard]] bool during(double at_s) const {
    const auto sample = static_cast<std::size_t>(std::max(0.0, at_s / interval_s_));
    return sample < answering_.size() && answering_[sample];
  }
  [[nodiscard]] double share() const {
    return static_cast<double>(std::ranges::count(answering_, true)) /
           static_cast<double>(answering_.size());
  }
  [[nodiscard]] double length_s() const { return late_ * interval_s_; }

 private:
  void answer_to(std::size_t sample) {
    const auto at = static_cast<double>(sample);
    const auto last = static_cast<double>(answering_.size());
    const auto from = static_cast<std::ptrdiff_t>(std::max(0.0, at - early_));
    const auto end = static_cast<std::ptrdiff_t>(std::min(last, at + late_ + 1.0));
    std::fill(answering_.begin() + from, answering_.begin() + end, true);
  }

  double interval_s_;
  double early_;
  double late_;
  std::vector<bool> answering_;
};

bool is_load_step(const Step& step) {
  return step.effect == EffectKind::load_step;
}

double place_of(const Step& step) {
  return step.parameters.front().value;
}

/// Times at which loads moved, a time apart at least: several steps make up one that is not sudden.
std::vector<double> moments_of(const std::vector<Step>& steps, double apart_s) {
  std::vector<double> all;
  for (const Step& step : steps) {
    if (is_load_step(step)) all.push_back(place_of(step));
  }
  std::ranges::sort(all);
  std::vector<double> moments;
  for (const double at_s : all) {
    if (moments.empty() || at_s - moments.back() > apart_s) moments.push_back(at_s);
  }
  return moments;
}

/// That so many of `all`, a few, are among a share of everything, or more: binomial.
double chance_of(std::size_t many, std::size_t all, double share) {
  if (many == 0) return 1.0;
  if (many > all) return 0.0;
  return share * chance_of(many - 1, all - 1, share) +
         (1.0 - share) * chance_of(many, all - 1, share);
}

struct Coincidence {
  std::size_t moments = 0;
  std::size_t answering = 0;
  double chance = 1.0;
};

Coincidence coincidence_of(const Answers& answers, const std::vector<Step>& steps) {
  const std::vector<double> moments = moments_of(steps, answers.length_s());
  const auto during = [&](double at_s) { return answers.during(at_s); };
  Coincidence result{moments.size(),
                     static_cast<std::size_t>(std::ranges::count_if(moments, during))};
  result.chance = chance_of(result.answering, result.moments, answers.share());
  return result;
}

std::string words_of(const Coincidence& found) {
  return " It begins when the loop responds to its setpoint, as do " +
         std::to_string(found.answering) + " of " + std::to_string(found.moments) +
         " (by chance: " + text::percent(found.chance) +
         "); rather than a load, it may be a response that differs from the model's.";
}

}  // namespace

void find_steps_after_moves(const ModelInput& input, std::size_t samples_per_row,
                            Explanation& explanation) {
  if (input.sp.empty() || std::ranges::none_of(explanation.steps, is_load_step)) return;
  const Answers answers(input, static_cast<double>(samples_per_row),
                        explanation.baseline.process.delay_s);
  const Coincidence found = coincidence_of(answers, explanation.steps);
  for (Step& step : explanation.steps) {
    if (!is_load_step(step) || !answers.during(place_of(step))) continue;
    step.setpoint_chance = found.chance;
    if (found.chance <= kWorthSaying) step.statement += words_of(found);
  }
}

}  // namespace loopscope::core::model
