#include "storage/results/cause_values.hpp"

#include <optional>
#include <tuple>

namespace loopscope::storage {

core::diagnosis::PerCause read_cause_values(const pqxx::field& field) {
  core::diagnosis::PerCause values;
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
