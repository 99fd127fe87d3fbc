#pragma once

#include <cstdint>
#include <optional>
#include <pqxx/pqxx>
#include <string>

#include "storage/catalogue_entry.hpp"

namespace loopscope::storage {

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

}  // namespace loopscope::storage
