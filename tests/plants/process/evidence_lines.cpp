#include "tests/plants/process/evidence_lines.hpp"

#include <sstream>

#include "core/plant/cascade.hpp"
#include "core/plant/event.hpp"
#include "core/plant/source_evidence.hpp"

namespace loopscope::tests::process {

std::vector<std::string> evidence_lines(const std::string& plant,
                                        const core::plant::SharedOscillation& event,
                                        std::span<const core::plant::MemberLoop> members,
                                        std::optional<std::size_t> source) {
  core::plant::Event found{1.0 / event.period_s, event.p, {}};
  for (const core::plant::SharingLoop& member : event.members)
    found.members.push_back({member.index, member.p, member.strength});
  const core::plant::SourceFigures figures =
      core::plant::figures_of(core::plant::gather_source_evidence(
          members, found, core::plant::find_cascade_pairs(members), event.leads));
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < found.members.size(); ++k) {
    std::ostringstream line;
    line << plant << ',' << (source == found.members[k].index ? 1 : 0);
    for (const double value : figures.members[k]) line << ',' << value;
    for (const double value : figures.none) line << ',' << value;
    lines.push_back(line.str());
  }
  return lines;
}

}  // namespace loopscope::tests::process
