#pragma once

#include <string>
#include <vector>

#include "storage/historian/setup/read_grants.hpp"

namespace loopscope::storage {

/// What the historian's administrator is asked for.
struct ReaderWanted {
  std::string user;
  bool login_exists = false;
  std::vector<TableName> tables;  ///< empty = nobody knows yet which
  std::string maker;              ///< of new tables, see read_grants(); empty = there are none
};

/// A script for psql, run in the historian's database as a superuser, or as the tables' owner where
/// the login exists: the login, whose password psql asks for, and its grants. Every line ends with
/// a line break.
[[nodiscard]] std::string reader_sql(const ReaderWanted& wanted);

}  // namespace loopscope::storage
