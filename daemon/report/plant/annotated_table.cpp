#include "daemon/report/plant/annotated_table.hpp"

#include <fmt/format.h>

#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::HiddenLoopRow;

Fields annotated_fields(const HiddenLoopRow& row, const LoopLinks& links, const TimeZone& zone) {
  const storage::HiddenRow& said = row.said;
  return {{"link", links.to_page(row.loop_name)},
          {"name", row.loop_name},
          {"code", row.code},
          {"verdict", as_heading(row.code)},
          {"deed", deed_words(said.hidden_by)},
          {"author", author_text(said.author, said.on_behalf_of)},
          {"entered_us", said.entered_us},
          {"entered", minute_in_zone(said.entered_us, zone)},
          {"until", until_words(said.hidden_by, said.until_us, zone)},
          {"reason", said.reason}};
}

std::string others_text(const storage::PlantCounts& counts) {
  const auto shown = static_cast<std::int64_t>(counts.newest_annotations.size());
  if (counts.annotations <= shown) return {};
  return fmt::format("{} more, older than these: view hidden_loop. ", counts.annotations - shown);
}

}  // namespace

std::string until_words(const std::string& kind, const std::optional<std::int64_t>& until_us,
                        const TimeZone& zone) {
  if (until_us) return minute_in_zone(*until_us, zone);
  return kind == "acknowledged" ? "work is entered" : "withdrawn";
}

Markup annotated_table(const storage::PlantCounts& counts, const LoopLinks& links,
                       const TimeZone& zone) {
  if (counts.newest_annotations.empty()) return {};
  const auto fields = [&](const HiddenLoopRow& row) { return annotated_fields(row, links, zone); };
  return render("annotated_table", {{"annotated", rows(counts.newest_annotations, fields)},
                                    {"others", others_text(counts)}});
}

}  // namespace loopscope::daemon
