#include "daemon/report/annotate/annotate_section.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "daemon/catalogue/annotation_wish.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/plant/annotated_table.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

struct Deed {
  const char* value;
  const char* words;
  const char* meaning;
};

constexpr std::array kDeeds = {
    Deed{"acknowledge", "Acknowledge",
         "Known, work is planned: off the list until work done since is entered and a window lies "
         "wholly after it, or until it is withdrawn."},
    Deed{"suppress", "Suppress", "Off the list until the time below, for the reason below."},
    Deed{"false-positive", "Mark as a false positive",
         "The verdict is wrong: off the list until it is withdrawn."}};

List deeds(const AnnotateFacts& facts) {
  const std::string& typed = facts.typed.deed;
  return rows(kDeeds, [&](const Deed& deed) {
    const bool first = typed.empty() || typed == "withdraw";
    return Fields{{"value", deed.value},
                  {"words", deed.words},
                  {"meaning", deed.meaning},
                  {"taken", first ? &deed == kDeeds.data() : typed == deed.value}};
  });
}

/// The verdict that is there, and any; what was chosen before, should it be another by now.
List codes(const AnnotateFacts& facts) {
  std::vector<std::string> all;
  if (facts.found && facts.found->kind_weight > 0.0) all.push_back(facts.found->code);
  all.emplace_back(kAnyCode);
  const std::string& typed = facts.typed.code;
  if (!typed.empty() && std::ranges::count(all, typed) == 0) all.insert(all.begin(), typed);
  return rows(all, [&](const std::string& code) {
    return Fields{
        {"value", code},
        {"words", code == kAnyCode ? "whatever the verdict" : "verdict " + in_words(code)},
        {"taken", code == (typed.empty() ? all.front() : typed)}};
  });
}

List said(const AnnotateFacts& facts) {
  return rows(facts.in_force, [&](const storage::Annotation& one) {
    return Fields{{"deed", deed_words(one.kind)},
                  {"about", one.code ? "verdict " + in_words(*one.code) : "whatever the verdict"},
                  {"author", author_text(one.author, one.on_behalf_of)},
                  {"entered", minute_in_zone(one.entered_at_us, facts.zone)},
                  {"said_until", until_words(one.kind, one.until_us, facts.zone)},
                  {"reason", one.reason},
                  {"annotation", one.annotation_id}};
  });
}

Fields finding(const AnnotateFacts& facts) {
  const bool found = facts.found.has_value();
  const storage::FlaggedRow row = facts.found.value_or(storage::FlaggedRow{});
  return {{"found", found},
          {"never", !found && !facts.away},
          {"code", row.code},
          {"verdict", as_heading(row.code)},
          {"confidence", two_decimals(row.believed())},
          {"since", minute_in_zone(row.since_us, facts.zone)},
          {"until", minute_in_zone(row.slot_end_us, facts.zone)},
          {"summary", row.summary},
          {"action", row.action}};
}

}  // namespace

Markup annotate_section(const AnnotateFacts& facts) {
  Fields fields = {{"user", facts.user},
                   {"name", facts.loop_name},
                   {"loop_link", LoopLinks::pages().to_page(facts.loop_name)},
                   {"token", facts.token},
                   {"trouble", facts.trouble},
                   {"told", facts.told},
                   {"away", facts.away},
                   {"any_said", !facts.in_force.empty()},
                   {"said", said(facts)},
                   {"deeds", deeds(facts)},
                   {"codes", codes(facts)},
                   {"typed_reason", facts.typed.reason},
                   {"typed_until", facts.typed.until},
                   {"zone", facts.zone.name()}};
  std::ranges::move(finding(facts), std::back_inserter(fields));
  return render("annotate_section", std::move(fields));
}

}  // namespace loopscope::daemon
