#include "storage/results/rows/text_list.hpp"

#include <tuple>

namespace loopscope::storage {

std::vector<std::string> read_text_list(const pqxx::field& field) {
  std::vector<std::string> texts;
  pqxx::array_parser elements = field.as_array();
  for (auto [what, text] = elements.get_next(); what != pqxx::array_parser::done;
       std::tie(what, text) = elements.get_next()) {
    if (what == pqxx::array_parser::string_value) texts.push_back(text);
  }
  return texts;
}

}  // namespace loopscope::storage
