#include "daemon/report/sections/follow_words.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "core/model/results/phrases.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

std::string source_of(const storage::FollowedRow& followed) {
  if (!followed.source_name) return ", whose source is not known";
  return " of <bdi>" + html(*followed.source_name) + "</bdi>";
}

}  // namespace

bool is_only_shaken(const LoopReport& story) {
  // A stay on the list is headed by its last fault, whatever the newest window says.
  return story.followed && story.row.code == "healthy" && story.followed->shown_code != "healthy";
}

std::string shown_code(const LoopReport& story) {
  return is_only_shaken(story) ? story.followed->shown_code : story.row.code;
}

std::string follow_sentence(const storage::FollowedRow& followed) {
  return fmt::format("{} of its error follows plant-wide oscillation {}{} (period {})",
                     core::model::in_percent(followed.strength), followed.number,
                     source_of(followed), core::model::in_time(followed.period_s));
}

std::string shaken_cause(const LoopReport& story) {
  return follow_sentence(*story.followed) +
         fmt::format(". By itself the loop is sound ({}, confidence {}): {}",
                     html(in_words(story.row.code)), two_decimals(story.row.confidence),
                     html(story.row.summary));
}

std::string shaken_action(const LoopReport& story) {
  const std::string later = "; this loop needs no work of its own; check again afterwards.";
  if (!story.followed->source_name)
    return "Find the source of the oscillation: what its loops have in common upstream" + later;
  return "Repair the source <bdi>" + html(*story.followed->source_name) + "</bdi> first" + later;
}

std::string follow_entry(const LoopReport& story) {
  if (!story.followed || is_only_shaken(story)) return {};
  return "<dt>Follows</dt><dd>" + follow_sentence(*story.followed) + ".</dd>\n";
}

}  // namespace loopscope::daemon
