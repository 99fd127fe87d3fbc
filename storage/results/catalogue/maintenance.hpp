#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// The kinds of work that maintenance_event knows.
[[nodiscard]] std::span<const std::string> maintenance_kinds();

/// Work on a loop, as somebody enters it.
struct MaintenanceEntry {
  std::string loop_name;
  std::int64_t done_at_us = 0;  ///< when it was finished, microseconds UTC since 1970
  std::string kind;             ///< one of maintenance_kinds()
  std::string description;      ///< what was done; not empty
  /// In whose name, as Annotation::on_behalf_of.
  std::optional<std::string> on_behalf_of = std::nullopt;
};

/// Why an entry is not taken.
enum class MaintenanceRefusal {
  unknown_loop,     ///< no loop of that name
  in_future,        ///< after the database's time
  entered_already,  ///< same loop, time and description
};
struct RefusedMaintenance {
  std::size_t place = 0;  ///< in the list that was handed in
  MaintenanceRefusal reason = MaintenanceRefusal::unknown_loop;
};

/// Work that was entered, and what came of it (view before_after_maintenance).
struct MaintenanceRow {
  std::int64_t maintenance_event_id = 0;
  MaintenanceEntry entry;
  std::optional<std::string> word;  ///< fixed, improved, unchanged, worse; nullopt = cannot be said
  std::string statement;            ///< in words; without a word, why there is none
  std::string author;               ///< login that entered it
};

/// The log of work on loops. Every function is one transaction and throws DatabaseError. Not shared
/// between threads.
class MaintenanceLog {
 public:
  /// Connects and checks that the schema has the version this program was built for.
  explicit MaintenanceLog(const ConnectionSettings& settings);
  ~MaintenanceLog();

  /// Stores all entries, or none and says which are refused (one reason each, in their order).
  [[nodiscard]] std::vector<RefusedMaintenance> add(std::span<const MaintenanceEntry> entries);
  /// In the order of loop and time; nullopt = of every loop. Empty for an unknown one.
  [[nodiscard]] std::vector<MaintenanceRow> list(const std::optional<std::string>& loop_name = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
