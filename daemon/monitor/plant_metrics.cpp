#include "daemon/monitor/plant_metrics.hpp"

#include <map>
#include <utility>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {
namespace {

using prometheus::BuildCounter;
using prometheus::BuildGauge;
using prometheus::Counter;
using storage::AreaFigures;

constexpr std::size_t kMostAreaBytes = 128;
constexpr const char* kNoArea = "none";

void merge(AreaFigures& into, const AreaFigures& more) {
  into.judged += more.judged;
  into.not_controlling += more.not_controlling;
  into.not_judged += more.not_judged;
  into.never_analysed += more.never_analysed;
  into.control_sum += more.control_sum;
  into.control_loops += more.control_loops;
  for (const auto& [verdict, loops] : more.flagged) into.flagged[verdict] += loops;
}

/// By the label that they are shown with: names that differ in what no label shows are one.
std::map<std::string, AreaFigures> by_label(const std::vector<AreaFigures>& areas) {
  std::map<std::string, AreaFigures> labelled;
  for (const AreaFigures& area : areas) {
    const std::string label = area.area.empty() ? kNoArea : plain_line(area.area, kMostAreaBytes);
    AreaFigures& kept = labelled[label];
    kept.area = label;
    merge(kept, area);
  }
  return labelled;
}

}  // namespace

PlantMetrics::PlantMetrics(prometheus::Registry& registry)
    : flagged_(BuildGauge()
                   .Name("loopscope_flagged_loops")
                   .Help("Loops on the list; the same from every worker of a catalogue: "
                         "max by (job, verdict, area)")
                   .Register(registry)),
      states_(BuildGauge()
                  .Name("loopscope_loops_by_state")
                  .Help("Enabled loops by what their newest window is worth; the same from every "
                        "worker: max by (job, state, area)")
                  .Register(registry)),
      service_factor_(BuildGauge()
                          .Name("loopscope_service_factor")
                          .Help("Mean share of the loops' newest windows in which a controller "
                                "acts, 0 to 1; the same from every worker: max by (job, area)")
                          .Register(registry)),
      flags_(BuildCounter()
                 .Name("loopscope_flags_total")
                 .Help("Loops that came onto the list and were announced, since the schema was "
                       "made; the same from every worker: max by (job, verdict) (increase(...))")
                 .Register(registry)) {}

void PlantMetrics::set(const storage::PlantFigures& figures) {
  forget();
  for (const auto& [label, area] : by_label(figures.areas)) set_area(area, figures);
  for (const auto& [verdict, total] : figures.announced)
    set_total(verdict, static_cast<double>(total));
}

/// Areas and verdicts that are no longer there.
void PlantMetrics::forget() {
  for (const auto& [family, gauge] : shown_) family->Remove(gauge);
  shown_.clear();
}

void PlantMetrics::add(Gauges& family, const prometheus::Labels& labels, double value) {
  prometheus::Gauge& gauge = family.Add(labels);
  gauge.Set(value);
  shown_.emplace_back(&family, &gauge);
}

/// Every verdict of a fault, at 0 too: an alarm does not wait for a series that is not there.
void PlantMetrics::set_area(const AreaFigures& area, const storage::PlantFigures& figures) {
  std::map<std::string, std::int64_t> flagged = area.flagged;
  for (const auto& [verdict, total] : figures.announced) flagged.try_emplace(verdict, 0);
  for (const auto& [verdict, loops] : flagged)
    add(flagged_, {{"verdict", verdict}, {"area", area.area}}, static_cast<double>(loops));
  for (const auto& [state, loops] :
       {std::pair{"judged", area.judged}, std::pair{"not_controlling", area.not_controlling},
        std::pair{"not_judged", area.not_judged}, std::pair{"never_analysed", area.never_analysed}})
    add(states_, {{"state", state}, {"area", area.area}}, static_cast<double>(loops));
  if (area.control_loops > 0)
    add(service_factor_, {{"area", area.area}},
        area.control_sum / static_cast<double>(area.control_loops));
}

/// A total that went back (a database that was restored) begins anew, as counters do.
void PlantMetrics::set_total(const std::string& verdict, double total) {
  Counter* counter = &flags_.Add({{"verdict", verdict}});
  if (total < counter->Value()) {
    flags_.Remove(counter);
    counter = &flags_.Add({{"verdict", verdict}});
  }
  counter->Increment(total - counter->Value());
}

}  // namespace loopscope::daemon
