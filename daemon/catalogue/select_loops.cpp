#include "daemon/catalogue/select_loops.hpp"

#include <fmt/format.h>
#include <fnmatch.h>
#include <set>

#include "daemon/catalogue/unknown_loop.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

bool is_pattern(const std::string& name) {
  return name.find_first_of("*?[") != std::string::npos;
}

/// Numbers of the loops that a name or a pattern means.
std::set<std::size_t> meant_by(const std::string& name, std::span<const CatalogueEntry> all) {
  std::set<std::size_t> exact, fitting;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].name == name) exact.insert(k);
    if (is_pattern(name) && fnmatch(name.c_str(), all[k].name.c_str(), FNM_NOESCAPE) == 0)
      fitting.insert(k);
  }
  return exact.empty() ? fitting : exact;
}

}  // namespace

std::vector<CatalogueEntry> select_loops(std::span<const CatalogueEntry> all,
                                         std::span<const std::string> names) {
  std::set<std::size_t> meant;
  for (const std::string& name : names) {
    const std::set<std::size_t> by_name = meant_by(name, all);
    if (by_name.empty() && is_pattern(name)) {
      throw Failure(ExitCode::usage, fmt::format("no loop fits \"{}\"", name),
                    "loopscope loops --config F lists them");
    }
    if (by_name.empty()) throw unknown_loop(name, all);
    meant.insert(by_name.begin(), by_name.end());
  }
  std::vector<CatalogueEntry> selected;
  for (const std::size_t k : meant) selected.push_back(all[k]);
  return selected;
}

}  // namespace loopscope::daemon
