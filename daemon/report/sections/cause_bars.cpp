#include "daemon/report/sections/cause_bars.hpp"

#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <vector>

#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using core::diagnosis::CauseReport;
using core::diagnosis::VerdictCode;

/// Less probable ones take room and tell nothing.
constexpr double kLeast = 0.05;
constexpr std::size_t kMost = 6;

/// Any nonlinearity of valve and process is no cause beside those that it sums up.
bool is_shown(const CauseReport& cause, VerdictCode verdict) {
  if (cause.code == VerdictCode::nonlinear_unexplained && cause.code != verdict) return false;
  return cause.probability >= kLeast;
}

std::string parts(const char* title, const std::vector<std::string>& texts) {
  if (texts.empty()) return {};
  std::string list = fmt::format("<p>{}</p><ul>", title);
  for (const std::string& text : texts) list += "<li>" + html(text) + "</li>";
  return list + "</ul>";
}

std::string bar(const CauseReport& cause) {
  const std::string code(core::diagnosis::name(cause.code));
  const long percent = std::lround(100.0 * cause.probability);
  return fmt::format(
      "<details class=\"cause\"><summary><span class=\"label\">{}</span>"
      "<svg class=\"bar\" viewBox=\"0 0 100 8\" preserveAspectRatio=\"none\" aria-hidden=\"true\">"
      "<rect class=\"{}\" width=\"{}\" height=\"8\"/></svg>"
      "<span class=\"share\">{} %</span></summary>{}{}</details>\n",
      html(in_words(code)), html(code), percent, percent, parts("For", cause.in_favour),
      parts("Against", cause.against));
}

}  // namespace

std::string cause_bars(const core::diagnosis::Verdict& verdict) {
  std::string text;
  std::size_t shown = 0;
  for (const CauseReport& cause : verdict.causes) {
    if (!is_shown(cause, verdict.code) || shown++ >= kMost) continue;
    text += bar(cause);
  }
  if (text.empty()) return text;
  return "<dt>Probable findings</dt><dd class=\"causes\">" + text +
         "<p class=\"note\">Of the newest window. Several may be true at once: the shares need not "
         "add up.</p></dd>\n";
}

}  // namespace loopscope::daemon
