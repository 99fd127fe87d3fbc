#include "daemon/service/batches/data_problems.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/signal/microseconds.hpp"

namespace loopscope::daemon {
namespace {

using storage::DataProblem;

/// The fewest samples that anything is judged on: so many without a row are a hole in every window
/// to come.
constexpr double kDeadSamples = 512.0;
/// With more of the rows bad, the tag is what has to be mended, not the loop.
constexpr double kMostlyBad = 0.5;

/// Whoever brings a whole period at a time is late by up to two of them, and alive.
constexpr double kDeadPeriods = 2.0;

/// Seconds without a row after which a tag has stopped; nullopt = never.
std::optional<double> dead_after_s(const TagReading& reading, const storage::CatalogueEntry& loop,
                                   double interval_s, std::size_t max_samples) {
  const double periods_s = kDeadPeriods * loop.period_s;
  if (reading.role == "pv") return std::max(periods_s, kDeadSamples * interval_s);
  // A controller output in manual stands still for hours where it is recorded by exception.
  if (reading.role == "op" || reading.role == "mv") {
    return std::max(periods_s, static_cast<double>(max_samples) * interval_s);
  }
  return std::nullopt;
}

bool is_dead(const TagReading& reading, const storage::CatalogueEntry& loop,
             const LoopWindowAtSlot& at_slot, std::size_t max_samples) {
  const double interval_s =
      std::max(loop.interval_s.value_or(0.0), at_slot.window.sample_interval_s);
  const std::optional<double> limit_s = dead_after_s(reading, loop, interval_s, max_samples);
  if (!limit_s) return false;
  const auto age_us = static_cast<double>(reading.asked_us - *reading.newest_row_us);
  return age_us > *limit_s * core::signal::kMicrosecondsPerSecond;
}

double bad_share(const TagReading& reading) {
  return reading.rows == 0
             ? 0.0
             : static_cast<double>(reading.bad_rows) / static_cast<double>(reading.rows);
}

}  // namespace

std::vector<DataProblem> tag_problems(const storage::CatalogueEntry& loop,
                                      const LoopWindowAtSlot& at_slot, std::size_t max_samples) {
  std::vector<DataProblem> problems;
  for (const TagReading& reading : at_slot.tags) {
    const std::string role(reading.role);
    if (!reading.newest_row_us) {
      problems.push_back({"no_rows", role, std::nullopt, std::nullopt});
    } else if (is_dead(reading, loop, at_slot, max_samples)) {
      problems.push_back({"dead_tag", role, reading.newest_row_us, std::nullopt});
    }
    if (const double share = bad_share(reading); share > kMostlyBad) {
      problems.push_back({"bad_quality", role, std::nullopt, share});
    }
    const auto counted = [&](const char* code, std::size_t rows) {
      if (rows > 0) problems.push_back({code, role, std::nullopt, static_cast<double>(rows)});
    };
    counted("unknown_quality", reading.unknown_rows);
    counted("rows_too_dense", reading.surplus_rows);
    counted("future_rows", reading.future_rows);
  }
  return problems;
}

std::vector<DataProblem> flag_problems(const core::Diagnosis& diagnosis) {
  std::vector<DataProblem> problems;
  for (const std::string& flag : diagnosis.evidence.data_quality.flags) {
    problems.push_back({flag, "", std::nullopt, std::nullopt});
  }
  if (!shows_a_loop(diagnosis.verdict.code)) {
    problems.push_back({std::string(name(diagnosis.verdict.code)), "", std::nullopt, std::nullopt});
  }
  return problems;
}

bool shows_a_loop(core::diagnosis::VerdictCode code) {
  using core::diagnosis::VerdictCode;
  return code != VerdictCode::insufficient_data && code != VerdictCode::not_controlling;
}

}  // namespace loopscope::daemon
