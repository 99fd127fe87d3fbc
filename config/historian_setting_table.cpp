#include "config/historian_setting_table.hpp"

#include <array>

#include "config/historian_presets.hpp"

namespace loopscope::config {

namespace {

template <auto member>
SettingTarget in_historian(Settings& settings, std::size_t index) {
  return &(settings.historians.at(index).*member);
}

constexpr std::string_view kLayouts[] = {"narrow", "loop_row", "wide"};
constexpr std::string_view kTimeKinds[] = {"timestamptz", "timestamp_utc", "timestamp_local",
                                           "epoch_s",     "epoch_s_float", "epoch_ms",
                                           "epoch_us",    "epoch_ns"};
constexpr std::string_view kQualityRules[] = {"none",   "opcda", "opcda_exact", "opcua",
                                              "opchda", "zero",  "truth",       "codes"};
constexpr std::string_view kNullMeanings[] = {"bad", "absent"};
constexpr std::string_view kInterpolations[] = {"sample", "step", "linear"};

const std::array kHistorianSettings = {
    Setting{"/historians/*/name", in_historian<&HistorianSettings::name>, any(Form::text),
            "name by which loops refer to this source; unique"},
    Setting{"/historians/*/preset", in_historian<&HistorianSettings::preset>,
            one_of(preset_names()),
            "vendor whose tables they are: the defaults of all that follows"},
    Setting{"/historians/*/connection", in_historian<&HistorianSettings::connection>,
            any(Form::connection), "database of the historian; login of the reader"},
    Setting{"/historians/*/writer_connection", in_historian<&HistorianSettings::writer_connection>,
            any(Form::optional_connection),
            "the same database; login of a writer, for `import` only; empty = `connection`"},
    Setting{"/historians/*/layout", in_historian<&HistorianSettings::layout>, one_of(kLayouts),
            "content of a row: one value of one tag, several values of one loop (a column each), "
            "or one value of every tag (a column each)"},
    Setting{"/historians/*/table", in_historian<&HistorianSettings::table>, any(Form::text),
            "[schema.]table or view of the data"},
    Setting{"/historians/*/partition_table", in_historian<&HistorianSettings::partition_table>,
            any(Form::optional_text),
            "[schema.]table that lists the tables of the data by time; empty = `table` is the "
            "only one"},
    Setting{"/historians/*/partition_name_column",
            in_historian<&HistorianSettings::partition_name_column>, any(Form::optional_text),
            "column of `partition_table`: names of tables"},
    Setting{"/historians/*/partition_start_column",
            in_historian<&HistorianSettings::partition_start_column>, any(Form::optional_text),
            "column of `partition_table`: first time, in the unit of `time_kind`"},
    Setting{"/historians/*/partition_end_column",
            in_historian<&HistorianSettings::partition_end_column>, any(Form::optional_text),
            "column of `partition_table`: last time"},
    Setting{"/historians/*/tag_column", in_historian<&HistorianSettings::tag_column>,
            any(Form::optional_text),
            "column of the tag, or of its first part; a wide table has none"},
    Setting{"/historians/*/tag_table", in_historian<&HistorianSettings::tag_table>,
            any(Form::optional_text),
            "[schema.]table of names for what `tag_column` holds; empty = it holds the names"},
    Setting{"/historians/*/tag_name_column", in_historian<&HistorianSettings::tag_name_column>,
            any(Form::optional_text), "column of `tag_table`: names"},
    Setting{"/historians/*/tag_id_column", in_historian<&HistorianSettings::tag_id_column>,
            any(Form::optional_text),
            "column of `tag_table`: ids; several ids of one name are read together"},
    Setting{"/historians/*/tag_order_column", in_historian<&HistorianSettings::tag_order_column>,
            any(Form::optional_text),
            "column of `tag_table` by which the ids of a name are ordered, the last one wins; "
            "empty = by id"},
    Setting{"/historians/*/tag_ignore_case", in_historian<&HistorianSettings::tag_ignore_case>,
            any(Form::toggle), "whether names are compared without regard to case"},
    Setting{"/historians/*/subtag_column", in_historian<&HistorianSettings::subtag_column>,
            any(Form::optional_text),
            "column of the second part of a tag; empty = tags have one part"},
    Setting{"/historians/*/subtag_table", in_historian<&HistorianSettings::subtag_table>,
            any(Form::optional_text),
            "[schema.]table of names for what `subtag_column` holds; empty = it holds the names"},
    Setting{"/historians/*/subtag_name_column",
            in_historian<&HistorianSettings::subtag_name_column>, any(Form::optional_text),
            "column of `subtag_table`: names"},
    Setting{"/historians/*/subtag_id_column", in_historian<&HistorianSettings::subtag_id_column>,
            any(Form::optional_text), "column of `subtag_table`: ids"},
    Setting{"/historians/*/tag_separator", in_historian<&HistorianSettings::tag_separator>,
            any(Form::text),
            "text between the parts of a tag, and before the column of a loop_row tag"},
    Setting{"/historians/*/time_column", in_historian<&HistorianSettings::time_column>,
            any(Form::text), "column of the time"},
    Setting{"/historians/*/time_kind", in_historian<&HistorianSettings::time_kind>,
            one_of(kTimeKinds), "type and unit of the time column; epochs are UTC"},
    Setting{"/historians/*/time_zone", in_historian<&HistorianSettings::time_zone>,
            any(Form::optional_text),
            "zone of `timestamp_local`, e.g. Europe/Berlin; the hour that the end of summer time "
            "repeats is bad"},
    Setting{"/historians/*/nanos_column", in_historian<&HistorianSettings::nanos_column>,
            any(Form::optional_text),
            "column of the nanoseconds after the full second; empty = none"},
    Setting{"/historians/*/value_column", in_historian<&HistorianSettings::value_column>,
            any(Form::optional_text),
            "column of the value of a narrow table: a number, a boolean or a text"},
    Setting{"/historians/*/more_value_columns",
            in_historian<&HistorianSettings::more_value_columns>, any(Form::texts),
            "columns of the value that are tried in turn where `value_column` is NULL"},
    Setting{
        "/historians/*/states", in_historian<&HistorianSettings::states>, any(Form::states),
        "numbers that stand for texts; a text that is neither a number nor one of these is bad"},
    Setting{"/historians/*/null_means", in_historian<&HistorianSettings::null_means>,
            one_of(kNullMeanings),
            "meaning of a NULL value: a bad value, or a row that says nothing of this tag"},
    Setting{"/historians/*/quality_column", in_historian<&HistorianSettings::quality_column>,
            any(Form::optional_text), "column of the quality code; empty = none"},
    Setting{"/historians/*/quality_rule", in_historian<&HistorianSettings::quality_rule>,
            one_of(kQualityRules),
            "how the quality code is read (see below); an unknown code is bad and counted"},
    Setting{"/historians/*/accept_uncertain", in_historian<&HistorianSettings::accept_uncertain>,
            any(Form::toggle), "whether uncertain values count as good ones"},
    Setting{"/historians/*/good_codes", in_historian<&HistorianSettings::good_codes>,
            any(Form::texts), "good codes of the rule `codes`: numbers, words or names"},
    Setting{"/historians/*/uncertain_codes", in_historian<&HistorianSettings::uncertain_codes>,
            any(Form::texts), "uncertain codes of the rule `codes`"},
    Setting{"/historians/*/bad_codes", in_historian<&HistorianSettings::bad_codes>,
            any(Form::texts),
            "bad codes of the rule `codes`; a code in none of the lists is unknown"},
    Setting{"/historians/*/quality_table", in_historian<&HistorianSettings::quality_table>,
            any(Form::optional_text),
            "[schema.]table of names for the codes; empty = the lists hold the codes themselves"},
    Setting{"/historians/*/quality_name_column",
            in_historian<&HistorianSettings::quality_name_column>, any(Form::optional_text),
            "column of `quality_table`: names"},
    Setting{"/historians/*/quality_id_column", in_historian<&HistorianSettings::quality_id_column>,
            any(Form::optional_text), "column of `quality_table`: codes"},
    Setting{"/historians/*/tiebreak_column", in_historian<&HistorianSettings::tiebreak_column>,
            any(Form::optional_text),
            "column whose largest value decides between rows of one time; empty = the largest "
            "sample value decides"},
    Setting{"/historians/*/interpolation", in_historian<&HistorianSettings::interpolation>,
            one_of(kInterpolations),
            "course between two rows: unknown, the first value held, or a straight line (setpoint "
            "and mode are always held)"},
    Setting{"/historians/*/interpolation_column",
            in_historian<&HistorianSettings::interpolation_column>, any(Form::optional_text),
            "column of `tag_table` with the interpolation of each tag; empty = all tags alike"},
    Setting{"/historians/*/step_codes", in_historian<&HistorianSettings::step_codes>,
            any(Form::texts), "values of that column for tags whose value is held"},
    Setting{"/historians/*/linear_codes", in_historian<&HistorianSettings::linear_codes>,
            any(Form::texts),
            "values of that column for tags that are joined by straight lines; otherwise "
            "`interpolation` counts"},
    Setting{"/historians/*/manual_codes", in_historian<&HistorianSettings::manual_codes>,
            any(Form::numbers),
            "values of a mode tag in manual (of texts: their numbers in `states`)"},
    Setting{"/historians/*/automatic_codes", in_historian<&HistorianSettings::automatic_codes>,
            any(Form::numbers), "values of a mode tag in automatic"},
    Setting{"/historians/*/cascade_codes", in_historian<&HistorianSettings::cascade_codes>,
            any(Form::numbers),
            "values of a mode tag in cascade; any other value is an unknown mode"},
    Setting{
        "/historians/*/max_connections", in_historian<&HistorianSettings::max_connections>,
        range(1, 64, "connections"),
        "largest number of connections of this process, over all workers; further batches wait"},
};

}  // namespace

std::span<const Setting> historian_setting_table() {
  return kHistorianSettings;
}

}  // namespace loopscope::config
