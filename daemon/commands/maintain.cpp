#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "config/read_settings.hpp"
#include "daemon/backfill/backfill_plan.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/service/shared/compare_clocks.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"
#include "storage/results/schema/accept_clocks.hpp"
#include "storage/results/schema/migrate.hpp"

namespace loopscope::daemon {
namespace {

struct MaintainOptions {
  std::string config;
  bool accept_clock = false;
  std::string since;
};

/// By the owner's connection: a worker's may not be there.
KnownClocks::State look(const config::Settings& settings, SharedServices& tools) {
  return look_at_clocks(settings, tools, [&] {
    const storage::ResultsTime time = storage::results_time(owner_connection(settings));
    tools.clocks.accept(time.accepted);
    return time.clock;
  });
}

/// Whoever says so has looked: what differs now is known, and no reason to stand still.
void accept_clocks(const config::Settings& settings, SharedServices& tools) {
  ask_historians(settings, tools);
  const KnownClocks::State state = look(settings, tools);
  std::vector<ClockReading> clocks = state.historians;
  clocks.push_back(state.host);
  storage::AcceptedClocks accepted;
  for (const ClockReading& reading : clocks) {
    if (clocks_agree(reading.ahead_s, 0.0)) continue;
    accepted[reading.clock] = reading.ahead_s;
    std::cout << fmt::format("accepted {}: {}\n", reading.clock, difference_text(reading.ahead_s));
  }
  storage::accept_clocks(owner_connection(settings), accepted);
  if (accepted.empty()) std::cout << "no clock differs from that of the results server\n";
  tools.clocks.accept(accepted);
}

/// nullopt = no month of the past is asked for.
std::optional<std::int64_t> past_since(const config::Settings& settings,
                                       const MaintainOptions& options) {
  if (options.since.empty()) return std::nullopt;
  const std::int64_t since_us =
      time_option("--since", options.since, TimeZone(settings.plant.time_zone));
  static_cast<void>(months_to_keep(owner_connection(settings), settings, since_us));
  return since_us;
}

void maintain(const MaintainOptions& options) {
  const config::Settings settings = config::read_settings(options.config);
  SharedServices tools(1, RetryLimit::one_lease);
  if (options.accept_clock) accept_clocks(settings, tools);
  if (const auto why = refusal(look(settings, tools))) throw *why;
  const auto result = storage::maintain(owner_connection(settings),
                                        {settings.results.retention_months, tools.clocks.check(),
                                         options.accept_clock, past_since(settings, options)});
  for (const std::string& name : result.created) std::cout << "created " << name << '\n';
  for (const std::string& name : result.dropped) std::cout << "dropped " << name << '\n';
  if (!result.created.empty() || !result.dropped.empty()) return;
  std::cout << fmt::format("partitions from {} to {} are there already; nothing to drop\n",
                           result.first_month, result.last_month);
}

}  // namespace

void add_maintain(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "maintain", "Makes partitions ahead and drops old ones (owner role, by timer)");
  const auto options = std::make_shared<MaintainOptions>();
  command.add_option("--config", options->config, "Settings file")->required();
  command.add_flag("--accept-clock", options->accept_clock,
                   "The results server's clock is right, whatever others say; noted in the schema");
  command.add_option(
      "--since", options->since,
      "Makes the partitions of past months as well, from this time on, for backfill");
  command.callback([options] { maintain(*options); });
}

}  // namespace loopscope::daemon
