#include "tests/storage/results/documented_rights.hpp"

#include <fstream>
#include <regex>
#include <stdexcept>
#include <vector>

#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

/// Everything between backticks.
std::vector<std::string> quoted_names(const std::string& text) {
  const std::regex name("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at)
    names.push_back((*at)[1]);
  return names;
}

}  // namespace

DocumentedRights::DocumentedRights(const std::string& role) {
  std::ifstream file(tests::source_dir() / "storage" / "README.md");
  const std::regex row(R"(\| ([a-z, ]+) \| ([A-Z]+) \| (.+) \|)");
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    ++rows;
    if (("," + cells[1].str() + ",").find(role) == std::string::npos) continue;
    read_row(cells[2], cells[3]);
  }
  if (rows < 5) throw std::runtime_error("storage/README.md has no table of rights");
}

void DocumentedRights::read_row(const std::string& privilege, const std::string& objects) {
  const std::vector<std::string> names = quoted_names(objects);
  if (objects.starts_with("schema ")) {
    schema_ = true;
  } else if (objects.starts_with("every table and view")) {
    select_all_ = privilege == "SELECT";
  } else if (objects.starts_with("every sequence")) {
    read_sequences_ = privilege == "SELECT";
  } else if (names.empty()) {
    throw std::runtime_error("storage/README.md, a right on nothing: " + objects);
  } else if (objects.starts_with("sequence ")) {
    sequences_.insert(names.begin(), names.end());
  } else if (objects.starts_with("function ")) {
    functions_.insert(names.begin(), names.end());
  } else if (objects.starts_with("`" + names.front() + "` (") && privilege == "INSERT") {
    tables_.insert("INSERT " + names.front());
    partly_.insert(names.front());
    for (std::size_t k = 1; k < names.size(); ++k) inserted_.insert(names.front() + "." + names[k]);
  } else if (privilege != "UPDATE") {
    for (const std::string& name : names) tables_.insert(privilege + " " + name);
  } else {
    const bool all_but = objects.find(" but for (") != std::string::npos;
    if (all_but) all_but_.insert(names.front());
    for (std::size_t k = 1; k < names.size(); ++k)
      (all_but ? exempt_ : columns_).insert(names.front() + "." + names[k]);
  }
}

bool DocumentedRights::on_table(const std::string& privilege, const std::string& table) const {
  return privilege == "SELECT" ? select_all_ : tables_.contains(privilege + " " + table);
}

bool DocumentedRights::update_of(const std::string& table, const std::string& column) const {
  const std::string place = table + "." + column;
  return columns_.contains(place) || (all_but_.contains(table) && !exempt_.contains(place));
}

bool DocumentedRights::insert_of(const std::string& table, const std::string& column) const {
  if (!partly_.contains(table)) return tables_.contains("INSERT " + table);
  return inserted_.contains(table + "." + column);
}

bool DocumentedRights::on_sequence(const std::string& sequence) const {
  return sequences_.contains(sequence);
}

bool DocumentedRights::on_function(const std::string& function) const {
  return functions_.contains(function);
}

}  // namespace loopscope::storage
