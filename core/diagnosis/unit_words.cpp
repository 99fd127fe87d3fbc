#include "core/diagnosis/unit_words.hpp"

#include <cmath>

#include "core/text/phrases.hpp"

namespace loopscope::core::diagnosis {
namespace {

constexpr double kDoubtedFrom = 0.5;
constexpr double kShownFrom = 0.99;

/// "-17.8 + 0.556 sp", "0.1 sp".
std::string line_text(const loop::UnitMatch& match) {
  const std::string slope = text::number(match.slope) + " sp";
  const bool from_zero = std::abs(match.offset) < std::abs(match.pv_mean) / 100.0;
  return from_zero ? slope : text::number(match.offset) + " + " + slope;
}

/// "70.3 converted from degF to degC is 21.3".
std::string converted_text(const loop::UnitMatch& match) {
  const double converted = match.conversion.offset + match.conversion.factor * match.sp_mean;
  return text::number(match.sp_mean) + " " + match.conversion.words + " is " +
         text::number(converted);
}

}  // namespace

UnitFinding unit_finding(const Evidence& evidence) {
  if (!evidence.units || evidence.units->probability <= kDoubtedFrom) return UnitFinding::none;
  const bool shown = evidence.units->follows && evidence.units->probability >= kShownFrom;
  return shown ? UnitFinding::shown : UnitFinding::doubted;
}

std::string unit_reason(const Evidence& evidence) {
  const UnitFinding finding = unit_finding(evidence);
  if (finding == UnitFinding::none) return {};
  const loop::UnitMatch& match = *evidence.units;
  if (finding == UnitFinding::shown)
    return "sp and pv are in different units: where the setpoint moves, pv is " + line_text(match) +
           " to within " + text::number(match.residual) + ", and " + converted_text(match) + ".";
  return "sp and pv may be in different units: pv is " + text::number(match.pv_mean) +
         " where sp is " + text::number(match.sp_mean) + ", and " + converted_text(match) + ".";
}

std::string unit_summary() {
  return "The setpoint is recorded in another unit than pv.";
}

std::string unit_action() {
  return "Record the setpoint in the unit of pv, or convert it in a view that the historian's "
         "table is read through; what else is said of this loop counts only after that.";
}

}  // namespace loopscope::core::diagnosis
