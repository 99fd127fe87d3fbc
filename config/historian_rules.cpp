#include "config/historian_rules.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace loopscope::config {
namespace {

class HistorianCheck {
 public:
  HistorianCheck(const HistorianSettings& historian, std::string path, ProblemList& problems)
      : historian_(historian), path_(std::move(path)), problems_(problems) {}

  void run() {
    check_shape();
    check_time();
    check_quality();
    needs("partition_table", historian_.partition_table,
          {{"partition_name_column", historian_.partition_name_column},
           {"partition_start_column", historian_.partition_start_column},
           {"partition_end_column", historian_.partition_end_column}});
    needs("tag_table", historian_.tag_table,
          {{"tag_name_column", historian_.tag_name_column},
           {"tag_id_column", historian_.tag_id_column}});
    needs("subtag_table", historian_.subtag_table,
          {{"subtag_column", historian_.subtag_column},
           {"subtag_name_column", historian_.subtag_name_column},
           {"subtag_id_column", historian_.subtag_id_column}});
    needs("quality_table", historian_.quality_table,
          {{"quality_name_column", historian_.quality_name_column},
           {"quality_id_column", historian_.quality_id_column}});
    needs("interpolation_column", historian_.interpolation_column,
          {{"tag_table", historian_.tag_table}});
  }

 private:
  using Setting = std::pair<std::string_view, const std::string&>;

  void add(const std::vector<std::string_view>& settings, const std::string& what,
           const std::string& hint) {
    std::vector<std::string> paths;
    for (const std::string_view setting : settings) paths.push_back(path_of(setting));
    problems_.add_unless_refused(paths, what, hint);
  }

  [[nodiscard]] std::string path_of(std::string_view setting) const {
    return path_ + "/" + std::string(setting);
  }

  /// Where `name` is set, the others are needed.
  void needs(std::string_view name, const std::string& value, const std::vector<Setting>& others) {
    if (value.empty()) return;
    for (const auto& [other, text] : others) {
      if (text.empty())
        add({other, name}, "is missing, `" + std::string(name) + "` needs it",
            "name it, or leave " + std::string(name) + " empty");
    }
  }

  void check_shape() {
    const bool wide = historian_.layout == "wide";
    if (!wide && historian_.tag_column.empty())
      add({"tag_column", "layout"}, "is missing, only a wide table has none",
          "the column that says whose values a row holds");
    if (wide && !historian_.tag_column.empty())
      add({"tag_column", "layout"}, "is set, but a wide table has a column for every tag",
          R"(set it to "", or layout to "loop_row")");
    if (historian_.layout == "narrow" && historian_.value_column.empty())
      add({"value_column", "layout"}, "is missing", "the column of the value");
  }

  void check_time() {
    const bool local = historian_.time_kind == "timestamp_local";
    if (local && historian_.time_zone.empty())
      add({"time_zone", "time_kind"}, "is missing: local times say nothing without their zone",
          R"(e.g. "Europe/Berlin"; or set time_kind to "timestamp_utc" if they are UTC)");
    if (!local && !historian_.time_zone.empty())
      add({"time_zone", "time_kind"}, "is set, but only timestamp_local has a zone",
          R"(set time_kind to "timestamp_local", or leave time_zone out)");
    if (!historian_.nanos_column.empty() && historian_.time_kind != "timestamptz")
      add({"nanos_column", "time_kind"}, "is set, but only timestamptz goes with it", {});
  }

  void check_quality() {
    const std::string& rule = historian_.quality_rule;
    if (historian_.quality_column.empty() && rule != "none")
      add({"quality_rule", "quality_column"}, "\"" + rule + "\" needs a quality column",
          R"(name it in quality_column, or set quality_rule to "none")");
    if (rule == "codes" && historian_.good_codes.empty())
      add({"good_codes", "quality_rule"}, "is empty: nothing would be good",
          "list the codes of good values");
  }

  const HistorianSettings& historian_;
  std::string path_;
  ProblemList& problems_;
};

}  // namespace

void check_historian(const HistorianSettings& historian, const std::string& path,
                     ProblemList& problems) {
  HistorianCheck(historian, path, problems).run();
}

}  // namespace loopscope::config
