#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// A view that can be exported.
struct ExportedView {
  const char* name;
  const char* time_column;  ///< what `since` is about; empty = the view has no time
  bool has_loop;            ///< whether it has the column loop_name
  const char* shows;        ///< one row per what, in a few words
};

/// The closed list, by name.
[[nodiscard]] std::span<const ExportedView> exported_views();

/// Which rows of a view.
struct ExportRequest {
  const ExportedView* view = nullptr;    ///< one of exported_views()
  std::string loop_name;                 ///< empty = of every loop; else the view has_loop
  std::optional<std::int64_t> since_us;  ///< nullopt = of all times; else the view has a time
};

/// One value of a row; null, or its text. Times are ISO 8601 in UTC, truths "true" and "false",
/// lists their elements joined by "; ", everything else as PostgreSQL writes it.
using ExportedValue = std::optional<std::string>;

/// Takes the rows one after the other; the vector is used again afterwards.
using ExportedRow = std::function<void(const std::vector<ExportedValue>&)>;
/// The names of the columns, once and before any row, also where there is none.
using ExportedHeader = std::function<void(const std::vector<std::string>&)>;
/// Takes the rows one after the other, each as a JSON object.
using ExportedObject = std::function<void(const std::string&)>;

/// Reads a view in pieces, so that its size does not matter, in one read-only snapshot. Whatever
/// the callbacks throw passes through. A callback may take no longer than the connection's
/// idle_timeout_s a batch of 1000 rows. Both throw DatabaseError.
void export_rows(const ConnectionSettings& settings, const ExportRequest& request,
                 const ExportedHeader& header, const ExportedRow& row);
void export_objects(const ConnectionSettings& settings, const ExportRequest& request,
                    const ExportedObject& object);

}  // namespace loopscope::storage
