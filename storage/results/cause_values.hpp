#pragma once

#include <pqxx/pqxx>

#include "core/diagnosis/verdict.hpp"

namespace loopscope::storage {

/// An array of the results schema with a value for each cause, "{0.1,NULL,...}"; empty for NULL.
[[nodiscard]] core::diagnosis::PerCause read_cause_values(const pqxx::field& field);

}  // namespace loopscope::storage
