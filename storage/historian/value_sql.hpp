#pragma once

#include <string>
#include <utility>
#include <vector>

#include "storage/historian/pq_connection.hpp"

namespace loopscope::storage {

/// SQL for the value of a column as a double, NULL where it is none.
///
/// No value of any row can make the statement fail: a text that is no number means what `states`
/// says, else nothing; a numeric beyond what a double holds is nothing.
///
/// `column` is quoted SQL, `type` a name of pg_type that is a number, a truth or a text. Throws
/// DatabaseError where a text of `states` is no UTF-8.
[[nodiscard]] std::string value_sql(const PqConnection& connection, const std::string& column,
                                    const std::string& type,
                                    const std::vector<std::pair<std::string, double>>& states);

}  // namespace loopscope::storage
