#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/connection_settings.hpp"

namespace loopscope::storage {

struct SeenColumn {
  std::string name;
  std::string type;     ///< as pg_type calls it, of a domain that of the type below
  std::string comment;  ///< empty = none
};

/// A table, view or foreign table of a historian's database, as its catalogue shows it to anybody
/// who may connect.
struct SeenTable {
  std::string schema, name, owner;
  bool readable = false;  ///< the login may read it
  double rows = -1.0;     ///< the planner's estimate; negative = never counted
  std::vector<SeenColumn> columns;
};

/// What stands in a column, and in how many rows.
using CountedTexts = std::vector<std::pair<std::string, std::int64_t>>;

/// A look at a historian whose layout nobody has told yet, over one connection of its reader.
/// Every function throws DatabaseError.
class HistorianSurvey {
 public:
  explicit HistorianSurvey(const ConnectionSettings& settings);
  ~HistorianSurvey();
  HistorianSurvey(HistorianSurvey&&) noexcept;
  HistorianSurvey& operator=(HistorianSurvey&&) noexcept;

  /// Without PostgreSQL's own, parts of other tables (partitions, chunks) and the schema
  /// `loopscope`; columns in their order.
  [[nodiscard]] std::vector<SeenTable> tables();
  /// Of some thousand rows, whichever the server comes by first: the commonest 50 texts of a
  /// column, commonest first; NULL does not count.
  [[nodiscard]] CountedTexts sample(const SeenTable& table, const std::string& column);
  /// How far the newest time of a column `timestamp without time zone` lies behind the server's
  /// UTC, negative = ahead of it. nullopt = no row, or not found within a few seconds.
  [[nodiscard]] std::optional<double> seconds_behind_utc(const SeenTable& table,
                                                         const std::string& column);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
