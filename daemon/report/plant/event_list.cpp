#include "daemon/report/plant/event_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string>

#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"

namespace loopscope::daemon {

std::string source_words(const storage::PlantOscillationRow& event) {
  using Member = storage::PlantOscillationRow::Member;
  const auto likeliest = std::ranges::max_element(
      event.members, {}, [](const Member& member) { return member.score.value_or(-1.0); });
  // Scores of a program that did not weigh the outside are no probabilities.
  if (!event.outside || likeliest == event.members.end() || !likeliest->score)
    return event.source_name.value_or("unknown");
  if (*event.outside > *likeliest->score)
    return fmt::format("outside of the recorded loops ({})", core::text::percent(*event.outside));
  return fmt::format("{} ({})", likeliest->loop_name, core::text::percent(*likeliest->score));
}

Markup event_list(std::span<const storage::PlantOscillationRow> events) {
  if (events.empty()) return {};
  const auto fields = [](const storage::PlantOscillationRow& event) {
    return Fields{{"number", event.number},
                  {"link", fmt::format("/oscillation?number={}", event.number)},
                  {"period", core::text::duration(event.period_s)},
                  {"loops", static_cast<std::int64_t>(event.members.size())},
                  {"source", source_words(event)},
                  {"statement", event.statement}};
  };
  return render("event_list", {{"events", rows(events, fields)}});
}

}  // namespace loopscope::daemon
