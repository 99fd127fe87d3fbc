#include "config/setting_table.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "config/analysis_setting_table.hpp"
#include "config/historian_setting_table.hpp"

namespace loopscope::config {

namespace {

template <auto member>
constexpr auto in_results = target_at<&Settings::results, member>;
template <auto member>
constexpr auto in_schedule = target_at<&Settings::schedule, member>;
template <auto member>
constexpr auto in_daemon = target_at<&Settings::daemon, member>;
template <auto member>
constexpr auto in_acknowledge = target_at<&Settings::daemon, &DaemonSettings::acknowledge, member>;
template <auto member>
constexpr auto in_flags = target_at<&Settings::flags, member>;
template <auto member>
constexpr auto in_plant = target_at<&Settings::plant, member>;
template <auto member>
constexpr auto in_discovery = target_at<&Settings::discovery, member>;
template <auto member>
constexpr auto in_report = target_at<&Settings::report, member>;

constexpr std::string_view kLogLevels[] = {"debug", "info", "warning", "error"};
constexpr std::string_view kDependences[] = {"positive", "arbitrary"};
constexpr std::string_view kLogFormats[] = {"text", "json"};

constexpr std::array kServiceSettings = {
    Setting{"/results/connection", in_results<&ResultsSettings::connection>, any(Form::connection),
            "database of results, catalogue and schedule; login of the worker"},
    Setting{"/results/owner_connection", in_results<&ResultsSettings::owner_connection>,
            any(Form::optional_connection),
            "the same database; login of the schema's owner (`migrate`, `maintain`, `loops`, "
            "`import`); empty = `connection`"},
    Setting{"/results/engineer_connection", in_results<&ResultsSettings::engineer_connection>,
            any(Form::optional_connection),
            "the same database; login of a member of `loopscope_engineer`, under which people "
            "speak (`annotate`, `maintenance`, the pages); empty = `owner_connection`"},
    Setting{"/results/retention_months", in_results<&ResultsSettings::retention_months>,
            range(0, 1200, "months"),
            "age from which `maintain` deletes results; 0 = kept for ever"},

    Setting{"/schedule/poll_s", in_schedule<&ScheduleSettings::poll_s>, range(0.1, 3600, "s"),
            "interval between two polls for due loops"},
    Setting{"/schedule/settle_s", in_schedule<&ScheduleSettings::settle_s>, range(0, 86400, "s"),
            "time that late rows are waited for: newer rows are not analysed yet"},
    Setting{"/schedule/lease_s", in_schedule<&ScheduleSettings::lease_s>, range(10, 86400, "s"),
            "time after which other workers take over the loops of a worker that stopped; at least "
            "3 `poll_s`"},
    Setting{"/schedule/batch_loops", in_schedule<&ScheduleSettings::batch_loops>,
            range(1, 256, "loops"), "number of loops that are claimed, read and written together"},
    Setting{
        "/schedule/default_period_s", in_schedule<&ScheduleSettings::default_period_s>,
        range(1, 2592000, "s"),
        "time between two analyses of a loop that is added without a period; at least `poll_s`"},
    Setting{"/schedule/revise_slots", in_schedule<&ScheduleSettings::revise_slots>,
            range(0, 48, "windows"),
            "number of earlier windows of a loop that are checked for late rows at each analysis"},
    Setting{
        "/schedule/whole_read_every", in_schedule<&ScheduleSettings::whole_read_every>,
        range(1, 1000, "windows"),
        "interval between two times that a loop's window is read whole; else only rows since the "
        "last window are read, and those of `revise_slots` windows before; the others are kept "
        "in memory (`cache_mb`), so that a row that changes further back is noticed after so "
        "many windows at the latest; 1 = always whole"},
    Setting{"/schedule/catch_up_slots", in_schedule<&ScheduleSettings::catch_up_slots>,
            range(0, 1000, "windows"),
            "largest number of missed windows of a loop that `run` makes up for after an outage, "
            "oldest first; older ones are left out"},
    Setting{"/schedule/model_all_up_to", in_schedule<&ScheduleSettings::model_all_up_to>,
            range(0, 1e6, "loops"),
            "number of enabled loops up to which a loop model is fitted to every window"},
    Setting{"/schedule/model_every_slots", in_schedule<&ScheduleSettings::model_every_slots>,
            range(1, 1000, "windows"),
            "with more loops: interval between loop models of a loop that neither its statistics "
            "nor its last verdict would flag; the others get one every time"},

    Setting{"/daemon/workers", in_daemon<&DaemonSettings::workers>, range(0, 256, "cores"),
            "number of cores to analyse on; 0 = all"},
    Setting{
        "/daemon/batches_in_flight", in_daemon<&DaemonSettings::batches_in_flight>,
        range(0, 1024, "batches"),
        "number of workers, each with a batch that it reads, analyses or writes, so that no core "
        "waits for a database; each holds a connection to the results; 0 = two for each "
        "core, eight at most"},
    Setting{"/daemon/cache_mb", in_daemon<&DaemonSettings::cache_mb>, range(0, 1e6, "MB"),
            "memory in which `run` keeps windows, so that it reads new rows only "
            "(`schedule.whole_read_every`); about 50 kB a loop of three tags; 0 = none is kept"},
    Setting{"/daemon/log_level", in_daemon<&DaemonSettings::log_level>, one_of(kLogLevels),
            "least severe messages that are logged"},
    Setting{"/daemon/log_format", in_daemon<&DaemonSettings::log_format>, one_of(kLogFormats),
            "form of a log line, for people or for machines"},
    Setting{"/daemon/http_address", in_daemon<&DaemonSettings::http_address>,
            any(Form::optional_text),
            "address of `/livez`, `/readyz`, `/metrics` and the pages for people: `127.0.0.1:PORT` "
            "or `[::1]:PORT`, no host names; port 0 = any free one; empty = none"},
    Setting{"/daemon/http_names", in_daemon<&DaemonSettings::http_names>, any(Form::texts),
            "host names under which that address may be requested, beside addresses and "
            "`localhost`; other requests are refused (421)"},
    Setting{"/daemon/max_lag_s", in_daemon<&DaemonSettings::max_lag_s>, range(1, 2592000, "s"),
            "delay of the most overdue loop beyond which `/readyz` says no"},
    Setting{"/daemon/acknowledge/trusted_proxies",
            in_acknowledge<&AcknowledgeSettings::trusted_proxies>, any(Form::texts),
            "addresses or networks (`127.0.0.1`, `10.1.0.0/16`) of proxies that sign people in: "
            "who comes by one may acknowledge, suppress and withdraw on the pages; empty = nobody "
            "may, the pages are for reading"},
    Setting{"/daemon/acknowledge/user_header", in_acknowledge<&AcknowledgeSettings::user_header>,
            any(Form::text),
            "header in which such a proxy says who it is; it has to overwrite what a browser sends "
            "under that name"},
    Setting{"/daemon/acknowledge/origin", in_acknowledge<&AcknowledgeSettings::origin>,
            any(Form::optional_text),
            "address under which people see the pages, `https://loopscope.plant.example`: what a "
            "page of another address sends is refused"},

    Setting{"/flags/list_false_share", in_flags<&FlagSettings::list_false_share>, range(0, 0.5),
            "expected share of loops without a fault on the list: the mean of 1 less the "
            "probability of a fault"},
    Setting{"/flags/list_leave_share", in_flags<&FlagSettings::list_leave_share>, range(0, 0.5),
            "the same share for loops that are on the list already: one leaves when it would be "
            "exceeded; not below `list_false_share`"},
    Setting{"/flags/list_least_probability", in_flags<&FlagSettings::list_least_probability>,
            range(0.5, 1),
            "least probability of a fault with which a loop enters the list, however sure the "
            "other loops are"},
    Setting{"/flags/list_leave_probability", in_flags<&FlagSettings::list_leave_probability>,
            range(0, 1),
            "probability of a fault below which a loop leaves the list, however sure the other "
            "loops are; not above `list_least_probability`"},
    Setting{"/flags/false_discovery_rate", in_flags<&FlagSettings::false_discovery_rate>,
            range(0.0001, 1),
            "share of the flags that may be false by the p-values that they rest on; 1 = "
            "probabilities alone decide"},
    Setting{"/flags/false_discovery_dependence",
            in_flags<&FlagSettings::false_discovery_dependence>, one_of(kDependences),
            "dependence between the tests of different loops; `arbitrary` is safe whatever they "
            "share, and costs power"},
    Setting{"/flags/min_confidence", in_flags<&FlagSettings::min_confidence>, range(0, 1),
            "least confidence of a verdict that is flagged"},

    Setting{"/plant/time_zone", in_plant<&PlantSettings::time_zone>, any(Form::text),
            "time zone of the plant, a name of the IANA database such as Europe/Berlin: pages, "
            "pictures, reports and commands show times in it, and a time that is entered without "
            "an offset is meant in it; SQL, exports and logs stay UTC"},
    Setting{"/plant/round_s", in_plant<&PlantSettings::round_s>, range(0, 604800, "s"),
            "interval between two comparisons of all loops with each other (plant-wide "
            "oscillations); 0 = none"},
    Setting{
        "/plant/notice_s", in_plant<&PlantSettings::notice_s>, range(0, 86400, "s"),
        "interval between two checks for newly flagged loops, which NOTIFY announces; longer where "
        "a check takes more than a twentieth of it; 0 = none"},

    Setting{"/discovery/patterns", in_discovery<&DiscoverySettings::patterns>,
            any(Form::optional_text),
            "patterns of the tags of a loop, between semicolons, the first that fits counts, e.g. "
            "`{loop}/*/{role}.CV`; `*` is a part of a name, `[./]` one of these characters; empty "
            "= names are read as vendors and plants usually write them"},
    Setting{"/discovery/sp_words", in_discovery<&DiscoverySettings::sp_words>, any(Form::text),
            "words for the set point, between commas, the preferred one first; words other than "
            "these defaults also replace those of the vendors, likewise in the next four"},
    Setting{"/discovery/pv_words", in_discovery<&DiscoverySettings::pv_words>, any(Form::text),
            "words for the process variable"},
    Setting{"/discovery/op_words", in_discovery<&DiscoverySettings::op_words>, any(Form::text),
            "words for the controller output; one that stands for the valve position too goes to "
            "the first of the two that has no other tag"},
    Setting{"/discovery/mv_words", in_discovery<&DiscoverySettings::mv_words>,
            any(Form::optional_text), "words for the valve position"},
    Setting{"/discovery/mode_words", in_discovery<&DiscoverySettings::mode_words>,
            any(Form::optional_text), "words for the controller mode"},

    Setting{"/report/plant", in_report<&ReportSettings::plant>, any(Form::optional_text),
            "name of the plant in the titles of reports and pages"},
    Setting{"/report/pages_origin", in_report<&ReportSettings::pages_origin>,
            any(Form::optional_text),
            "address under which people see the daemon's pages, `https://loopscope.plant.example`: "
            "loops that have no section in a report lead there; empty = as "
            "`/daemon/acknowledge/origin`, and without that nowhere"},
    Setting{"/report/folder", in_report<&ReportSettings::folder>, any(Form::optional_text),
            "folder in which `run` writes reports, an absolute path; empty = none"},
    Setting{
        "/report/every_s", in_report<&ReportSettings::every_s>, range(60, 31622400, "s"),
        "interval between two reports, counted from midnight UTC of 1970, so that a day is a day"},
    Setting{"/report/pdf", in_report<&ReportSettings::pdf>, any(Form::toggle),
            "whether a PDF is made beside the page; needs WeasyPrint"},
    Setting{"/report/keep", in_report<&ReportSettings::keep>, range(1, 10000, "reports"),
            "number of reports that are kept in the folder; older ones are removed"},

};

/// In the order of the documentation: the historians stand after the results.
std::vector<Setting> whole_table() {
  const auto after_results =
      std::find_if(kServiceSettings.begin(), kServiceSettings.end(),
                   [](const Setting& setting) { return !setting.path.starts_with("/results"); });
  std::vector<Setting> table(kServiceSettings.begin(), after_results);
  const auto historians = historian_setting_table();
  table.insert(table.end(), historians.begin(), historians.end());
  table.insert(table.end(), after_results, kServiceSettings.end());
  const auto analysis = analysis_setting_table();
  table.insert(table.end(), analysis.begin(), analysis.end());
  return table;
}

}  // namespace

std::span<const Setting> setting_table() {
  static const std::vector<Setting> table = whole_table();
  return table;
}

}  // namespace loopscope::config
