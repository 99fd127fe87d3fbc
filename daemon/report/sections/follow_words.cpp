#include "daemon/report/sections/follow_words.hpp"

#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"

namespace loopscope::daemon {
bool is_only_shaken(const LoopReport& loop_report) {
  // A stay on the list is headed by its last fault, whatever the newest window says.
  return loop_report.followed && loop_report.row.code == "healthy" &&
         loop_report.followed->shown_code != "healthy";
}

std::string shown_code(const LoopReport& loop_report) {
  return is_only_shaken(loop_report) ? loop_report.followed->shown_code : loop_report.row.code;
}

Markup follow_sentence(const storage::FollowedRow& followed) {
  return render("follow_sentence", {{"share", core::text::percent(followed.strength)},
                                    {"number", followed.number},
                                    {"source", followed.source_name.value_or("")},
                                    {"period", core::text::duration(followed.period_s)}});
}

}  // namespace loopscope::daemon
