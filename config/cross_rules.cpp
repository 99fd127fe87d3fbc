#include "config/cross_rules.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include "config/acknowledge_rules.hpp"
#include "config/historian_rules.hpp"
#include "config/host_name.hpp"
#include "config/http_address.hpp"
#include "config/number_text.hpp"
#include "config/time_zones.hpp"
#include "config/web_origin.hpp"
#include "core/text/counted.hpp"

namespace loopscope::config {

namespace {

std::string samples(std::size_t count) {
  return core::text::counted(count, "sample", "samples");
}

std::string seconds(double value) {
  return number_text(value) + " s";
}

void check_historian_names(const Settings& settings, ProblemList& problems) {
  const auto path = [](std::size_t i) { return "/historians/" + std::to_string(i) + "/name"; };
  for (std::size_t i = 0; i < settings.historians.size(); ++i) {
    for (std::size_t first = 0; first < i; ++first) {
      if (settings.historians[first].name != settings.historians[i].name) continue;
      problems.add_unless_refused({path(i), path(first)}, "is the name of " + path(first) + " too",
                                  "loops refer to a historian by its name: give each its own");
      break;
    }
  }
}

void check_historians(const Settings& settings, ProblemList& problems) {
  if (settings.historians.empty())
    problems.add_unless_refused({"/historians"}, "is missing or empty, at least one is needed",
                                R"("historians": [{"connection": "service=plant"}])");
  check_historian_names(settings, problems);
  for (std::size_t i = 0; i < settings.historians.size(); ++i)
    check_historian(settings.historians[i], "/historians/" + std::to_string(i), problems);
}

void check_schedule(const ScheduleSettings& schedule, ProblemList& problems) {
  // A worker that is late by one look, or misses one, must not lose its loops to another.
  if (schedule.lease_s < 3.0 * schedule.poll_s)
    problems.add_unless_refused(
        {"/schedule/lease_s", "/schedule/poll_s"},
        seconds(schedule.lease_s) + " is less than 3 poll_s, " + seconds(3.0 * schedule.poll_s),
        "hold loops longer or poll more often");
  if (schedule.default_period_s < schedule.poll_s)
    problems.add_unless_refused(
        {"/schedule/default_period_s", "/schedule/poll_s"},
        seconds(schedule.default_period_s) + " is less than poll_s, " + seconds(schedule.poll_s),
        "no loop is analysed more often than the daemon polls");
}

void check_http_address(const std::string& address, ProblemList& problems) {
  if (address.empty() || parse_http_address(address)) return;
  problems.add_unless_refused(
      {"/daemon/http_address"}, "is not an address with a port",
      R"(write "127.0.0.1:9470" or "[::1]:9470", an address and no name; "" = no HTTP)");
}

void check_http_names(const std::vector<std::string>& names, ProblemList& problems) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (is_host_name(names[i])) continue;
    problems.add_unless_refused(
        {"/daemon/http_names/" + std::to_string(i)}, "is not a host name",
        R"(write "loopscope.plant.example", without scheme, port and "*"; addresses need no entry)");
  }
}

void check_time_zone(const std::string& zone, ProblemList& problems) {
  if (is_time_zone(zone)) return;
  problems.add_unless_refused({"/plant/time_zone"}, "is not the name of a time zone",
                              time_zone_hint(zone));
}

void check_report(const ReportSettings& report, ProblemList& problems) {
  if (!report.pages_origin.empty() && !is_web_origin(report.pages_origin))
    problems.add_unless_refused({"/report/pages_origin"}, "is no address as browsers show it",
                                R"(write "https://loopscope.plant.example", in small letters, )"
                                R"(without path and slash at the end; "" = none)");
  if (report.folder.empty() || report.folder.starts_with('/')) return;
  problems.add_unless_refused(
      {"/report/folder"}, "is not an absolute path",
      R"(write it from the root on, "/var/lib/loopscope/reports"; "" = none)");
}

void check_list(const FlagSettings& flags, ProblemList& problems) {
  if (flags.list_leave_share < flags.list_false_share)
    problems.add_unless_refused({"/flags/list_leave_share", "/flags/list_false_share"},
                                number_text(flags.list_leave_share) +
                                    " is less than list_false_share, " +
                                    number_text(flags.list_false_share),
                                "loops would enter the list and leave it at once");
  if (flags.list_leave_probability > flags.list_least_probability)
    problems.add_unless_refused({"/flags/list_leave_probability", "/flags/list_least_probability"},
                                number_text(flags.list_leave_probability) +
                                    " is more than list_least_probability, " +
                                    number_text(flags.list_least_probability),
                                "loops would enter the list and leave it at once");
}

