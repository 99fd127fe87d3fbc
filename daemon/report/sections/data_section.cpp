#include "daemon/report/sections/data_section.hpp"

#include <fmt/format.h>
#include <optional>

#include "core/model/results/phrases.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

std::string problem_row(const storage::DataProblemRow& problem) {
  return fmt::format(
      "<tr><td data-label=\"Problem\">{}</td><td data-label=\"Tag\">{} <bdi>{}</bdi></td>"
      "<td class=\"when\" data-label=\"Since\">{}</td><td data-label=\"What to do\">{}</td>"
      "</tr>\n",
      html(problem.words), html(problem.role), html(problem.tag), utc(problem.since_us),
      html(problem.remedy));
}

std::string problems_table(const std::vector<storage::DataProblemRow>& problems) {
  if (problems.empty()) return "<p>No problem of the data stands.</p>\n";
  std::string text =
      "<table class=\"problems\"><thead><tr><th>Problem</th><th>Tag</th><th>Since</th><th>What "
      "to do</th></tr></thead><tbody>\n";
  for (const storage::DataProblemRow& problem : problems) text += problem_row(problem);
  return text + "</tbody></table>\n";
}

std::string share(const std::optional<double>& value) {
  return value ? core::model::in_percent(*value) : "\u2013";
}

std::string flags_text(const core::signal::DataQuality& quality) {
  std::string text;
  for (const std::string& flag : quality.flags) text += (text.empty() ? "" : ", ") + in_words(flag);
  return text.empty() ? "none" : text;
}

std::string window_figures(const LoopEvidence& evidence) {
  const core::signal::DataQuality& quality = evidence.diagnosis.evidence.data_quality;
  const core::loop::Performance& work = evidence.diagnosis.evidence.performance;
  return "<p class=\"note\">" +
         html(fmt::format(
             "{} samples at {} s; missing {}, frozen {}, op at a limit {}; archive {}, compression "
             "factor {}, quantisation factor {}; error std {} pv units, Harris {} to {}, valve "
             "travel {} %/h, {} reversals/h; flags: {}.",
             evidence.prepared.pv.size(), digits(evidence.prepared.sample_interval_s),
             share(quality.missing_fraction), share(quality.frozen_fraction),
             share(quality.saturated_fraction), in_words(name(quality.archive)),
             digits(quality.compression_factor), digits(quality.quantisation_factor),
             digits(work.error_std), digits(work.harris_low), digits(work.harris_high),
             digits(work.valve_travel_per_h), digits(work.reversals_per_h), flags_text(quality))) +
         "</p>\n";
}

std::string refusals(const LoopEvidence& evidence) {
  std::string text;
  for (const std::string& refusal : evidence.diagnosis.evidence.data_quality.refusals)
    text += "<p>" + html(refusal) + "</p>\n";
  return text;
}

}  // namespace

std::string data_section(const LoopReport& story) {
  std::string text = "<h3>Data</h3>\n" + problems_table(story.problems);
  if (story.evidence) text += refusals(*story.evidence) + window_figures(*story.evidence);
  return text;
}

}  // namespace loopscope::daemon
