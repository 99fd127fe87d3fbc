#include "core/model/residual_tests/tests/time_event.hpp"

#include "core/model/residual_tests/statistics/outbursts.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::model {
namespace {

std::string words_of(const Outburst& event, const ResidualContext& context) {
  return text::units_of_pv(event.mean * context.fresh.std) +
         (event.samples > 1 ? " over " + std::to_string(event.samples) + " samples " : " ") +
         text::at_place(event.at_sample, context.view.sample_interval_s);
}

}  // namespace

TestOutcome test_time_event(const ResidualContext& context) {
  const Outbursts found = find_outbursts(context.fresh.values);
  TestOutcome answer{{"time_event", found.p, {}}, {}};
  for (const Outburst& event : found.events) {
    answer.question.statement += !answer.question.statement.empty() ? "; "
                                 : found.events.size() == 1
                                     ? "A sudden disturbance beyond the noise: "
                                     : "Sudden disturbances beyond the noise: ";
    answer.question.statement += words_of(event, context);
    answer.nominations.push_back({.effect = EffectKind::load_step,
                                  .p = found.p,
                                  .at_sample = event.at_sample,
                                  .size = event.mean * context.fresh.std});
  }
  if (!answer.question.statement.empty()) answer.question.statement += ".";
  return answer;
}

}  // namespace loopscope::core::model
