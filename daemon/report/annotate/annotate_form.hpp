#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/report/annotate/annotate_section.hpp"

namespace loopscope::daemon {

/// A form as it was sent.
struct AnnotateForm {
  std::string token, loop;
  TypedAnnotation typed;
  std::int64_t annotation_id = 0;  ///< of what is withdrawn; 0 = nothing
};

/// The fields of the form's body; nullopt where it is none of ours: a field twice, bytes that are
/// no text, a number that is none. What is missing is empty.
[[nodiscard]] std::optional<AnnotateForm> read_annotate_form(const std::string& body);

}  // namespace loopscope::daemon
