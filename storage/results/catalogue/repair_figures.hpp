#pragma once

#include <span>
#include <string>

#include "core/repair/judge_repair.hpp"

namespace loopscope::storage {

/// The figures before and after a piece of work as the JSON object of repair_judgement.figures,
/// which the view maintenance_figure takes apart: by name, each with numbers of windows, and value
/// and interval before, after and of the change; what is not finite or not known is null.
[[nodiscard]] std::string figures_json(std::span<const core::repair::FigureChange> figures);

}  // namespace loopscope::storage
