#include "storage/results/plant/plant_figures.hpp"

#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

/// $1 = areas that are told apart, $2 = the name of the others. A row per figure: its name, area,
/// verdict and value. The stays that are noted are the list; the view that decides who belongs
/// there costs several times as much.
const Statement kPlantFigures{"plant_figures", R"(
    WITH catalogue AS MATERIALIZED (
      SELECT loop.loop_id, coalesce(loop.area, '') AS area,
             coalesce(latest.code, 'never_analysed') AS code, latest.control_fraction
      FROM loopscope.loop LEFT JOIN loopscope.own_verdict AS latest USING (loop_id)
      WHERE loop.enabled
    ), sized AS (
      SELECT area, row_number() OVER (ORDER BY count(*) DESC, area) AS place
      FROM catalogue GROUP BY area
    ), placed AS MATERIALIZED (
      SELECT loop_id, CASE WHEN place <= $1::bigint THEN area ELSE $2 END AS area,
             least(place, $1::bigint + 1) AS place, code, control_fraction
      FROM catalogue JOIN sized USING (area)
    ), flagged AS (
      SELECT placed.area, placed.place, coalesce(kind.code, stay.code) AS code
      FROM loopscope.flag_notice AS stay JOIN placed USING (loop_id)
      LEFT JOIN loopscope.verdict_kind AS kind ON kind.code = placed.code AND kind.is_fault
      WHERE stay.ended_at IS NULL
    )
    SELECT figure, area, code, value
    FROM (
      SELECT place, CASE WHEN code IN ('not_controlling', 'never_analysed') THEN code
                         WHEN code = 'insufficient_data' THEN 'not_judged'
                         ELSE 'judged' END AS figure,
             area, '' AS code, count(*)::float8 AS value
      FROM placed GROUP BY 1, 2, 3
      UNION ALL
      SELECT place, 'control_sum', area, '', sum(control_fraction) FROM placed
      WHERE control_fraction IS NOT NULL GROUP BY place, area
      UNION ALL
      SELECT place, 'control_loops', area, '', count(control_fraction) FROM placed
      GROUP BY place, area
      UNION ALL
      SELECT place, 'flagged', area, code, count(*) FROM flagged GROUP BY place, area, code
      UNION ALL
      SELECT 0, 'announced', '', kind.code, coalesce(total.announced, 0)
      FROM loopscope.verdict_kind AS kind
      LEFT JOIN loopscope.flag_total AS total USING (code) WHERE kind.is_fault
    ) AS figures
    ORDER BY place, area, figure, code)"};

std::int64_t* count_of(AreaFigures& area, const std::string& figure) {
  if (figure == "judged") return &area.judged;
  if (figure == "not_controlling") return &area.not_controlling;
  if (figure == "not_judged") return &area.not_judged;
  if (figure == "never_analysed") return &area.never_analysed;
  if (figure == "control_loops") return &area.control_loops;
  return nullptr;
}

void add(const pqxx::row& row, PlantFigures& figures) {
  const std::string figure = row["figure"].c_str(), area = row["area"].c_str();
  const auto value = row["value"].as<double>();
  const auto count = static_cast<std::int64_t>(value);
  if (figure == "announced") {
    figures.announced[row["code"].c_str()] = count;
    return;
  }
  if (figures.areas.empty() || figures.areas.back().area != area)
    figures.areas.push_back({.area = area});
  AreaFigures& last = figures.areas.back();
  if (figure == "flagged") {
    last.flagged[row["code"].c_str()] = count;
  } else if (figure == "control_sum") {
    last.control_sum = value;
  } else if (std::int64_t* const counted = count_of(last, figure)) {
    *counted = count;
  }
}

}  // namespace

PlantFigures plant_figures(Session& session) {
  const pqxx::result rows = session.transact([](Transaction& transaction) {
    return transaction.run(kPlantFigures, {std::to_string(kMostAreas), kOtherAreas});
  });
  PlantFigures figures;
  for (const pqxx::row& row : rows) add(row, figures);
  return figures;
}

}  // namespace loopscope::storage