void check_window(const core::signal::PrepareSettings& prepare, ProblemList& problems) {
  if (prepare.min_usable_samples > prepare.window_samples)
    problems.add_unless_refused({"/analysis/min_usable_samples", "/analysis/window_samples"},
                                samples(prepare.min_usable_samples) +
                                    " are more than window_samples, " +
                                    samples(prepare.window_samples),
                                "no window could be judged");
}

void check_overlap(const core::hos::Settings& hos, ProblemList& problems) {
  // The greatest overlap leaves a hop of more than one sample, so a whole number is all it takes.
  const double repeated = hos.overlap * static_cast<double>(hos.segment_length);
  const double whole = std::round(repeated);
  constexpr double kRounding = 1e-6;  // samples; forgives 0.333333333 of 4096, not a real fraction
  if (std::abs(repeated - whole) > kRounding)
    problems.add_unless_refused({"/analysis/hos/overlap", "/analysis/hos/segment_length"},
                                number_text(hos.overlap) + " of a segment is " +
                                    number_text(repeated) + " samples, not a whole number",
                                number_text(whole / static_cast<double>(hos.segment_length)) +
                                    " is " + samples(static_cast<std::size_t>(whole)));
}

void check_segments(const core::AnalysisSettings& analysis, ProblemList& problems) {
  const core::hos::Settings& hos = analysis.hos;
  if (hos.dft_length < hos.segment_length)
    problems.add_unless_refused(
        {"/analysis/hos/dft_length", "/analysis/hos/segment_length"},
        samples(hos.dft_length) + " are less than segment_length, " + samples(hos.segment_length),
        "a DFT takes a whole segment");
  const auto length = static_cast<double>(hos.segment_length);
  const auto two_segments = static_cast<std::size_t>(std::ceil(length * (2.0 - hos.overlap)));
  if (analysis.prepare.min_usable_samples < two_segments)
    problems.add_unless_refused(
        {"/analysis/hos/segment_length", "/analysis/min_usable_samples", "/analysis/hos/overlap"},
        "two segments take " + samples(two_segments) + ", more than min_usable_samples, " +
            samples(analysis.prepare.min_usable_samples),
        "an average needs two segments in the shortest window");
}

void check_oscillation(const core::AnalysisSettings& analysis, ProblemList& problems) {
  const double shortest_period = 2.0 * analysis.oscillation.min_half_period_samples;
  const double needed = analysis.oscillation.min_cycles * shortest_period;
  const std::size_t window = analysis.prepare.window_samples;
  if (needed > static_cast<double>(window))
    problems.add_unless_refused(
        {"/analysis/oscillation/min_cycles", "/analysis/oscillation/min_half_period_samples",
         "/analysis/window_samples"},
        number_text(analysis.oscillation.min_cycles) + " cycles of the shortest period take " +
            number_text(needed) + " samples, more than window_samples, " + samples(window),
        "no oscillation could be found");
}

void check_performance(const core::loop::PerformanceSettings& performance, ProblemList& problems) {
  if (performance.min_delay_samples > performance.max_delay_samples)
    problems.add_unless_refused(
        {"/analysis/performance/min_delay_samples", "/analysis/performance/max_delay_samples"},
        samples(performance.min_delay_samples) + " are more than max_delay_samples, " +
            samples(performance.max_delay_samples),
        {});
}

}  // namespace

void check_cross_rules(const Settings& settings, ProblemList& problems) {
  check_historians(settings, problems);
  check_schedule(settings.schedule, problems);
  check_http_address(settings.daemon.http_address, problems);
  check_http_names(settings.daemon.http_names, problems);
  check_acknowledge(settings, problems);
  check_time_zone(settings.plant.time_zone, problems);
  check_report(settings.report, problems);
  check_list(settings.flags, problems);
  check_window(settings.analysis.prepare, problems);
  check_segments(settings.analysis, problems);
  check_overlap(settings.analysis.hos, problems);
  check_oscillation(settings.analysis, problems);
  check_performance(settings.analysis.performance, problems);
}

}  // namespace loopscope::config
