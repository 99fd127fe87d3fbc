#pragma once

#include <map>
#include <set>
#include <string>

namespace loopscope::daemon {

/// Prometheus' text format, read by a way of its own (and not by the library that wrote it).
struct Exposition {
  std::map<std::string, std::string> types;  ///< of each name
  std::set<std::string> helped;              ///< names with a HELP line
  std::map<std::string, double> samples;     ///< by name{labels}, as written
};

/// Throws std::runtime_error with the line that is none of the format, or comes twice.
[[nodiscard]] Exposition read_exposition(const std::string& text);

}  // namespace loopscope::daemon
