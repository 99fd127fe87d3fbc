#include "daemon/report/sections/loop_list.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>

#include "daemon/report/page/template.hpp"
#include "daemon/report/sections/loop_request.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::LoopRow;

/// The state that can be asked for; of a flagged loop whether it is confirmed.
std::string status_of(const LoopRow& row) {
  const std::string state(row.state);
  return row.status ? state + ", " + status_words(std::string(*row.status)) : state;
}

/// A loop that was never analysed has no page.
std::string page_link(const LoopRow& row) {
  return row.code ? LoopLinks::pages().to_page(std::string(row.name)) : "";
}

Fields loop_fields(const LoopRow& row, const TimeZone& zone) {
  const std::string_view code = shown_verdict(row);
  return {{"verdict", row.code ? as_heading(code) : ""},
          {"status", status_of(row)},
          {"reason", row.hidden_by == row.state ? "" : row.hidden_by.value_or("")},
          {"link", page_link(row)},
          {"name", row.name},
          {"area", row.area.value_or(kUnknown)},
          {"unit", row.unit.value_or(kUnknown)},
          {"description", row.description.value_or("")},
          {"code", row.code ? code : ""},
          {"by_itself", row.code && code != *row.code ? *row.code : ""},
          {"confidence", row.confidence ? two_decimals(*row.confidence) : kUnknown},
          {"follows", row.follows.value_or("")},
          {"rank", row.rank ? std::to_string(*row.rank) : kUnknown},
          {"until", row.slot_end_us ? minute_in_zone(*row.slot_end_us, zone) : kUnknown},
          {"health", in_words(row.health)}};
}

/// A choice of the form, the one that is taken marked.
List options(const std::vector<std::string>& values, const std::string& taken,
             std::string (*words)(std::string_view)) {
  List list;
  const auto add = [&](const std::string& value) {
    list.emplace_back(Fields{{"value", value}, {"words", words(value)}, {"taken", value == taken}});
  };
  for (const std::string& value : values) add(value);
  // No loop has it (any more): it is asked for all the same.
  if (!taken.empty() && std::ranges::find(values, taken) == values.end()) add(taken);
  return list;
}

std::string as_it_is(std::string_view text) {
  return std::string(text);
}

std::string verdict_words(std::string_view code) {
  return code == "none" ? "never analysed" : as_heading(code);
}

struct Column {
  LoopOrder order = LoopOrder::rank;
  const char* words = "";
  bool number = false;
  bool largest_first = false;
};
constexpr std::array kColumns{Column{LoopOrder::name, "Loop"},
                              Column{LoopOrder::area, "Area"},
                              Column{LoopOrder::unit, "Unit"},
                              Column{LoopOrder::verdict, "Verdict"},
                              Column{LoopOrder::confidence, "Confidence", true, true},
                              Column{LoopOrder::state, "State"},
                              Column{LoopOrder::rank, "Rank", true},
                              Column{LoopOrder::window, "Window until", false, true}};

/// A header leads to its order, and once that is taken to the same backwards.
Fields header(const Column& column, LoopQuery query) {
  const bool taken = query.order == column.order;
  const bool falls = query.backwards != column.largest_first;
  const std::string direction = !taken ? "" : falls ? "descending" : "ascending";
  query.backwards = taken && !query.backwards;
  query.order = column.order;
  query.skip = 0;
  return {{"words", column.words},
          {"number", column.number},
          {"direction", direction},
          {"address", loops_address(query)}};
}

Fields form(const LoopListing& listing, const LoopQuery& query) {
  List orders;
  for (const Column& column : kColumns)
    orders.emplace_back(Fields{{"value", name(column.order)},
                               {"words", column.words},
                               {"taken", column.order == query.order}});
  return {{"part", query.part},
          {"areas", options(listing.areas, query.area, as_it_is)},
          {"any_areas", !listing.areas.empty() || !query.area.empty()},
          {"units", options(listing.units, query.unit, as_it_is)},
          {"any_units", !listing.units.empty() || !query.unit.empty()},
          {"verdicts", options(listing.verdicts, query.verdict, verdict_words)},
          {"states", options(loop_states(), query.state, as_it_is)},
          {"orders", orders},
          {"backwards", query.backwards}};
}

/// The first and the last page and those around this one; the gaps between are not said.
List pages(const LoopListing& listing, LoopQuery query) {
  const std::int64_t here = listing.skip / kLoopsOnPage;
  const std::int64_t last = (listing.fitting - 1) / kLoopsOnPage;
  List list;
  for (std::int64_t page = 0; page <= last; ++page) {
    if (page != 0 && page != last && std::abs(page - here) > 2) continue;
    query.skip = page * kLoopsOnPage;
    list.emplace_back(
        Fields{{"number", page + 1}, {"here", page == here}, {"address", loops_address(query)}});
  }
  return list;
}

std::string range_words(const LoopListing& listing) {
  if (listing.loops.empty()) return fmt::format("none of {} fits", listing.all);
  const auto last = listing.skip + static_cast<std::int64_t>(listing.loops.size());
  return fmt::format("{} to {} of {}", listing.skip + 1, last, listing.fitting) +
         (listing.fitting == listing.all ? "" : fmt::format(" ({} in all)", listing.all));
}

}  // namespace

Markup loop_list(const LoopListing& listing, const LoopQuery& query, const TimeZone& zone) {
  const auto fields = [&](const LoopRow& row) { return loop_fields(row, zone); };
  const auto header_of = [&](const Column& column) { return header(column, query); };
  Fields all = form(listing, query);
  all.insert(all.end(), {{"headers", rows(kColumns, header_of)},
                         {"loops", rows(listing.loops, fields)},
                         {"range", range_words(listing)},
                         {"everything", loops_address({})},
                         {"several", listing.fitting > kLoopsOnPage},
                         {"pages", pages(listing, query)}});
  return render("loop_list", all);
}

}  // namespace loopscope::daemon
