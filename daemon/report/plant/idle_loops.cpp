#include "daemon/report/plant/idle_loops.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <string>

#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

List named(const storage::UnjudgedReason& reason, const LoopLinks& links) {
  List names;
  for (const std::string& name : reason.names)
    names.emplace_back(Fields{
        {"between", names.empty() ? "" : ", "}, {"link", links.to_page(name)}, {"name", name}});
  return names;
}

Fields unjudged_fields(const storage::UnjudgedReason& reason, const LoopLinks& links,
                       const TimeZone& zone) {
  const auto more = reason.loops - static_cast<std::int64_t>(reason.names.size());
  return {{"loops", reason.loops},
          {"reason", reason.words},
          {"named", named(reason, links)},
          {"more", more > 0 ? fmt::format(" and {} more", more) : ""},
          {"remedy", with_times_in_zone(reason.remedy, zone)}};
}

std::string lost_words(const storage::NotControllingRow& row) {
  return row.lost_by == "mode" ? "manual, tracking or out of service" : "constant output";
}

Fields open_loop_fields(const storage::NotControllingRow& row, const LoopLinks& links,
                        const TimeZone& zone) {
  return {{"link", links.to_page(row.loop_name)},
          {"name", row.loop_name},
          {"area", row.area.value_or("")},
          {"state", lost_words(row)},
          {"since", row.since_us ? minute_in_zone(*row.since_us, zone) : ""},
          {"in_service", row.week_fraction ? core::text::percent(*row.week_fraction) : ""}};
}

template <typename Row>
std::span<const Row> first_of(const std::vector<Row>& all) {
  return std::span(all).first(std::min(all.size(), kMostIdle));
}

template <typename Row>
std::string others_of(const std::vector<Row>& all, const char* one, const char* several) {
  if (all.size() <= kMostIdle) return {};
  return core::text::counted(static_cast<std::int64_t>(all.size() - kMostIdle), one, several);
}

}  // namespace

Markup idle_loops(const storage::PlantCounts& counts, const LoopLinks& links,
                  const TimeZone& zone) {
  if (counts.without_controller.empty() && counts.reasons.empty()) return {};
  const auto open_loop = [&](const auto& row) { return open_loop_fields(row, links, zone); };
  const auto unjudged = [&](const auto& reason) { return unjudged_fields(reason, links, zone); };
  return render("idle_loops",
                {// What plants look at first: whether the controllers are in service at all.
                 {"any_without_controller", !counts.without_controller.empty()},
                 {"without_controller", rows(first_of(counts.without_controller), open_loop)},
                 {"more_open", others_of(counts.without_controller, "more loop", "more loops")},
                 {"open_link", links.to_loops("?verdict=not_controlling")},
                 {"any_unjudged", !counts.reasons.empty()},
                 {"unjudged", rows(first_of(counts.reasons), unjudged)},
                 {"more_reasons", others_of(counts.reasons, "more reason", "more reasons")},
                 {"unjudged_link", links.to_loops("?verdict=insufficient_data")}});
}

}  // namespace loopscope::daemon
