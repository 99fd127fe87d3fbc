#include "daemon/report/plant/event_box.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/plant/follow_map.hpp"
#include "daemon/report/sections/cause_bars.hpp"
#include "daemon/report/sections/picture_rows.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::PlantOscillationRow;
using Member = PlantOscillationRow::Member;

/// Candidates for the source that are told of; less likely ones tell nothing.
constexpr std::size_t kMostCandidates = 4;
constexpr double kLeastOdds = 0.03;
/// Rows of the table; the others are named below it.
constexpr std::size_t kMostRowsOfBox = 16;
/// Statements begin so that speak against a loop (core/plant/source_evidence).
constexpr std::string_view kAgainst = "Against it: ";

/// The colour stands in the drawing: WeasyPrint 57 gives those in a page no style of the page.
Fields odds_fields(double probability, const char* colour) {
  return {{"colour", colour},
          {"width", std::lround(100.0 * probability)},
          {"share", core::text::percent(probability)}};
}

List for_and_against(const Member& member) {
  std::vector<std::string> in_favour, against;
  for (const std::string& reason : member.reasons) {
    if (reason.starts_with(kAgainst))
      against.push_back(as_heading(reason.substr(kAgainst.size())));
    else
      in_favour.push_back(as_heading(reason));
  }
  return weights(in_favour, against);
}

/// What speaks for the first one is open to see.
Fields candidate(const Member& member, bool open) {
  Fields fields = odds_fields(*member.score, "#b34700");
  fields.insert(fields.end(), {{"outside", false},
                               {"open", open},
                               {"name", member.loop_name},
                               {"weights", for_and_against(member)}});
  return fields;
}

Fields the_outside(double probability) {
  Fields fields = odds_fields(probability, "#57606a");
  fields.insert(fields.end(), {{"outside", true}, {"open", false}, {"weights", false}});
  return fields;
}

std::vector<const Member*> likeliest(const PlantOscillationRow& event) {
  std::vector<const Member*> members;
  for (const Member& member : event.members)
    if (member.score) members.push_back(&member);
  std::ranges::stable_sort(members, std::ranges::greater(),
                           [](const Member* member) { return *member->score; });
  if (members.size() > kMostCandidates) members.resize(kMostCandidates);
  while (members.size() > 1 && *members.back()->score < kLeastOdds) members.pop_back();
  return members;
}

/// Scores of a program that did not weigh the outside are no probabilities.
List odds(const PlantOscillationRow& event) {
  if (!event.outside) return {};
  List shares;
  bool outside_told = false;
  const std::vector<const Member*> members = likeliest(event);
  for (const Member* member : members) {
    if (!outside_told && *event.outside > *member->score) {
      shares.push_back(the_outside(*event.outside));
      outside_told = true;
    }
    shares.push_back(candidate(*member, member == members.front()));
  }
  if (!outside_told) shares.push_back(the_outside(*event.outside));
  return shares;
}

Fields member_fields(const Member& member, const PlantOscillationRow& event, std::string link) {
  const std::string lag = lag_words(member, event);
  const bool weighed = event.outside && member.score;
  return {{"place", &member - event.members.data() + 1},
          {"link", std::move(link)},
          {"name", member.loop_name},
          {"role", role_words(member.role)},
          {"share", core::text::percent(member.strength)},
          {"lag", lag.empty() ? kUnknown : lag},
          {"probability", weighed ? core::text::percent(*member.score) : kUnknown}};
}

}  // namespace

Markup event_box(const PlantOscillationRow& event, std::span<const Picture> pictures,
                 const LoopLinks& links, const TimeZone& zone) {
  const auto fields = [&](const Member& member) {
    return member_fields(member, event, links.to_loop(member.loop_id, member.loop_name));
  };
  const std::span<const Member> members(event.members);
  const std::size_t shown = std::min(kMostRowsOfBox, members.size());
  const auto others = static_cast<std::int64_t>(members.size() - shown);
  const Markup map = follow_map(event);
  // The list stands beside map and pictures: its numbers are theirs.
  return render(
      "event_box",
      {{"number", event.number},
       {"folded", !links.is_live()},
       {"period", core::text::duration(event.period_s)},
       {"loops", core::text::counted(static_cast<std::int64_t>(members.size()), "loop", "loops")},
       {"source", event.source_name.value_or("")},
       {"statement", event.statement},
       {"until", minute_in_zone(event.slot_end_us, zone)},
       {"any_odds", event.outside.has_value()},
       {"odds", odds(event)},
       {"any_drawn", !pictures.empty() || !map.html.empty()},
       {"pictures", picture_rows(pictures)},
       {"map", map},
       {"members", rows(members.first(shown), fields)},
       {"others", others == 0 ? "" : core::text::counted(others, "loop", "loops")},
       {"smaller", rows(members.subspan(shown), fields)}});
}

Markup event_boxes(std::span<const PlantOscillationRow> events, const EventAlbum& album,
                   const std::string& picture_trouble, const LoopLinks& links,
                   const TimeZone& zone) {
  if (events.empty()) return {};
  std::vector<Markup> boxes;
  for (const PlantOscillationRow& event : events)
    boxes.push_back(event_box(event, album.of_event(event.number), links, zone));
  return render("event_boxes", {{"picture_trouble", picture_trouble}, {"boxes", boxes}});
}

}  // namespace loopscope::daemon
