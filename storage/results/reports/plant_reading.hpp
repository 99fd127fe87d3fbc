#pragma once

#include <pqxx/pqxx>
#include <vector>

#include "storage/results/reports/report_rows.hpp"

namespace loopscope::storage {

// A value of another type than the statement's throws pqxx::conversion_error.

/// Member by member (kPlantMembers) into events.
[[nodiscard]] std::vector<PlantOscillationRow> read_plant_oscillations(const pqxx::result& rows);
/// Rows of kPlantLeads and kPlantTraces to the events that they are of.
void add_leads(std::vector<PlantOscillationRow>& events, const pqxx::result& rows);
void add_traces(std::vector<PlantOscillationRow>& events, const pqxx::result& rows);
/// A row of kFollowed.
[[nodiscard]] FollowedRow read_followed(const pqxx::row& row);

}  // namespace loopscope::storage
