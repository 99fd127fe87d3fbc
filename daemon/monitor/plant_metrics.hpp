#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/registry.h>
#include <string>
#include <vector>

#include "storage/results/plant/plant_figures.hpp"

namespace loopscope::daemon {

/// How the plant stands, for those who have Prometheus alone: loops on the list by verdict and
/// area, how often loops came onto it, how many are judged, the service factor. What the results
/// database says is the same for every worker. Areas become plain lines; an area that the catalogue
/// does not name is "none". There are never more than storage::kMostAreas of them and those
/// together that remain. Not thread-safe.
class PlantMetrics {
 public:
  explicit PlantMetrics(prometheus::Registry& registry);

  /// These figures take the place of the last ones.
  void set(const storage::PlantFigures& figures);

 private:
  using Gauges = prometheus::Family<prometheus::Gauge>;

  void forget();
  void add(Gauges& family, const prometheus::Labels& labels, double value);
  void set_area(const storage::AreaFigures& area, const storage::PlantFigures& figures);
  void set_total(const std::string& verdict, double total);

  Gauges& flagged_;
  Gauges& states_;
  Gauges& service_factor_;
  prometheus::Family<prometheus::Counter>& flags_;
  std::vector<std::pair<Gauges*, prometheus::Gauge*>> shown_;
};

}  // namespace loopscope::daemon
