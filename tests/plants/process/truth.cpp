#include "tests/plants/process/truth.hpp"

#include <algorithm>
#include <cmath>

#include "tests/plants/process/spectrum.hpp"

namespace loopscope::tests::process {
namespace {

constexpr double kPeriodsAtLeast = 8.0;
constexpr double kSamplesAtLeast = 4.0;
constexpr double kCalmLine = 0.45;  // share of an error's power within 15 % of one frequency

double ratio(double part, double whole) {
  return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
}

double strongest_of(const Spectrum& spectrum, std::size_t samples) {
  return spectrum.strongest(4.0 / static_cast<double>(samples));
}

/// Where the change of the source's error is strongest, if that stands out of the error itself.
std::optional<double> measured_period(const Twins& twins, std::size_t source) {
  const Spectrum change(change_of_error(twins, source));
  const Spectrum error(error_of(twins.with[source]));
  const double f = strongest_of(change, twins.with[source].pv.size());
  const double line = change.power(0.85 * f, 1.15 * f);
  if (line < 0.25 * error.total() || line < 0.35 * change.total()) return std::nullopt;
  return twins.with[source].interval_s / f;
}

void measure(ProcessLoop& loop, const Record& with, const Record& without, double period_s) {
  const std::vector<double> error = error_of(with);
  const std::vector<double> change = difference(error, error_of(without));
  loop.share = ratio(variance(change), variance(error));
  loop.pv_share = ratio(variance(difference(with.pv, without.pv)), variance(with.pv));
  const double frequency = with.interval_s / period_s;
  loop.line_share = ratio(Spectrum(change).line_power(frequency), Spectrum(error).total());
  loop.carries = loop.share >= kCarryingShare && loop.line_share >= kCarryingShare / 2.0 &&
                 frequency * kSamplesAtLeast <= 1.0 &&
                 frequency * static_cast<double>(with.pv.size()) >= kPeriodsAtLeast;
}

}  // namespace

std::vector<double> error_of(const Record& record) {
  return difference(record.sp, record.pv);
}

std::vector<double> change_of_error(const Twins& twins, std::size_t loop) {
  return difference(error_of(twins.with[loop]), error_of(twins.without[loop]));
}

bool swings(const Record& record) {
  const Spectrum error(error_of(record));
  const double f = strongest_of(error, record.pv.size());
  return error.power(0.85 * f, 1.15 * f) >= 0.2 * error.total();
}

std::optional<double> period_of(const Draft& draft, const Twins& twins) {
  if (draft.set_period_s) return draft.set_period_s;
  if (twins.without.empty()) return std::nullopt;
  return measured_period(twins, *draft.source);
}

std::vector<ProcessLoop> loops_of(const Draft& draft, Twins twins, double period_s) {
  std::vector<ProcessLoop> loops;
  for (std::size_t i = 0; i < twins.with.size(); ++i) {
    const LoopPlan& plan = draft.with.loops[i];
    Record& with = twins.with[i];
    ProcessLoop loop;
    loop.name = plan.name;
    loop.type = plan.type;
    loop.integrating = plan.integrating;
    loop.interval_s = with.interval_s;
    loop.start_s = with.start_s;
    loop.low = plan.low;
    loop.high = plan.high;
    if (period_s > 0.0) measure(loop, with, twins.without[i], period_s);
    loop.sp = std::move(with.sp);
    loop.pv = std::move(with.pv);
    loop.op = std::move(with.op);
    loops.push_back(std::move(loop));
  }
  return loops;
}

bool runs_well(const Draft& draft, const std::vector<Record>& records) {
  if (records.empty()) return false;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto at_limit =
        std::ranges::count_if(records[i].op, [](double op) { return op <= 0.0 || op >= 100.0; });
    const double most = draft.source == i ? 0.3 : 0.02;
    if (static_cast<double>(at_limit) > most * static_cast<double>(records[i].op.size()))
      return false;
  }
  return true;
}

bool is_calm(const std::vector<Record>& records) {
  return std::ranges::none_of(records, [](const Record& record) {
    const Spectrum error(error_of(record));
    const double f = error.strongest(12.0 / static_cast<double>(record.pv.size()));
    return error.power(0.85 * f, 1.15 * f) > kCalmLine * error.total();
  });
}

}  // namespace loopscope::tests::process
