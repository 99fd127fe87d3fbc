#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <spdlog/spdlog.h>
#include <stop_token>
#include <string>

#include "config/read_settings.hpp"
#include "core/text/counted.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/plant/plant_watch.hpp"
#include "daemon/service/observe/log.hpp"
#include "daemon/service/observe/stage_timings.hpp"
#include "daemon/service/observe/work_report.hpp"
#include "daemon/service/pass.hpp"
#include "daemon/service/threads/worker_identity.hpp"

namespace loopscope::daemon {
namespace {

/// Of the errors that the comparison of all loops begins with: of the ten thousand windows that it
/// takes at most. Those of further loops are read again.
constexpr std::size_t kKeptErrorBytes = std::size_t{80} << 20;

std::string pass_text(const PassResult& pass) {
  std::string text = count_text(pass.count);
  const std::size_t left = pass.enabled - std::min(pass.enabled, pass.loops);
  if (left > 0 && pass.signal == 0) {
    text += fmt::format(
        "; {} more are held by other workers or by leases that have not ended yet, or rest because "
        "a worker was lost with them alone",
        left);
  } else if (left > 0) {
    text += fmt::format("; stopped by a signal, {} more are left for the next pass", left);
  }
  return text;
}

void once(const std::string& config_file) {
  const auto settings =
      std::make_shared<const config::Settings>(config::read_settings(config_file));
  set_up_log(settings->daemon);
  // Of the whole command: what the pass learns of the clocks holds for the round after it.
  const std::stop_source stop;
  SharedServices tools(core_count(settings->daemon), RetryLimit::one_lease, stop.get_token());
  tools.errors.allow(kKeptErrorBytes);
  const PassResult pass = run_pass(settings, tools, stop);
  std::cout << pass_text(pass) << std::endl;
  if (pass.cost.loops > 0) {
    spdlog::info("{:.1f} s, {:.0f} loops/s; {}", pass.elapsed_s,
                 static_cast<double>(pass.cost.loops) / pass.elapsed_s, cost_text(pass.cost));
  }
  if (pass.signal != 0) {
    // Whoever waits for this program learns from its end that the pass is not whole.
    std::signal(pass.signal, SIG_DFL);
    std::raise(pass.signal);
  }
  compare_all_loops(*settings, tools);
  if (!pass.first_failure) return;
  throw Failure(pass.first_failure->exit_code(),
                fmt::format("{} failed and will be tried again later, the first because: {}",
                            core::text::counted(pass.count.failed, "loop", "loops"),
                            pass.first_failure->what()),
                pass.first_failure->hint());
}

}  // namespace

void add_once(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("once", "One full pass over all enabled loops, then exits");
  const auto config = std::make_shared<std::string>();
  command.add_option("--config", *config, "Settings file")->required();
  command.callback([config] { once(*config); });
}

}  // namespace loopscope::daemon
