#include "daemon/report/sections/repairs_table.hpp"

#include <fmt/format.h>

#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/report/text/pv_unit.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::RepairRow;

/// The change with its interval; nothing where one side has no such figure.
std::string change_of(const storage::RepairFigure& figure) {
  if (!figure.change) return {};
  return fmt::format("{} {}, {} to {}", figure.is_ratio ? "\u00d7" : "by", digits(figure.change),
                     digits(figure.change_low), digits(figure.change_high));
}

List figure_rows(const RepairRow& repair, const std::string& pv_unit) {
  List pairs;
  for (const storage::RepairFigure& figure : repair.figures) {
    if (!figure.before && !figure.after) continue;
    pairs.emplace_back(Fields{{"between", pairs.empty() ? "" : " "},
                              {"name", in_words(figure.name)},
                              {"before", digits(figure.before)},
                              {"after", digits(figure.after)},
                              {"unit", in_pv_unit(figure.unit, pv_unit)},
                              {"change", change_of(figure)}});
  }
  return pairs;
}

Fields repair_fields(const RepairRow& repair, const TimeZone& zone, const std::string& pv_unit) {
  const std::string unknown = repair.windows_before == 0 ? "not judged" : "too early";
  return {{"name", repair.loop_name},
          {"done_us", repair.done_at_us},
          {"done", minute_in_zone(repair.done_at_us, zone)},
          {"kind", repair.kind},
          {"description", repair.description},
          {"author", author_text(repair.author, repair.on_behalf_of)},
          {"word_class", repair.word.value_or("unknown")},
          {"word", repair.word.value_or(unknown)},
          {"statement", with_times_in_zone(repair.statement, zone)},
          {"figures", figure_rows(repair, pv_unit)}};
}

}  // namespace

Markup repairs_table(const std::vector<RepairRow>& repairs, const TimeZone& zone,
                     const std::string& pv_unit) {
  if (repairs.empty()) return {};
  const auto fields = [&](const RepairRow& repair) { return repair_fields(repair, zone, pv_unit); };
  return render("repairs_table", {{"repairs", rows(repairs, fields)}});
}

}  // namespace loopscope::daemon
