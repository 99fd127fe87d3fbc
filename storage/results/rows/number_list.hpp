#pragma once

#include <optional>
#include <pqxx/pqxx>
#include <vector>

namespace loopscope::storage {

/// The elements of an array of numbers, "{0.1,NULL,...}", in their places; empty for NULL.
[[nodiscard]] std::vector<std::optional<double>> read_number_list(const pqxx::field& field);

}  // namespace loopscope::storage
