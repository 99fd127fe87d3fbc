#include "storage/results/rows/number_list.hpp"

#include <tuple>

namespace loopscope::storage {

std::vector<std::optional<double>> read_number_list(const pqxx::field& field) {
  std::vector<std::optional<double>> values;
  if (field.is_null()) return values;
  pqxx::array_parser elements = field.as_array();
  for (auto [what, text] = elements.get_next(); what != pqxx::array_parser::done;
       std::tie(what, text) = elements.get_next()) {
    if (what == pqxx::array_parser::string_value)
      pqxx::from_string(text, values.emplace_back(0.0).value());
    else if (what == pqxx::array_parser::null_value)
      values.emplace_back(std::nullopt);
  }
  return values;
}

}  // namespace loopscope::storage
