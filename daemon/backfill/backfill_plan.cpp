#include "daemon/backfill/backfill_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/signal/microseconds.hpp"
#include "daemon/catalogue/unknown_loop.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/results/catalogue/catalogue.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

/// A thousand loops an hour for eleven years: beyond it somebody has mistaken a unit.
constexpr std::size_t kMostToBackfill = 100'000'000;
/// No loop has a shorter period.
constexpr double kShortest_s = 1.0;
constexpr double kLongest_s = 366.0 * 86'400.0;

struct Unit {
  std::string_view name;
  double seconds;
};
constexpr std::array kUnits{Unit{"s", 1.0}, Unit{"min", 60.0}, Unit{"h", 3600.0},
                            Unit{"d", 86'400.0}, Unit{"w", 604'800.0}};

std::int64_t since_of(const BackfillOptions& options, std::int64_t newest_us,
                      const TimeZone& zone) {
  const std::int64_t since_us = time_option("--since", options.since, zone);
  if (since_us <= newest_us) return since_us;
  throw Failure(ExitCode::usage,
                fmt::format("--since {} lies after {}, the newest window that is complete",
                            second_in_zone(since_us, zone), second_in_zone(newest_us, zone)),
                "backfill judges the past; once and run judge what is new");
}

void require_partitions(const storage::PastMonths& months, const std::string& since) {
  if (months.missing.empty()) return;
  throw Failure(
      ExitCode::database,
      fmt::format("the results have no partitions for {}", fmt::join(months.missing, ", ")),
      fmt::format("as the owner: loopscope maintain --config F --since {}", since));
}

std::vector<CatalogueEntry> enabled_loops(storage::Catalogue& catalogue) {
  std::vector<CatalogueEntry> loops = catalogue.list();
  std::erase_if(loops, [](const CatalogueEntry& loop) { return !loop.enabled; });
  if (loops.empty()) {
    throw Failure(ExitCode::usage, "the catalogue has no enabled loop",
                  "loopscope loops --config F discover, or load, adds loops");
  }
  return loops;
}

CatalogueEntry wanted_loop(const std::string& name, storage::Catalogue& catalogue) {
  const auto loop = catalogue.find(name);
  if (!loop) throw unknown_loop(name, catalogue);
  if (loop->enabled) return *loop;
  throw Failure(ExitCode::usage, fmt::format("the loop \"{}\" is disabled", name),
                fmt::format("loopscope loops --config F enable {}", name));
}

std::vector<CatalogueEntry> wanted_loops(const config::Settings& settings,
                                         const std::vector<std::string>& names) {
  storage::Catalogue catalogue(results_connection(settings));
  if (names.empty()) return enabled_loops(catalogue);
  std::vector<CatalogueEntry> loops;
  for (const std::string& name : names) {
    const bool twice = std::ranges::count(loops, name, &CatalogueEntry::name) > 0;
    if (!twice) loops.push_back(wanted_loop(name, catalogue));
  }
  return loops;
}

std::vector<std::int64_t> times_between(std::int64_t first_us, std::int64_t last_us,
                                        std::int64_t every_us, std::size_t loops) {
  const auto count = static_cast<std::size_t>((last_us - first_us) / every_us) + 1;
  if (count > kMostToBackfill / loops) {
    throw Failure(
        ExitCode::usage,
        fmt::format("{} loops at {} times each are more windows than can be judged", loops, count),
        "a longer --every, e.g. 1d, or a later --since");
  }
  std::vector<std::int64_t> times_us;
  times_us.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    times_us.push_back(first_us + static_cast<std::int64_t>(k) * every_us);
  return times_us;
}

}  // namespace

std::int64_t parse_duration(std::string_view text) {
  const std::string_view word = trimmed(text);
  const std::size_t end = std::min(word.find_first_not_of("0123456789."), word.size());
  const std::string_view unit = trimmed(word.substr(end));
  const auto known = std::ranges::find(kUnits, unit.empty() ? "s" : unit, &Unit::name);
  const auto number = parse_number(word.substr(0, end));
  const double span_s = number && known != kUnits.end() ? *number * known->seconds : std::nan("");
  if (span_s >= kShortest_s && span_s <= kLongest_s) return core::signal::microseconds(span_s);
  throw Failure(ExitCode::usage,
                fmt::format("\"{}\" is not a time span of a second to a year", text),
                "a number and s, min, h, d or w, e.g. 6h or 1d");
}

BackfillPlan plan_backfill(const config::Settings& settings, const BackfillOptions& options,
                           std::int64_t newest_us) {
  const std::int64_t every_us = parse_duration(options.every);
  const std::int64_t since_us = since_of(options, newest_us, TimeZone(settings.plant.time_zone));
  const storage::PastMonths months =
      months_to_keep(results_connection(settings), settings, since_us);
  BackfillPlan plan{wanted_loops(settings, options.loops), {}};
  plan.times_us = times_between(since_us, newest_us, every_us, plan.loops.size());
  require_partitions(months, options.since);
  return plan;
}

storage::PastMonths months_to_keep(const storage::ConnectionSettings& connection,
                                   const config::Settings& settings, std::int64_t since_us) {
  const int retention_months = settings.results.retention_months;
  storage::PastMonths months = storage::past_months(connection, since_us, retention_months);
  if (months.kept) return months;
  throw Failure(ExitCode::usage,
                fmt::format("{} lies before {}, from which on results are kept "
                            "(/results/retention_months is {})",
                            format_time(since_us, TimeZone(settings.plant.time_zone)),
                            months.kept_from, retention_months),
                "a later --since, or a larger /results/retention_months");
}

}  // namespace loopscope::daemon
