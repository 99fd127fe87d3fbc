#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/report/page/fields.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/catalogue/annotations.hpp"
#include "storage/results/reports/report_rows.hpp"

namespace loopscope::daemon {

/// What somebody chose and typed in the form, any text.
struct TypedAnnotation {
  std::string deed;  ///< acknowledge, suppress, false-positive, withdraw
  std::string code, reason, until;
};

/// What the page of a loop says on which people speak of its findings.
struct AnnotateFacts {
  std::string loop_name, user;
  std::string token;  ///< of every form on the page
  bool away = false;  ///< the results database did not answer: nothing of the next two
  std::optional<storage::FlaggedRow> found;   ///< nullopt = never analysed
  std::vector<storage::Annotation> in_force;  ///< oldest first
  std::string trouble;                        ///< why nothing was entered; empty = nothing is
  std::vector<std::string> told;              ///< sentences about what was entered
  TypedAnnotation typed;                      ///< shown again; empty at first
  TimeZone zone;
};

/// The finding, what holds of it with a button that withdraws it, and the form, as HTML.
[[nodiscard]] Markup annotate_section(const AnnotateFacts& facts);

}  // namespace loopscope::daemon
