#include "daemon/output/standard_output.hpp"

#include <algorithm>
#include <iostream>
#include <unistd.h>

#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"

namespace loopscope::daemon {

std::string lines_for_terminal(std::string_view text) {
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines += printable(text.substr(begin, end - begin));
    if (end < text.size()) lines += '\n';
    begin = end + 1;
  }
  return lines;
}

void write_to_standard_output(std::string_view text) {
  static const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  if (terminal ? !(std::cout << lines_for_terminal(text)) : !(std::cout << text)) {
    throw Failure(ExitCode::usage, "standard output could not be written",
                  "check the disk or the program behind the pipe");
  }
}

}  // namespace loopscope::daemon
