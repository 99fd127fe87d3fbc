#include "daemon/report/sections/loop_list.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <span>

#include "daemon/report/page/template.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::LoopRow;

/// A browser lays out no more with ease; loopscope.latest_verdict has all.
constexpr std::size_t kMostRows = 5000;

std::string status_of(const LoopRow& row) {
  if (row.status) return status_words(*row.status);
  if (row.hidden_by) return "not on the list: " + *row.hidden_by;
  return row.code ? "not flagged" : "never analysed";
}

/// A loop that is healthy by itself and shaken by others is not shown as healthy.
std::string code_shown(const LoopRow& row) {
  return row.shown_code ? *row.shown_code : row.code.value_or("");
}

/// A loop that was never analysed has no page.
std::string page_link(const LoopRow& row) {
  return row.code ? loop_link(LoopLinks::pages, row.loop_id, row.name) : "";
}

Fields loop_fields(const LoopRow& row, const TimeZone& zone) {
  const std::string code = code_shown(row);
  return {{"verdict", as_heading(code)},
          {"status", status_of(row)},
          {"link", page_link(row)},
          {"name", row.name},
          {"type", row.loop_type.value_or(kUnknown)},
          {"source", row.source},
          {"code", row.code ? code : ""},
          {"by_itself", row.code && code != *row.code ? *row.code : ""},
          {"confidence_sort", fmt::format("{:.6g}", row.confidence.value_or(-1.0))},
          {"confidence", row.confidence ? two_decimals(*row.confidence) : kUnknown},
          {"follows", row.follows.value_or("")},
          {"rank_sort", row.rank.value_or(1'000'000'000)},
          {"rank", row.rank ? std::to_string(*row.rank) : kUnknown},
          {"until", row.slot_end_us ? minute_in_zone(*row.slot_end_us, zone) : kUnknown},
          {"health", in_words(row.health)}};
}

}  // namespace

Markup loop_list(const std::vector<LoopRow>& loops, const TimeZone& zone) {
  const auto fields = [&](const LoopRow& row) { return loop_fields(row, zone); };
  const auto shown = std::span(loops).first(std::min(loops.size(), kMostRows));
  return render("loop_list", {{"loops", rows(shown, fields)},
                              {"cut", loops.size() > kMostRows},
                              {"shown", static_cast<std::int64_t>(shown.size())},
                              {"all", static_cast<std::int64_t>(loops.size())}});
}

}  // namespace loopscope::daemon
