#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/catalogue/discover_loops.hpp"
#include "daemon/catalogue/propose_entry.hpp"

namespace loopscope::daemon {

/// What became of a discovery when it was laid beside the catalogue.
struct DiscoveryReport {
  std::string source;
  std::size_t tags = 0;
  Discovery discovery;                       ///< `loops` are those that are new
  std::size_t known = 0;                     ///< loops whose pv the catalogue has already
  std::vector<std::string> taken;            ///< names that another loop of the catalogue has
  std::vector<std::string> empty_tags = {};  ///< of the new loops, left out: nothing is recorded
  std::vector<Proposal> proposals = {};      ///< of the new loops; what can be filled in is
  std::string config = "F";                  ///< settings file, for commands
};

/// The report for a terminal: counts, and the first few of everything that is missing or unclear.
[[nodiscard]] std::string discovery_text(const DiscoveryReport& report);

/// Proposals for a terminal, the first few of each kind: those that are filled in, and questions,
/// each with the command that answers it. `config`: the settings file.
[[nodiscard]] std::string proposals_text(const std::vector<Proposal>& proposals,
                                         const std::string& config);

}  // namespace loopscope::daemon
