#include "core/diagnosis/verdict.hpp"

#include <algorithm>

#include "core/diagnosis/catalogue.hpp"

namespace loopscope::core::diagnosis {

std::string_view name(VerdictCode code) {
  return catalogue_entry(code).name;
}

std::optional<VerdictCode> verdict_code(std::string_view name) {
  const auto found = std::ranges::find(catalogue(), name, &CatalogueEntry::name);
  if (found == catalogue().end()) return std::nullopt;
  return found->code;
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
