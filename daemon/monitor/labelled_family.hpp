#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <prometheus/family.h>
#include <span>
#include <string>

#include "daemon/monitor/plain_line.hpp"

namespace loopscope::daemon {

/// The metrics of one name that a label tells apart whose values come from outside: settings and
/// databases. Values become plain lines, and there are never more than kMostValues of them: what
/// comes later shares the value "other", so that nobody's names can fill the memory of this
/// process or of the one that collects. Not thread-safe.
template <typename Metric>
class LabelledFamily {
 public:
  static constexpr std::size_t kMostValues = 64;
  static constexpr std::size_t kMostBytes = 128;

  LabelledFamily(prometheus::Family<Metric>& family, std::string label)
      : family_(family), label_(std::move(label)) {}

  /// Made at the first call; valid until keep() forgets it.
  Metric& at(const std::string& name) {
    const std::string value = plain_line(name, kMostBytes);
    const auto found = metrics_.find(value);
    if (found != metrics_.end()) return *found->second;
    if (metrics_.size() >= kMostValues) return family_.Add({{label_, "other"}});
    return *metrics_.emplace(value, &family_.Add({{label_, value}})).first->second;
  }

  /// Forgets the metrics of all other names.
  void keep(std::span<const std::string> names) {
    std::erase_if(metrics_, [&](const auto& metric) {
      const bool kept = std::ranges::any_of(names, [&](const std::string& name) {
        return plain_line(name, kMostBytes) == metric.first;
      });
      if (!kept) family_.Remove(metric.second);
      return !kept;
    });
  }

 private:
  prometheus::Family<Metric>& family_;
  std::string label_;
  std::map<std::string, Metric*> metrics_;
};

}  // namespace loopscope::daemon
