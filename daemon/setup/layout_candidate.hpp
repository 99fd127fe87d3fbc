#pragma once

#include <string>
#include <vector>

#include "config/settings.hpp"
#include "storage/historian/setup/historian_survey.hpp"
#include "storage/historian/setup/read_grants.hpp"

namespace loopscope::daemon {

/// One way to read a historian's tables, as far as its catalogue tells.
struct LayoutCandidate {
  config::HistorianSettings historian;  ///< without name and connection
  storage::SeenTable data;
  std::vector<storage::TableName> tables;  ///< that a reader needs
  std::string maker;                       ///< of tables that are still to come; empty = none will
  bool readable = true;                    ///< the login may read all of them
  std::string seen;                        ///< which column is what, in words
  /// What the catalogue cannot tell, and the option that says it; empty = nothing.
  std::string open;
};

/// What somebody has said of the layout already; empty = nothing.
struct LayoutWishes {
  std::string preset;
  std::string table;  ///< [schema.]table
  std::string tag_column, time_column, value_column, quality_column;
};

}  // namespace loopscope::daemon
