#include "core/model/effects/load_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

/// A step of a vessel's load is a ramp of its level: scaled to stay near one.
constexpr double kRampScale = 0.01;
/// A process that answers within a sample still has a load that takes a few.
constexpr double kShortestLag = 0.6;
/// A load that takes longer than some hundred samples to arrive has no size within the record.
constexpr double kLongestLag = 0.97;
/// A lag of its own, samples: below, a load moves at once; above, it is a drift.
constexpr double kShortestOwn = 0.3;
constexpr double kLongestOwn = 30.0;
/// Where the search for it begins, so that it finds any of them by halves and doubles.
constexpr std::array kFirstLags = {1.5, 5.0, 15.0};
/// From the process's lag to one of its own only while places are far apart.
constexpr double kCoarse = 0.5;

}  // namespace

void LoadStep::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  Column step(signals.flow.size(), 0.0);
  std::fill(step.begin() + static_cast<std::ptrdiff_t>(std::min(at_, step.size())), step.end(),
            1.0);
  Column lagged = step;
  if (lag_samples_ > 0.0) {
    lag(std::exp(-1.0 / lag_samples_), lagged);
  } else if (signals.process.integrating) {
    ProcessShape vessel;
    vessel.integrating = true;
    vessel.delay_samples = 0;
    respond(vessel, step, lagged);
    for (double& value : lagged) value *= kRampScale;
  } else {
    lag(std::clamp(signals.process.pole, kShortestLag, kLongestLag), lagged);
  }
  columns.push_back(std::move(step));
  columns.push_back(std::move(lagged));
}

std::vector<EffectPtr> LoadStep::neighbours(double scale) const {
  constexpr double kMove = 4.0;  // rows
  const double samples = kMove * scale * static_cast<double>(samples_per_row_);
  const auto move = static_cast<std::size_t>(std::max(1.0, samples));
  std::vector<EffectPtr> result{moved(at_ + move, lag_samples_)};
  if (at_ >= move + (at_ < kEarliest ? 1 : kEarliest))
    result.push_back(moved(at_ - move, lag_samples_));
  if (lag_samples_ > 0.0) {
    const double factor = std::exp2(scale);
    for (const double lag_samples : {lag_samples_ * factor, lag_samples_ / factor})
      result.push_back(moved(at_, std::clamp(lag_samples, kShortestOwn, kLongestOwn)));
  } else if (scale >= kCoarse) {
    for (const double lag_samples : kFirstLags) result.push_back(moved(at_, lag_samples));
  }
  return result;
}

EffectPtr LoadStep::moved(std::size_t at, double lag_samples) const {
  return std::make_shared<LoadStep>(at, samples_per_row_, lag_samples);
}

std::vector<Parameter> LoadStep::parameters(const LoopData& data,
                                            std::span<const double> coefficients, double) const {
  const double at_s = static_cast<double>(at_) * data.sample_interval_s;
  const double size = (coefficients[0] + coefficients[1]) * data.pv_scale;
  return {{"at", "s", at_s, {}, {}}, {"size", "pv", size, {}, {}}};
}

std::string LoadStep::words(std::span<const Parameter> parameters) const {
  return "The load moved " + text::duration(parameters[0].value) + " into the window, by " +
         text::units_of_pv(parameters[1].value) + ", and stayed.";
}

}  // namespace loopscope::core::model
