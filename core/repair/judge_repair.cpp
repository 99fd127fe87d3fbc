#include "core/repair/judge_repair.hpp"

#include <algorithm>
#include <cmath>

#include "core/repair/repair_statement.hpp"

namespace loopscope::core::repair {
namespace {

/// A loop model reads gain and integral time of a PI controller from op to the digit: a change
/// beyond 3 % was made by somebody (storage/MEASURED.md, "Repairs").
constexpr double kRetuned = 0.03;
/// A fault that names no hardware is believed gone, or come, from this mean confidence on; below
/// it the cost has to say so as well.
constexpr double kSure = 0.75;
/// Half a significant step: what the cost has to show where the diagnosis alone is not sure.
constexpr double kHalf = 0.5;

/// The figures that decide, as weights: a change over half its 90 % interval.
struct Evidence {
  SideVerdict before, after;
  double cost = 0.0, spread = 0.0;
  double retuned = 0.0;        ///< largest change of the controller, as |ln|
  double tighter = 0.0;        ///< ln of the gain less half of ln of the integral time
  std::optional<double> size;  ///< of the family that stands on both sides
  bool detuned = false;        ///< the controller was set further towards its own fault
};

const FigureChange* find(const std::vector<FigureChange>& figures, std::string_view name) {
  const auto found =
      std::ranges::find_if(figures, [&](const FigureChange& f) { return f.kind->name == name; });
  return found == figures.end() ? nullptr : &*found;
}

std::optional<double> weight_of(const std::vector<FigureChange>& figures, std::string_view name) {
  const FigureChange* figure = find(figures, name);
  return figure != nullptr ? figure->weight : std::nullopt;
}

/// ln of the ratio; 0 where one side has none.
double log_change(const std::vector<FigureChange>& figures, std::string_view name) {
  const FigureChange* figure = find(figures, name);
  return figure != nullptr && figure->change ? std::log(figure->change->value) : 0.0;
}

bool is_tuning(const std::optional<StandingFault>& fault) {
  return fault && fault->code.ends_with("tuning");
}

bool is_hardware(const std::optional<StandingFault>& fault) {
  return fault && fault->is_hardware;
}

bool names_oversized(const RepairWindows& windows) {
  const auto oversized = [](const RepairWindow& w) { return w.code == "valve_oversized"; };
  return std::ranges::any_of(windows.before, oversized) ||
         std::ranges::any_of(windows.after, oversized);
}

bool went_the_wrong_way(const Evidence& e) {
  const auto& fault = e.before.stands ? e.before.stands : e.after.stands;
  if (!fault) return false;
  if (fault->code == "tight_tuning") return e.tighter > kRetuned;
  return fault->code == "sluggish_tuning" && e.tighter < -kRetuned;
}

/// How many half intervals the cost has to move until the same fault counts as less or more.
double needed(const Evidence& e) {
  const bool retuned = e.retuned > kRetuned;
  // The controller says in which direction its own fault went: without a change of it, load did.
  if (is_tuning(e.before.stands)) return retuned ? 1.0 : 2.0;
  if (retuned) return 0.6;  // set anew for another valve: its cost follows the valve's
  // A size that is known and equal speaks against a change.
  return e.size && std::abs(*e.size) < kHalf ? 1.5 : 1.0;
}

Outcome without_fault_before(const Evidence& e) {
  const bool surely_new = e.after.stands && e.after.stands->sure >= kSure && e.cost > 0.0;
  if (is_hardware(e.after.stands) || surely_new || (e.detuned && e.cost > 0.0) ||
      (e.cost > 1.0 && e.spread > kHalf))
    return Outcome::worse;
  if (e.cost >= -1.0 || e.spread >= -kHalf) return Outcome::unchanged;
  const bool gone = e.spread < -1.0 && !e.before.suspected.empty() && !e.after.stands;
  return gone ? Outcome::fixed : Outcome::improved;
}

/// Whether what stands now is what stood before, or cannot be proven not to be.
bool still_stands(const Evidence& e) {
  if (!e.after.stands) return false;
  const StandingFault& was = *e.before.stands;
  const StandingFault& is_now = *e.after.stands;
  return is_now.family == was.family ||
         (was.family == "unknown" && is_now.is_hardware && e.cost <= 1.0) ||
         (was.is_hardware && is_now.code == "nonlinear_unexplained");
}

Outcome of_the_same_fault(const Evidence& e) {
  if (e.size && *e.size < -1.0) return Outcome::improved;
  if (e.size && *e.size > 1.0) return Outcome::worse;
  if (e.cost < -needed(e)) return Outcome::improved;
  if (e.cost > needed(e)) return Outcome::worse;
  if (e.retuned <= kRetuned || !is_tuning(e.before.stands)) return Outcome::unchanged;
  return e.detuned ? Outcome::worse : Outcome::improved;
}

Outcome outcome_of(const Evidence& e) {
  if (!e.before.stands) return without_fault_before(e);
  if (still_stands(e)) return of_the_same_fault(e);
  if (is_hardware(e.after.stands)) return e.cost > -kHalf ? Outcome::worse : Outcome::improved;
  if (e.cost > 1.0 && e.spread > 1.0) return Outcome::worse;
  const StandingFault& was = *e.before.stands;
  return was.is_hardware || was.sure >= kSure || e.cost < -kHalf ? Outcome::fixed
                                                                 : Outcome::unchanged;
}

/// The size of the family that stands on both sides, from the figure that most windows have. A
/// band in % of op means nothing across another valve or another controller.
const FigureChange* size_figure(const RepairWindows& windows, const Evidence& e,
                                const std::vector<FigureChange>& figures) {
  if (!e.before.stands || !e.after.stands || e.before.stands->family != e.after.stands->family)
    return nullptr;
  const std::string& family = e.before.stands->family;
  if (family == "friction" && (e.retuned > kRetuned || names_oversized(windows))) return nullptr;
  const FigureChange* best = nullptr;
  for (const FigureChange& figure : figures) {
    if (figure.kind->family != family || !figure.weight) continue;
    const auto have = [](const FigureChange& f) { return f.windows_before + f.windows_after; };
    if (best == nullptr || have(figure) > have(*best)) best = &figure;
  }
  return best;
}

Evidence evidence_of(const RepairWindows& windows, const std::vector<FigureChange>& figures) {
  Evidence e;
  e.before = side_verdict(windows.before, windows.min_confidence);
  e.after = side_verdict(windows.after, windows.min_confidence);
  e.spread = weight_of(figures, "error_std").value_or(0.0);
  e.cost = weight_of(figures, "cost").value_or(e.spread);
  const double gain = log_change(figures, "controller_gain");
  const double time = log_change(figures, "integral_time_s");
  e.retuned = std::max(std::abs(gain), std::abs(time));
  e.tighter = gain - 0.5 * time;
  e.detuned = went_the_wrong_way(e);
  return e;
}

}  // namespace

std::string_view name(Outcome outcome) {
  switch (outcome) {
    case Outcome::fixed:
      return "fixed";
    case Outcome::improved:
      return "improved";
    case Outcome::unchanged:
      return "unchanged";
    case Outcome::worse:
      return "worse";
  }
  return "";
}

std::optional<Interval> RepairJudgement::variance_ratio() const {
  const FigureChange* spread = find(figures, "error_std");
  if (spread == nullptr || !spread->change) return std::nullopt;
  const auto square = [](double x) { return x * x; };
  const Interval& change = *spread->change;
  return Interval{square(change.value), square(change.low), square(change.high)};
}

RepairJudgement judge_repair(const RepairWindows& windows) {
  RepairJudgement judgement;
  judgement.windows_before = windows.before.size();
  judgement.windows_after = windows.after.size();
  judgement.figures = compare_figures(windows);
  Evidence e = evidence_of(windows, judgement.figures);
  judgement.fault_before = e.before.stands;
  judgement.fault_after = e.after.stands;
  const FigureChange* size = size_figure(windows, e, judgement.figures);
  if (size != nullptr) e.size = size->weight;
  if (!windows.before.empty() && !windows.after.empty()) judgement.outcome = outcome_of(e);
  judgement.statement = repair_statement(
      windows, judgement, {e.before.suspected, size, find(judgement.figures, "error_std")});
  return judgement;
}

}  // namespace loopscope::core::repair
