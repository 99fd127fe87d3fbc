#pragma once

#include <string>

#include "daemon/output/analysis_json.hpp"

namespace loopscope::tests::fuzz {

/// What holds of every diagnosis, whatever was recorded: numbers are finite, probabilities and
/// shares within 0 and 1, bifrequencies within 0 and 0.5, the verdict one of the closed list, the
/// JSON text parses again, the page for a terminal can be made. Ends the process where one does
/// not. Returns the JSON text.
std::string check_diagnosis(const daemon::InputFacts& input, const core::Diagnosis& diagnosis);

}  // namespace loopscope::tests::fuzz
