#include "storage/results/reports/list_loops.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <string>

#include "storage/results/rows/loop_row.hpp"
#include "storage/statement.hpp"

namespace loopscope::storage {
namespace {

// The verdicts are read by themselves. Joined to verdict_kind, PostgreSQL 15 looks at all members
// of the shared oscillations once a loop (it takes the rescan of a hash join as free): the square
// of the plant's size.
const Statement kEveryLoop{"every_loop", R"(
    WITH latest AS MATERIALIZED (
      SELECT loop_id, code, slot_end, summary, follows, shown_code,
             coalesce(combined_confidence, confidence) AS confidence
      FROM loopscope.own_verdict)
    SELECT loop.loop_id, loop.name, loop.source, loop.loop_type, loop.area, loop.unit,
           loop.description, loop.enabled, loop.importance, latest.code, kind.is_fault,
           lower(concat_ws(' ', loop.name, loop.description, loop.owner)) AS searched,
           dense_rank() OVER (ORDER BY lower(loop.name)) AS name_place,
           CASE WHEN loop.area IS NOT NULL
                THEN dense_rank() OVER (ORDER BY lower(loop.area)) END AS area_place,
           CASE WHEN loop.unit IS NOT NULL
                THEN dense_rank() OVER (ORDER BY lower(loop.unit)) END AS unit_place,
           latest.confidence, round(latest.confidence::numeric, 2) AS probability,
           (extract(epoch FROM latest.slot_end) * 1000000)::bigint AS slot_end_us,
           latest.summary, latest.follows, latest.shown_code, health.state AS health
    FROM loopscope.loop
    LEFT JOIN latest USING (loop_id)
    LEFT JOIN loopscope.verdict_kind AS kind ON kind.code = latest.code
    LEFT JOIN loopscope.monitor_health AS health USING (loop_id)
    ORDER BY loop.name)"};

LoopRow read_listed(const pqxx::row& row) {
  LoopRow loop;
  loop.loop_id = row["loop_id"].as<std::int64_t>();
  loop.name = row["name"].c_str();
  loop.source = row["source"].c_str();
  loop.loop_type = maybe_text(row["loop_type"]);
  loop.area = maybe_text(row["area"]);
  loop.unit = maybe_text(row["unit"]);
  loop.description = maybe_text(row["description"]);
  loop.searched = row["searched"].c_str();
  loop.name_place = read_integer(row["name_place"]);
  loop.area_place = read_integer(row["area_place"]);
  loop.unit_place = read_integer(row["unit_place"]);
  loop.enabled = row["enabled"].as<bool>();
  loop.importance = row["importance"].as<double>();
  loop.code = maybe_text(row["code"]);
  loop.confidence = read_number(row["confidence"]);
  loop.slot_end_us = read_integer(row["slot_end_us"]);
  loop.summary = maybe_text(row["summary"]);
  loop.health = row["health"].c_str();
  loop.follows = maybe_text(row["follows"]);
  loop.shown_code = maybe_text(row["shown_code"]);
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

std::string state_of(const LoopRow& loop, bool off_the_list) {
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

std::vector<LoopRow> list_loops(Snapshot& snapshot, std::span<const FlaggedRow> flagged,
                                std::span<const HiddenLoopRow> hidden) {
  std::map<std::int64_t, const FlaggedRow*> listed;
  for (const FlaggedRow& row : flagged) listed.emplace(row.loop_id, &row);
  const std::map<std::int64_t, std::string> reasons = reasons_by_loop(hidden);
  const pqxx::result rows = snapshot.run(kEveryLoop);
  std::vector<LoopRow> loops;
  loops.reserve(static_cast<std::size_t>(rows.size()));  // a row takes nearly a kilobyte
  for (const pqxx::row& row : rows) {
    LoopRow& loop = loops.emplace_back(read_listed(row));
    const auto said = reasons.find(loop.loop_id);
    if (const auto found = listed.find(loop.loop_id); found != listed.end()) {
      loop.rank = found->second->rank;
      loop.status = found->second->status;
    } else if (said != reasons.end()) {
      loop.hidden_by = said->second;
    } else {
      loop.hidden_by = why_not_listed(row);
    }
    loop.state = state_of(loop, loop.hidden_by.has_value());
  }
  std::ranges::stable_sort(loops, {}, [](const LoopRow& loop) {
    return loop.rank.value_or(std::numeric_limits<std::int64_t>::max());
  });
  return loops;
}

}  // namespace loopscope::storage
