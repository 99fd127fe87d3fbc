#include "daemon/setup/next_commands.hpp"

#include <fmt/format.h>

namespace loopscope::daemon {

std::string next_commands(const std::string& settings_file, const std::string& since) {
  return fmt::format(
      "Review {0}, then:\n"
      "  loopscope migrate --config {0}\n"
      "  loopscope loops --config {0} discover --out loops.csv   (review it)\n"
      "  loopscope loops --config {0} load loops.csv\n"
      "  loopscope once --config {0}\n"
      "The past week, so that the list knows since when:\n"
      "  loopscope maintain --config {0} --since {1}\n"
      "  loopscope backfill --config {0} --since {1} --every 6h\n"
      "What people read, and the service that goes on judging:\n"
      "  loopscope report --config {0} --out report\n"
      "  loopscope run --config {0}\n",
      settings_file, since);
}

}  // namespace loopscope::daemon
