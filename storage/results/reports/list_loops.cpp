#include "storage/results/reports/list_loops.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "storage/results/rows/loop_row.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {
namespace {

// The verdicts are read by themselves. Joined to verdict_kind, PostgreSQL 15 looks at all members
// of the shared oscillations once a loop (it takes the rescan of a hash join as free): the square
// of the plant's size.
const Statement kEveryLoop{"every_loop", R"(
    WITH latest AS MATERIALIZED (
      SELECT loop_id, code, slot_end, follows, shown_code,
             coalesce(combined_confidence, confidence) AS confidence
      FROM loopscope.own_verdict)
    SELECT loop.loop_id, loop.name, loop.area, loop.unit, loop.description, loop.enabled,
           latest.code, kind.is_fault,
           lower(concat_ws(' ', loop.name, loop.description, loop.owner)) AS searched,
           dense_rank() OVER (ORDER BY lower(loop.name)) AS name_place,
           CASE WHEN loop.area IS NOT NULL
                THEN dense_rank() OVER (ORDER BY lower(loop.area)) END AS area_place,
           CASE WHEN loop.unit IS NOT NULL
                THEN dense_rank() OVER (ORDER BY lower(loop.unit)) END AS unit_place,
           latest.confidence, round(latest.confidence::numeric, 2) AS probability,
           (extract(epoch FROM latest.slot_end) * 1000000)::bigint AS slot_end_us,
           latest.follows, latest.shown_code, health.state AS health
    FROM loopscope.loop
    LEFT JOIN latest USING (loop_id)
    LEFT JOIN loopscope.verdict_kind AS kind ON kind.code = latest.code
    LEFT JOIN loopscope.monitor_health AS health USING (loop_id)
    ORDER BY loop.name)"};

std::optional<std::string_view> maybe_view(const pqxx::field& field) {
  return field.is_null() ? std::nullopt : std::optional<std::string_view>(field.c_str());
}

/// Its texts are those of the result.
LoopRow read_listed(const pqxx::row& row) {
  LoopRow loop;
  loop.name = row["name"].c_str();
  loop.area = maybe_view(row["area"]);
  loop.unit = maybe_view(row["unit"]);
  loop.description = maybe_view(row["description"]);
  loop.searched = row["searched"].c_str();
  loop.name_place = read_integer(row["name_place"]);
  loop.area_place = read_integer(row["area_place"]);
  loop.unit_place = read_integer(row["unit_place"]);
  loop.enabled = row["enabled"].as<bool>();
  loop.code = maybe_view(row["code"]);
  loop.confidence = read_number(row["confidence"]);
  loop.slot_end_us = read_integer(row["slot_end_us"]);
  loop.health = row["health"].c_str();
  loop.follows = maybe_view(row["follows"]);
  loop.shown_code = maybe_view(row["shown_code"]);
  return loop;
}

std::string why_hidden(const HiddenRow& said) {
  if (said.hidden_by == "probability" || said.hidden_by == "chance") return said.reason;
  return said.hidden_by == "victim" ? "affected by a shared oscillation" : "annotated";
}

/// Of several the same one whatever their order.
std::map<std::int64_t, std::string> reasons_by_loop(std::span<const HiddenLoopRow> hidden) {
  std::map<std::int64_t, std::string> reasons;
  for (const HiddenLoopRow& row : hidden) {
    const auto [place, added] = reasons.emplace(row.loop_id, why_hidden(row.said));
    if (!added) place->second = std::min(place->second, why_hidden(row.said));
  }
  return reasons;
}

std::string_view state_of(const LoopRow& loop, bool off_the_list) {
  if (loop.rank) return "flagged";
  if (!loop.enabled) return "disabled";
  if (!loop.code) return "never analysed";
  return off_the_list ? "off the list" : "not flagged";
}

/// A fault that the view hidden_loop does not tell of is not probable enough even for that.
std::optional<std::string> why_not_listed(const pqxx::row& row) {
  if (!row["is_fault"].as<bool>(false)) return std::nullopt;
  if (!row["enabled"].as<bool>()) return "disabled";
  return std::string("not sure enough for the list (probability ") + row["probability"].c_str() +
         ")";
}

}  // namespace

ListedLoops list_loops(Snapshot& snapshot, std::span<const FlaggedRow> flagged,
                       std::span<const HiddenLoopRow> hidden) {
  std::map<std::int64_t, const FlaggedRow*> listed;
  for (const FlaggedRow& row : flagged) listed.emplace(row.loop_id, &row);
  const std::map<std::int64_t, std::string> reasons = reasons_by_loop(hidden);
  ListedLoops loops;
  const auto add = [&](const pqxx::row& row) {
    LoopRow loop = read_listed(row);
    const auto loop_id = row["loop_id"].as<std::int64_t>();
    const auto said = reasons.find(loop_id);
    std::optional<std::string> unlisted;
    if (const auto found = listed.find(loop_id); found != listed.end()) {
      loop.rank = found->second->rank;
      loop.status = found->second->status;
    } else if (said != reasons.end()) {
      loop.hidden_by = said->second;
    } else if ((unlisted = why_not_listed(row))) {
      loop.hidden_by = *unlisted;
    }
    loop.state = state_of(loop, loop.hidden_by.has_value());
    loops.push_back(loop);
  };
  snapshot.run_by_pieces(kEveryLoop, {}, [&](const pqxx::result& rows) {
    for (const pqxx::row& row : rows) add(row);
  });
  loops.put_flagged_first();
  return loops;
}

}  // namespace loopscope::storage
