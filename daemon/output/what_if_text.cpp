#include "daemon/output/what_if_text.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "core/text/counted.hpp"
#include "daemon/output/text_line.hpp"
#include "daemon/text/printable.hpp"

namespace loopscope::daemon {
namespace {

std::int64_t count(const std::vector<storage::WhatIfRow>& rows, const char* change) {
  return std::ranges::count(rows, change, &storage::WhatIfRow::change);
}

std::string line(const storage::WhatIfRow& row) {
  const storage::FlaggedRow& flagged = row.flagged;
  const bool lost = row.change == "lost";
  return fmt::format("{} {:>5} {:<24} {:<22} {:>10.2f} {:>9} {:>7.3f}  {}\n",
                     row.change == "gained" ? '+' : (lost ? '-' : ' '),
                     lost ? std::string("-") : std::to_string(flagged.rank),
                     printable(flagged.loop_name), flagged.code, flagged.believed(),
                     flagged.p ? p_figure_text(flagged.p) : "fact", flagged.score, flagged.status);
}

}  // namespace

std::string what_if_text(const std::vector<storage::WhatIfRow>& rows) {
  const std::int64_t kept = count(rows, "kept"), gained = count(rows, "gained"),
                     lost = count(rows, "lost");
  std::string text =
      fmt::format("{} would be flagged instead of {}: {} more, {} no more\n",
                  core::text::counted(kept + gained, "loop", "loops"), kept + lost, gained, lost);
  if (rows.empty()) return text;
  text += fmt::format("  {:>5} {:<24} {:<22} {:>10} {:>9} {:>7}  {}\n", "rank", "loop", "verdict",
                      "confidence", "p", "score", "status");
  for (const storage::WhatIfRow& row : rows) text += line(row);
  return text;
}

}  // namespace loopscope::daemon
