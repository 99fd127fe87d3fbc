#include "daemon/report/figures/shown_model.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::daemon {
namespace {

using core::model::TraceStage;
using Series = std::vector<double>;

/// Mean square of the difference over the samples that both have; NaN without one.
double distance(const Series& left, const Series& right, std::size_t from, std::size_t samples) {
  double sum = 0.0;
  double count = 0.0;
  const std::size_t end = std::min({from + samples, left.size(), right.size()});
  for (std::size_t k = from; k < end; ++k) {
    const double off = left[k] - right[k];
    if (!std::isfinite(off)) continue;
    sum += off * off;
    count += 1.0;
  }
  return sum / count;
}

}  // namespace

const Series& ShownModel::series_of(const TraceStage& stage) const {
  return simulated ? stage.simulated : stage.one_step_prediction;
}

std::string_view ShownModel::words() const {
  return simulated ? "run on op alone" : "predicting one sample ahead";
}

ShownModel shown_model(const Series& measured, const std::vector<const TraceStage*>& stages,
                       std::size_t from, std::size_t samples) {
  const auto lacks = [&](Series TraceStage::*series) {
    return std::ranges::any_of(stages, [&](const auto* stage) { return (stage->*series).empty(); });
  };
  if (lacks(&TraceStage::one_step_prediction)) return {true};
  if (lacks(&TraceStage::simulated)) return {false};
  for (std::size_t k = 1; k < stages.size(); ++k) {
    const double before = distance(measured, stages[k - 1]->simulated, from, samples);
    const double after = distance(measured, stages[k]->simulated, from, samples);
    if (!(after <= before)) return {false};
  }
  return {true};
}

}  // namespace loopscope::daemon
