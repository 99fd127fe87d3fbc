#include "daemon/report/figures/find_program.hpp"

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <unistd.h>

namespace loopscope::daemon {

std::optional<std::filesystem::path> find_program(std::string_view name,
                                                  std::string_view search_path) {
  for (std::size_t begin = 0; begin <= search_path.size();) {
    const std::size_t end = std::min(search_path.find(':', begin), search_path.size());
    const std::filesystem::path folder = search_path.substr(begin, end - begin);
    const std::filesystem::path program = folder / name;
    std::error_code unseen;  // a folder that may not be entered has no program for us
    if (folder.is_absolute() && std::filesystem::is_regular_file(program, unseen) &&
        ::access(program.c_str(), X_OK) == 0)
      return program;
    begin = end + 1;
  }
  return std::nullopt;
}

}  // namespace loopscope::daemon
