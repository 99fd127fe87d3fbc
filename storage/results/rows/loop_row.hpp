#pragma once

#include <cstdint>
#include <optional>
#include <pqxx/pqxx>
#include <string>
#include <vector>

#include "storage/catalogue_entry.hpp"

/// What read_loop() takes from a row. Times travel as whole microseconds: extract()
/// is exact, because it is numeric since PostgreSQL 14. An infinite time of one
/// loop would stop whoever reads it among others.
#define LOOPSCOPE_LOOP_COLUMNS                                                                 \
  "loop.loop_id, loop.name, loop.source, loop.sp_tag, loop.pv_tag, loop.op_tag, loop.mv_tag,"  \
  " loop.mode_tag, loop.interval_s, loop.period_s, loop.op_low, loop.op_high, loop.loop_type," \
  " loop.importance, loop.enabled, loop.area, loop.unit, loop.description, loop.pv_unit,"      \
  " loop.owner, loop.pv_low, loop.pv_high,"                                                    \
  " (extract(epoch FROM greatest(least(loop.registered_at, '9999-12-31 UTC'), "                \
  "'4713-01-01 BC')) * 1000000)::bigint AS registered_us"

namespace loopscope::storage {

// Whatever reads a value throws pqxx::conversion_error where it is of another type, and
// pqxx::argument_error where the row has no such column.

/// A text; "" for NULL, the catalogue's word for "not recorded".
[[nodiscard]] std::string read_text(const pqxx::field& field);

/// A text; nullopt for NULL.
[[nodiscard]] std::optional<std::string> maybe_text(const pqxx::field& field);

/// A whole number; nullopt for NULL.
[[nodiscard]] std::optional<std::int64_t> read_integer(const pqxx::field& field);

/// A number; nullopt for NULL.
[[nodiscard]] std::optional<double> read_number(const pqxx::field& field);

/// Of the columns pv_flat_s and pv_step; nullopt where the first is NULL.
[[nodiscard]] std::optional<core::signal::PvPast> read_pv_past(const pqxx::row& row);

/// The catalogue entry in a row of the statements that list the loop's columns.
[[nodiscard]] CatalogueEntry read_loop(const pqxx::row& row);

/// The elements of an array of numbers, "{0.1,NULL,...}", in their places; empty for NULL.
[[nodiscard]] std::vector<std::optional<double>> read_number_list(const pqxx::field& field);

/// The elements of a text[]; those that are null are left out; empty for NULL.
[[nodiscard]] std::vector<std::string> read_text_list(const pqxx::field& field);

}  // namespace loopscope::storage
