#include "daemon/report/find_program.hpp"

#include <algorithm>
#include <cstddef>
#include <unistd.h>

namespace loopscope::daemon {

std::optional<std::filesystem::path> find_program(std::string_view name,
                                                  std::string_view search_path) {
  for (std::size_t begin = 0; begin <= search_path.size();) {
    const std::size_t end = std::min(search_path.find(':', begin), search_path.size());
    const std::filesystem::path folder = search_path.substr(begin, end - begin);
    const std::filesystem::path program = folder / name;
    if (folder.is_absolute() && std::filesystem::is_regular_file(program) &&
        ::access(program.c_str(), X_OK) == 0)
      return program;
    begin = end + 1;
  }
  return std::nullopt;
}

}  // namespace loopscope::daemon
