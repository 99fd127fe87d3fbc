#include "tests/daemon/monitor/exposition.hpp"

#include <regex>
#include <sstream>
#include <stdexcept>

namespace loopscope::daemon {
namespace {

const std::regex kHelp(R"(# HELP ([a-z_]+) .+)");
const std::regex kType(R"(# TYPE ([a-z_]+) (counter|gauge|histogram))");
// Name, labels whose values escape quotes, backslashes and line breaks, value.
const std::regex kSample(
    R"re(([a-z_]+(?:\{[a-z_]+="(?:[^"\\]|\\["\\n])*"(?:,[a-z_]+="(?:[^"\\]|\\["\\n])*")*\})?) (\S+))re");

}  // namespace

Exposition read_exposition(const std::string& text) {
  Exposition exposition;
  std::istringstream lines(text);
  std::smatch parts;
  for (std::string line; std::getline(lines, line);) {
    bool fresh = false;
    if (std::regex_match(line, parts, kHelp)) {
      fresh = exposition.helped.insert(parts[1]).second;
    } else if (std::regex_match(line, parts, kType)) {
      fresh = exposition.types.emplace(parts[1], parts[2]).second;
    } else if (std::regex_match(line, parts, kSample)) {
      fresh = exposition.samples.emplace(parts[1], std::stod(parts[2])).second;
    }
    if (!fresh) throw std::runtime_error("not a line of its own: " + line);
  }
  return exposition;
}

}  // namespace loopscope::daemon
