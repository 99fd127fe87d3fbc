#pragma once

#include <pqxx/pqxx>
#include <string>
#include <vector>

namespace loopscope::storage {

/// The elements of a text[]; those that are null are left out.
[[nodiscard]] std::vector<std::string> read_text_list(const pqxx::field& field);

}  // namespace loopscope::storage
