#include "daemon/report/sections/cause_bars.hpp"

#include <cmath>
#include <cstddef>

#include "daemon/report/page/template.hpp"
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

/// Said in the drawing itself: the program that makes a PDF draws it without the page's style.
const char* colour(VerdictCode cause) {
  switch (cause) {
    case VerdictCode::valve_stiction:
    case VerdictCode::valve_deadband:
    case VerdictCode::valve_saturation:
    case VerdictCode::valve_characteristic:
    case VerdictCode::valve_oversized:
      return "#b34700";
    case VerdictCode::tight_tuning:
    case VerdictCode::sluggish_tuning:
      return "#0072b2";
    case VerdictCode::process_nonlinearity:
    case VerdictCode::process_change:
      return "#009e73";
    case VerdictCode::external_disturbance:
      return "#99467a";
    case VerdictCode::sensor_fault:
      return "#e69f00";
    case VerdictCode::healthy:
    case VerdictCode::nonlinear_unexplained:
    case VerdictCode::unexplained:
    case VerdictCode::not_controlling:
    case VerdictCode::insufficient_data:
      break;
  }
  return "#7a8794";
}

Fields bar(const CauseReport& cause) {
  return {{"words", in_words(core::diagnosis::name(cause.code))},
          {"colour", colour(cause.code)},
          {"percent", std::lround(100.0 * cause.probability)},
          {"weights", weights(cause.in_favour, cause.against)}};
}

}  // namespace

Markup cause_bars(const core::diagnosis::Verdict& verdict) {
  List bars;
  for (const CauseReport& cause : verdict.causes)
    if (is_shown(cause, verdict.code) && bars.size() < kMost) bars.push_back(bar(cause));
  return bars.empty() ? Markup() : render("cause_bars", {{"causes", bars}});
}

List weights(const std::vector<std::string>& in_favour, const std::vector<std::string>& against) {
  List parts;
  if (!in_favour.empty()) parts.emplace_back(Fields{{"title", "For"}, {"reasons", in_favour}});
  if (!against.empty()) parts.emplace_back(Fields{{"title", "Against"}, {"reasons", against}});
  return parts;
}

}  // namespace loopscope::daemon
