#include "tests/tables/table.hpp"

#include <algorithm>
#include <stdexcept>

namespace loopscope::tables {
namespace {

std::vector<Table>& registered() {
  static std::vector<Table> tables;
  return tables;
}

}  // namespace

std::vector<Table> all_tables() {
  std::vector<Table> tables = registered();
  std::ranges::sort(tables, {}, &Table::name);
  return tables;
}

Registration::Registration(const Table& table) {
  registered().push_back(table);
}

void require(bool holds, const std::string& promise) {
  if (!holds) throw std::runtime_error("the table does not keep what it promises: " + promise);
}

}  // namespace loopscope::tables
