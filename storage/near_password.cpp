#include "storage/near_password.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

namespace loopscope::storage {
namespace {

/// HOST:PORT:DATABASE:USER of a line; a backslash takes the next character as it is.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (std::size_t k = 0; k < line.size() && fields.size() <= 4; ++k) {
    if (line[k] == ':') {
      fields.emplace_back();
    } else {
      if (line[k] == '\\' && k + 1 < line.size()) ++k;
      fields.back() += line[k];
    }
  }
  return fields;
}

std::optional<NearPassword> compare(const std::string& line, const ConnectionTarget& target) {
  const std::vector<std::string> fields = fields_of(line);
  if (line.starts_with('#') || fields.size() <= 4) return std::nullopt;
  const std::array parts{NearPassword{"host", target.host.empty() ? "localhost" : target.host},
                         NearPassword{"port", target.port}, NearPassword{"dbname", target.database},
                         NearPassword{"user", target.user}};
  NearPassword differs;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (fields[k] == "*" || fields[k] == parts[k].other) continue;
    if (!differs.part.empty() || parts[k].part == "user") return std::nullopt;
    differs = {parts[k].part, fields[k]};
  }
  return differs;
}

}  // namespace

std::optional<NearPassword> find_near_password(const ConnectionTarget& target) {
  std::ifstream lines(target.password_file);
  std::optional<NearPassword> nearest;
  for (std::string line; std::getline(lines, line);) {
    const auto near = compare(line, target);
    if (near && (!nearest || near->part.empty())) nearest = near;
  }
  return nearest;
}

}  // namespace loopscope::storage
