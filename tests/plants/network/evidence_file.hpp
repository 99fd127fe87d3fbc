#pragma once

#include <ostream>
#include <vector>

#include "tests/plants/network/outcome.hpp"

namespace loopscope::tests::network {

/// One line per member of every plant's event: plant, 1 for the true source, the figures in the
/// order of core/plant/source_evidence.hpp. Plants whose figures were not asked for have none.
void write_evidence(std::ostream& out, const std::vector<Outcome>& outcomes);

}  // namespace loopscope::tests::network
