#include "storage/results/reports/list_loops.hpp"

#include "storage/results/rows/loop_row.hpp"
#include "storage/statement.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// $1 part, $2 area, $3 unit, $4 verdict, $5 state, $6 order, $7 backwards, $8 most, $9 skip. There
// is a row for the counts where no loop fits.
const Statement kLoopList{"loop_list", R"(
    WITH flagged AS MATERIALIZED (SELECT loop_id, rank, status FROM loopscope.flagged_loop),
    hidden AS MATERIALIZED (
      SELECT loop_id, min(CASE WHEN hidden_by IN ('probability', 'chance') THEN reason
                               WHEN hidden_by = 'victim' THEN 'affected by a shared oscillation'
                               ELSE 'annotated' END) AS by
      FROM loopscope.hidden_loop GROUP BY loop_id),
    listed AS MATERIALIZED (
      SELECT loop.loop_id, loop.name, loop.source, loop.loop_type, loop.area, loop.unit,
             loop.description, loop.owner, loop.enabled, loop.importance, latest.code,
             coalesce(latest.combined_confidence, latest.confidence) AS confidence,
             (extract(epoch FROM latest.slot_end) * 1000000)::bigint AS slot_end_us,
             latest.summary, latest.follows, latest.shown_code,
             coalesce(latest.shown_code, latest.code, 'none') AS verdict,
             flagged.status, flagged.rank, is_hidden.by AS hidden_by,
             CASE WHEN flagged.rank IS NOT NULL THEN 'flagged'
                  WHEN NOT loop.enabled THEN 'disabled'
                  WHEN latest.code IS NULL THEN 'never analysed'
                  WHEN is_hidden.by IS NOT NULL THEN 'off the list'
                  ELSE 'not flagged' END AS state
      FROM loopscope.loop
      LEFT JOIN loopscope.own_verdict AS latest USING (loop_id)
      LEFT JOIN loopscope.verdict_kind AS kind ON kind.code = latest.code
      LEFT JOIN flagged USING (loop_id)
      LEFT JOIN hidden USING (loop_id)
      CROSS JOIN LATERAL (
        SELECT CASE WHEN flagged.rank IS NOT NULL THEN NULL
                    WHEN hidden.by IS NOT NULL THEN hidden.by
                    WHEN NOT kind.is_fault THEN NULL
                    WHEN NOT loop.enabled THEN 'disabled'
                    ELSE 'not sure enough for the list (probability '
                         || round(coalesce(latest.combined_confidence,
                                           latest.confidence)::numeric, 2) || ')' END AS by
      ) AS is_hidden),
    fitting AS MATERIALIZED (
      SELECT *,
             CASE $6 WHEN 'name' THEN lower(name) WHEN 'area' THEN lower(area)
                     WHEN 'unit' THEN lower(unit) WHEN 'verdict' THEN nullif(verdict, 'none')
                     WHEN 'state' THEN state END AS word,
             CASE $6 WHEN 'rank' THEN rank WHEN 'confidence' THEN -confidence
                     WHEN 'window' THEN -slot_end_us END AS number
      FROM listed
      WHERE ($1 = '' OR position(lower($1) IN lower(concat_ws(' ', name, description, owner))) > 0)
        AND ($2 = '' OR area = $2) AND ($3 = '' OR unit = $3)
        AND ($4 = '' OR verdict = $4) AND ($5 = '' OR state = $5)),
    page AS (
      SELECT row_number() OVER (
               ORDER BY CASE WHEN NOT $7::boolean THEN word END NULLS LAST,
                        CASE WHEN $7::boolean THEN word END DESC NULLS LAST,
                        CASE WHEN NOT $7::boolean THEN number END NULLS LAST,
                        CASE WHEN $7::boolean THEN number END DESC NULLS LAST,
                        rank NULLS LAST, name) AS place, fitting.*
      FROM fitting ORDER BY place LIMIT $8::bigint OFFSET $9::bigint)
    SELECT count.*, page.*, health.state AS health
    FROM (SELECT (SELECT count(*) FROM listed) AS every,
                 (SELECT count(*) FROM fitting) AS fitting) AS count
    LEFT JOIN page ON true
    LEFT JOIN loopscope.monitor_health AS health USING (loop_id)
    ORDER BY page.place)"};

const Statement kLoopChoices{"loop_choices", R"(
    SELECT 'area' AS choice, area AS value FROM loopscope.loop WHERE area IS NOT NULL
    UNION SELECT 'unit', unit FROM loopscope.loop WHERE unit IS NOT NULL
    UNION SELECT 'verdict', coalesce(shown_code, code) FROM loopscope.own_verdict
    ORDER BY choice, value)"};

LoopRow read_listed(const pqxx::row& row) {
  LoopRow loop;
  loop.loop_id = row["loop_id"].as<std::int64_t>();
  loop.name = row["name"].c_str();
  loop.source = row["source"].c_str();
  loop.loop_type = maybe_text(row["loop_type"]);
  loop.area = maybe_text(row["area"]);
  loop.unit = maybe_text(row["unit"]);
  loop.description = maybe_text(row["description"]);
  loop.enabled = row["enabled"].as<bool>();
  loop.importance = row["importance"].as<double>();
  loop.state = row["state"].c_str();
  loop.code = maybe_text(row["code"]);
  loop.confidence = read_number(row["confidence"]);
  loop.slot_end_us = read_integer(row["slot_end_us"]);
  loop.summary = maybe_text(row["summary"]);
  loop.status = maybe_text(row["status"]);
  loop.rank = read_integer(row["rank"]);
  loop.hidden_by = maybe_text(row["hidden_by"]);
  loop.health = row["health"].c_str();
  loop.follows = maybe_text(row["follows"]);
  loop.shown_code = maybe_text(row["shown_code"]);
  return loop;
}

void read_choices(const pqxx::result& rows, LoopListing& listing) {
  for (const pqxx::row& row : rows) {
    const std::string choice = row["choice"].c_str();
    auto& values = choice == "area"   ? listing.areas
                   : choice == "unit" ? listing.units
                                      : listing.verdicts;
    values.emplace_back(row["value"].c_str());
  }
  listing.verdicts.emplace_back("none");
  listing.states = loop_states();
}

}  // namespace

const std::vector<std::string>& loop_orders() {
  static const std::vector<std::string> orders{"rank",    "name",       "area",  "unit",
                                               "verdict", "confidence", "state", "window"};
  return orders;
}

const std::vector<std::string>& loop_states() {
  static const std::vector<std::string> states{"flagged", "off the list", "not flagged",
                                               "never analysed", "disabled"};
  return states;
}

LoopListing list_loops(Snapshot& snapshot, const LoopQuery& query) {
  LoopListing listing;
  read_choices(snapshot.run(kLoopChoices), listing);
  const pqxx::result rows = snapshot.run(
      kLoopList,
      {make_storable(query.part), make_storable(query.area), make_storable(query.unit),
       make_storable(query.verdict), make_storable(query.state),
       loop_orders().at(static_cast<std::size_t>(query.order)), query.backwards ? "true" : "false",
       std::to_string(query.most), std::to_string(query.skip)});
  for (const pqxx::row& row : rows) {
    listing.all = row["every"].as<std::int64_t>();
    listing.fitting = row["fitting"].as<std::int64_t>();
    if (!row["loop_id"].is_null()) listing.loops.push_back(read_listed(row));
  }
  return listing;
}

}  // namespace loopscope::storage
