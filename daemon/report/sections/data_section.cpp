#include "daemon/report/sections/data_section.hpp"

#include <fmt/format.h>
#include <optional>

#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/report/text/pv_unit.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

Fields problem_fields(const storage::DataProblemRow& problem, const TimeZone& zone) {
  return {{"words", with_times_in_zone(problem.words, zone)},
          {"role", problem.role},
          {"tag", problem.tag},
          {"since", minute_in_zone(problem.since_us, zone)},
          {"remedy", with_times_in_zone(problem.remedy, zone)}};
}

std::string share(const std::optional<double>& value) {
  return value ? core::text::percent(*value) : kUnknown;
}

std::string flags_text(const core::signal::DataQuality& quality) {
  std::string text;
  for (const std::string& flag : quality.flags) text += (text.empty() ? "" : ", ") + in_words(flag);
  return text.empty() ? "none" : text;
}

std::string size_in_unit(const std::optional<double>& value, const std::string& pv_unit) {
  if (!value) return kUnknown;
  return in_pv_unit(core::text::units_of_pv(*value), pv_unit);
}

std::string window_figures(const LoopEvidence& evidence, const std::string& pv_unit) {
  const core::signal::DataQuality& quality = evidence.diagnosis.evidence.data_quality;
  const core::loop::Performance& work = evidence.diagnosis.evidence.performance;
  return fmt::format(
      "{} at {} s; missing {}, frozen {}, op at a limit {}; archive {}, compression factor "
      "{}, quantisation factor {}; error std {}, Harris {} to {}, valve travel {} %/h, {} "
      "reversals/h; flags: {}.",
      core::text::counted(evidence.prepared.pv.size(), "sample", "samples"),
      digits(evidence.prepared.sample_interval_s), share(quality.missing_fraction),
      share(quality.frozen_fraction), share(quality.saturated_fraction),
      in_words(name(quality.archive)), digits(quality.compression_factor),
      digits(quality.quantisation_factor), size_in_unit(work.error_std, pv_unit),
      digits(work.harris_low), digits(work.harris_high), digits(work.valve_travel_per_h),
      digits(work.reversals_per_h), flags_text(quality));
}

std::vector<std::string> refusals(const LoopEvidence& evidence) {
  return evidence.diagnosis.evidence.data_quality.refusals;
}

}  // namespace

Markup data_section(const LoopReport& loop_report) {
  const std::optional<LoopEvidence>& evidence = loop_report.evidence;
  const auto problem = [&](const auto& row) { return problem_fields(row, loop_report.zone); };
  return render("data_section",
                {{"any_problem", !loop_report.problems.empty()},
                 {"problems", rows(loop_report.problems, problem)},
                 {"refusals", evidence ? refusals(*evidence) : std::vector<std::string>()},
                 {"figures", evidence ? window_figures(*evidence, loop_report.row.pv_unit) : ""}});
}

}  // namespace loopscope::daemon
