#include "core/diagnosis/verdicts/verdict.hpp"

#include <algorithm>
#include <cstddef>

#include "core/diagnosis/verdicts/verdict_catalogue.hpp"

namespace loopscope::core::diagnosis {

std::string_view name(VerdictCode code) {
  return catalogue_entry(code).name;
}

std::optional<VerdictCode> verdict_code(std::string_view name) {
  const auto found = std::ranges::find(catalogue(), name, &CatalogueEntry::name);
  if (found == catalogue().end()) return std::nullopt;
  return found->code;
}

void set_cause(PerCause& values, VerdictCode code, double value) {
  const auto place = static_cast<std::size_t>(code);
  if (place >= values.size()) values.resize(place + 1);
  values[place] = value;
}

PerCause probabilities_of(const Verdict& verdict) {
  PerCause values;
  for (const CauseReport& cause : verdict.causes) set_cause(values, cause.code, cause.probability);
  return values;
}

std::span<const VerdictCode> all_verdict_codes() {
  static const std::vector<VerdictCode> codes = [] {
    std::vector<VerdictCode> all;
    for (const CatalogueEntry& entry : catalogue()) all.push_back(entry.code);
    return all;
  }();
  return codes;
}

}  // namespace loopscope::core::diagnosis
