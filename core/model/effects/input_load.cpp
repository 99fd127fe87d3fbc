#include "core/model/effects/input_load.hpp"

#include <algorithm>

#include "core/text/phrases.hpp"

namespace loopscope::core::model {

Column InputLoad::course(const Signals& signals) const {
  Column course(signals.flow.size());
  const auto length = static_cast<double>(std::max<std::size_t>(1, until_ - at_));
  for (std::size_t k = 0; k < course.size(); ++k) {
    const double since =
        static_cast<double>(k + signals.process.delay_samples) - static_cast<double>(at_);
    course[k] = until_ == at_ ? (since >= 0.0 ? 1.0 : 0.0) : std::clamp(since / length, 0.0, 1.0);
  }
  return course;
}

void InputLoad::add_columns(const Signals& signals, std::vector<Column>& columns) const {
  columns.push_back(answer(signals.process, course(signals)));
}

std::vector<Parameter> InputLoad::parameters(const LoopData& data,
                                             std::span<const double> coefficients, double) const {
  const double at_s = static_cast<double>(at_) * data.sample_interval_s;
  return {{"at", "s", at_s, {}, {}}, {"size", "pv", coefficients[0] * data.pv_scale, {}, {}}};
}

std::string InputLoad::words(std::span<const Parameter> parameters) const {
  return "The load before the process moved " + text::duration(parameters[0].value) +
         " into the window, by " + text::units_of_pv(parameters[1].value) + ", and stayed.";
}

}  // namespace loopscope::core::model
