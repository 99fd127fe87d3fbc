#pragma once

#include <filesystem>
#include <string>

#include "tests/plants/process/process_plant.hpp"

namespace loopscope::tests::process {

/// One CSV a loop (t_s,sp,pv,op; an empty field = not recorded) and truth.json in `folder`, which
/// is made.
void write_plant_files(const ProcessPlant& plant, const std::filesystem::path& folder);

/// Kind, cause, period_s, source, cascades and every loop's truth.
[[nodiscard]] std::string truth_json(const ProcessPlant& plant);

}  // namespace loopscope::tests::process
