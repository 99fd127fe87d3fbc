#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <stop_token>
#include <string>

#include "config/read_settings.hpp"
#include "core/signal/microseconds.hpp"
#include "core/text/counted.hpp"
#include "daemon/backfill/backfill_plan.hpp"
#include "daemon/backfill/past_slots.hpp"
#include "daemon/commands/commands.hpp"
#include "daemon/plant/judge_repairs.hpp"
#include "daemon/service/observe/log.hpp"
#include "daemon/service/shared/compare_clocks.hpp"
#include "daemon/service/threads/core_gate.hpp"
#include "daemon/service/threads/worker_identity.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using core::text::counted;

struct BackfillCommand {
  std::string config;
  BackfillOptions backfill;
};

/// Behind the daemon and what it leaves to people. The servers' work has no such order: one
/// connection to the historian a core.
constexpr int kNice = 19;

std::int64_t newest_settled_us(const std::shared_ptr<const config::Settings>& settings,
                               SharedServices& tools) {
  ResultsLink results(settings, tools.faults, tools.metrics, tools.clocks, tools.stop,
                      tools.watermarks);
  if (const auto refusal = compare_clocks(*settings, tools, results)) throw *refusal;
  const std::int64_t now_us =
      results.with([](storage::ResultsDatabase& database) { return database.clock().now_us; });
  return now_us - core::signal::microseconds(settings->schedule.settle_s);
}

std::vector<std::int64_t> ids_of(const std::vector<storage::CatalogueEntry>& loops) {
  std::vector<std::int64_t> ids;
  for (const storage::CatalogueEntry& loop : loops) ids.push_back(loop.loop_id);
  return ids;
}

/// A window without a sample: which of the three, the historian alone knows.
std::string judged_words(const PassResult& pass, const PastSlots& slots) {
  return fmt::format(
      "{} judged, {} had been judged before, {} without a sample of pv{}", pass.count.inserted,
      slots.stored(), slots.unrecorded(),
      slots.unrecorded() > 0 ? " (before the tag's first row, in a gap or after its last)" : "");
}

std::string again_words(const PassResult& pass, const PastSlots& slots) {
  return fmt::format(
      "{} judged for the first time, {} again, since rows, catalogue or settings have changed, {} "
      "as "
      "they were or without a sample of pv",
      pass.count.inserted, pass.count.revised, slots.unrecorded());
}

std::string summary(const PassResult& pass, const PastSlots& slots, bool again) {
  std::string text =
      fmt::format("{} of {}: {}", slots.settled(), counted(slots.total(), "window", "windows"),
                  again ? again_words(pass, slots) : judged_words(pass, slots));
  if (pass.signal != 0)
    text += again ? "; stopped by a signal, the same command looks at all of them again"
                  : "; stopped by a signal, the same command goes on with the others";
  return text;
}

void require_all(const PassResult& pass, const std::vector<std::string>& given_up) {
  if (given_up.empty()) return;
  const std::string left = counted(given_up.size(), "loop was left", "loops were left") +
                           ", the first \"" + given_up.front() + "\"";
  const std::string again = "the same command goes on with what is left";
  if (!pass.first_failure) {
    throw Failure(ExitCode::database, left + ": disabled meanwhile, or nobody could claim it",
                  "loopscope.monitor_health says what becomes of it; " + again);
  }
  throw Failure(pass.first_failure->exit_code(),
                fmt::format("{}; the first failure: {}", left, pass.first_failure->what()),
                pass.first_failure->hint() + "; " + again);
}

void backfill(const BackfillCommand& options) {
  const auto settings =
      std::make_shared<const config::Settings>(config::read_settings(options.config));
  set_up_log(settings->daemon);
  const std::stop_source stop;
  const std::size_t cores = core_count(settings->daemon);
  SharedServices tools(cores, RetryLimit::endless, stop.get_token());
  BackfillPlan plan =
      plan_backfill(*settings, options.backfill, newest_settled_us(settings, tools));
  PastSlots slots(settings, tools, plan.loops, plan.times_us, options.backfill.again);
  const TimeZone zone(settings->plant.time_zone);
  std::cout << fmt::format("{}, {} each, from {} to {}\n",
                           counted(plan.loops.size(), "loop", "loops"),
                           counted(plan.times_us.size(), "window", "windows"),
                           format_time(plan.times_us.front(), zone),
                           format_time(plan.times_us.back(), zone))
            << std::flush;
  yield_to_analysis(kNice);  // inherited by the workers
  const PassResult pass =
      run_workers(settings, tools, stop, {slots, cores, slots.total(), "windows"});
  std::cout << summary(pass, slots, options.backfill.again) << std::endl;
  if (pass.count.inserted + pass.count.revised > 0)
    judge_repairs_anew(*settings, tools, ids_of(plan.loops));
  if (pass.signal != 0) {
    // Whoever waits for this program learns from its end that not all is done.
    std::signal(pass.signal, SIG_DFL);
    std::raise(pass.signal);
  }
  require_all(pass, slots.given_up());
}

}  // namespace

void add_backfill(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "backfill", "Judges windows of the past, from what the historian holds of them");
  const auto options = std::make_shared<BackfillCommand>();
  command.add_option("--config", options->config, "Settings file")->required();
  command.add_option("--since", options->backfill.since, "First window's end, e.g. 2026-01-01")
      ->required();
  command
      .add_option("--every", options->backfill.every, "From one window's end to the next, e.g. 1d")
      ->required();
  command.add_option("--loop", options->backfill.loops,
                     "Loop; may be given several times (default: all enabled loops)");
  command.add_flag("--again", options->backfill.again,
                   "Also windows that were judged before: where rows, catalogue or settings have "
                   "changed since, they are judged again");
  command.callback([options] { backfill(*options); });
}

}  // namespace loopscope::daemon
