#include "daemon/output/annotation_text.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "core/signal/microseconds.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kRow = "{:<24} {:<14} {:<22} {:<20} {:<16} {:<20} {}\n";

std::string until_text(const storage::Annotation& annotation) {
  return annotation.until_us ? format_time(*annotation.until_us) : "withdrawn";
}

/// Whole seconds are enough for people.
std::string entered_text(const storage::Annotation& annotation) {
  return format_time(annotation.entered_at_us / core::signal::kSecond_us *
                     core::signal::kSecond_us);
}

}  // namespace

std::string annotation_table(const std::vector<storage::Annotation>& annotations) {
  if (annotations.empty()) return "no annotation holds\n";
  std::string table =
      fmt::format(kRow, "loop", "what", "verdict", "until", "by", "since", "reason");
  for (const storage::Annotation& said : annotations) {
    table += fmt::format(kRow, printable(said.loop_name), said.kind,
                         printable(said.code.value_or("any")), until_text(said),
                         printable(said.author), entered_text(said), printable(said.reason));
  }
  return table;
}

std::string annotation_line(const storage::Annotation& annotation) {
  const std::string about =
      annotation.code ? "verdict " + printable(*annotation.code) : "whatever the verdict";
  return fmt::format("{} {}, {}, until {}", annotation.kind, printable(annotation.loop_name), about,
                     annotation.until_us ? format_time(*annotation.until_us) : "it is withdrawn");
}

}  // namespace loopscope::daemon
