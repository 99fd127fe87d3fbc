#include "daemon/setup/next_commands.hpp"

#include <fmt/format.h>

#include "daemon/setup/scripts.hpp"
#include "daemon/text/printable.hpp"

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

std::string index_command(const storage::Finding& index,
                          const storage::ConnectionTarget& historian) {
  const auto line = [](const std::string& command) { return printable(command) + "\n"; };
  return fmt::format(
             "First the index of the historian: without it all works, but slowly. As {}, who owns "
             "the table,\nor on its own host with `{}`:\n",
             printable(index.table_owner),
             printable(psql_on_its_host(historian, historian.database))) +
         line(psql_as(index.table_owner, historian, historian.database) + " <<'SQL'") +
         line(index.index_sql) + "SQL\n";
}

}  // namespace loopscope::daemon
