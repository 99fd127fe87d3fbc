#include "core/model/effects/gain_change.hpp"

#include <algorithm>
#include <cmath>

#include "core/model/effects/input_load.hpp"
#include "core/model/effects/load_step.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

double ratio_of(std::span<const double> coefficients, double gain) {
  return gain == 0.0 ? 1.0 : 1.0 + coefficients[0] / gain;
}

}  // namespace

/// The flow meets the new gain when it comes out of the dead time, before the lags: pv goes over to
/// it as smoothly as the process does, and an integrator keeps its level.
void GainChange::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  const InputLoad level(at_, until_);
  Column changed = level.course(signals);
  for (std::size_t k = 0; k < changed.size(); ++k) changed[k] *= signals.flow[k];
  columns.push_back(answer(signals.process, changed));
  level.add_columns(signals, columns);
}

std::vector<EffectPtr> GainChange::neighbours(double scale) const {
  constexpr double kMove = 64.0;  // samples
  // The finest moves are of a sample: the level shows the place so sharply.
  const auto move = static_cast<std::size_t>(std::max(1.0, kMove * std::pow(scale, 1.5)));
  std::vector<EffectPtr> result;
  if (at_ >= move + (sudden() ? kEarliest : 0))
    result.push_back(std::make_shared<GainChange>(at_ - move, sudden() ? at_ - move : until_));
  result.push_back(std::make_shared<GainChange>(
      at_ + move, sudden() ? at_ + move : std::max(until_, at_ + move + 1)));
  if (!sudden()) {
    result.push_back(std::make_shared<GainChange>(at_, until_ + move));
    if (until_ > at_ + move + 1) result.push_back(std::make_shared<GainChange>(at_, until_ - move));
  }
  return result;
}

std::vector<Parameter> GainChange::parameters(const LoopData& data,
                                              std::span<const double> coefficients,
                                              double gain) const {
  const double ratio = ratio_of(coefficients, gain);
  const double at_s = static_cast<double>(at_) * data.sample_interval_s;
  std::vector<Parameter> result{{"at", "s", at_s, {}, {}}, {"ratio", "", ratio, {}, {}}};
  if (until_ > at_) {
    const double hours = static_cast<double>(until_ - at_) * data.sample_interval_s / 3600.0;
    result.push_back({"rate", "1/h", (ratio - 1.0) / hours, {}, {}});
  }
  return result;
}

std::vector<EffectPtr> GainChange::plainer() const {
  std::vector<EffectPtr> result{std::make_shared<InputLoad>(at_, until_)};
  if (sudden()) result.push_back(std::make_shared<LoadStep>(at_));
  return result;
}

bool GainChange::plausible(std::span<const double> coefficients, double gain) const {
  constexpr double kMost = 5.0;
  constexpr double kWholeRange = 100.0;  // % from the mean of op to the working point
  const double ratio = ratio_of(coefficients, gain);
  return ratio >= 1.0 / kMost && ratio <= kMost &&
         std::abs(coefficients[1]) <= kWholeRange * std::abs(coefficients[0]);
}

std::string GainChange::words(std::span<const Parameter> parameters) const {
  return std::string("The gain of the process ") + (sudden() ? "changes" : "drifts") + " to " +
         text::number(parameters[1].value) + " times what it was, from " +
         text::duration(parameters[0].value) + " into the window on.";
}

}  // namespace loopscope::core::model
