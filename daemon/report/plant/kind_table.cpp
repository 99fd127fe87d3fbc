#include "daemon/report/plant/kind_table.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/diagnosis/verdicts/verdict.hpp"
#include "core/diagnosis/verdicts/verdict_catalogue.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

/// Loops with the same verdict.
struct Kind {
  const storage::FlaggedRow* worst = nullptr;
  std::int64_t loops = 0, new_ones = 0;
};

std::vector<Kind> kinds_of(std::span<const storage::FlaggedRow> flagged, std::int64_t since_us) {
  std::vector<Kind> kinds;
  for (const storage::FlaggedRow& row : flagged) {
    auto kind = std::ranges::find_if(
        kinds, [&](const Kind& known) { return known.worst->code == row.code; });
    if (kind == kinds.end()) kind = kinds.insert(kind, {&row});
    ++kind->loops;
    if (row.began_after(since_us)) ++kind->new_ones;
  }
  return kinds;
}

/// Without the figures of a single loop; of a verdict that this program does not know its worst's.
std::string action_of(const Kind& kind) {
  const auto code = core::diagnosis::verdict_code(kind.worst->code);
  return code ? std::string(core::diagnosis::catalogue_entry(*code).action) : kind.worst->action;
}

Fields kind_fields(const Kind& kind, const LoopLinks& links) {
  const std::string& code = kind.worst->code;
  return {{"code", code},
          {"verdict", as_heading(code)},
          {"link", links.to_loops("?state=flagged&verdict=" + code)},
          {"loops", kind.loops},
          {"new_ones", kind.new_ones == 0 ? "" : std::to_string(kind.new_ones)},
          {"action", action_of(kind)}};
}

}  // namespace

Markup kind_table(std::span<const storage::FlaggedRow> flagged, std::int64_t since_us,
                  const LoopLinks& links) {
  if (flagged.empty()) return {};
  const auto fields = [&](const Kind& kind) { return kind_fields(kind, links); };
  return render("kind_table", {{"kinds", rows(kinds_of(flagged, since_us), fields)}});
}

}  // namespace loopscope::daemon
