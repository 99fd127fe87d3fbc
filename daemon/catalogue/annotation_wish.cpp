#include "daemon/catalogue/annotation_wish.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <vector>

#include "config/nearest_name.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/read_time.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kSuppressed = "suppressed";

std::int64_t parse_until(const AnnotationWish& wish, const AnnotationWords& words,
                         const TimeZone& zone) {
  const std::int64_t until_us = time_option(words.until, wish.until, zone);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  if (until_us <= std::chrono::duration_cast<std::chrono::microseconds>(now).count()) {
    throw Failure(ExitCode::usage,
                  fmt::format("{} {} has passed", words.until, words.tell_time(until_us, zone)),
                  "name a time to come; without an offset it is meant in " + zone.name());
  }
  return until_us;
}

/// A verdict's code, or `any`; empty stands for what was not said.
void require_known(const std::string& code, const AnnotationWords& words,
                   const std::vector<std::string>& codes) {
  if (code.empty() || code == kAnyCode || std::ranges::count(codes, code) > 0) return;
  const std::optional<std::string> nearest = config::nearest_name(code, codes);
  throw Failure(
      ExitCode::usage, fmt::format("{} \"{}\" is not the verdict of a fault", words.code, code),
      (nearest ? fmt::format("did you mean {}? ", *nearest) : "") + words.list_of_verdicts);
}

std::string newest_fault(const AnnotationWish& wish, const AnnotationWords& words,
                         const std::vector<std::string>& codes, storage::Annotations& annotations) {
  const std::optional<std::string> newest = annotations.newest_code(wish.loop);
  if (newest && std::ranges::count(codes, *newest) > 0) return *newest;
  throw Failure(ExitCode::usage,
                fmt::format("loop \"{}\" has no fault: {}", wish.loop,
                            newest ? "its newest verdict is " + *newest : "it was never analysed"),
                words.name_the_verdict);
}

std::optional<std::string> verdict_meant(const AnnotationWish& wish, const AnnotationWords& words,
                                         storage::Annotations& annotations) {
  const std::vector<std::string> codes = annotations.fault_codes();
  require_known(wish.code, words, codes);
  if (wish.code == kAnyCode) return std::nullopt;
  if (!wish.code.empty()) return wish.code;
  if (wish.kind == kSuppressed) return std::nullopt;
  return newest_fault(wish, words, codes, annotations);
}

}  // namespace

void check_wish(const AnnotationWish& wish, const AnnotationWords& words, const TimeZone& zone) {
  if (wish.kind != kSuppressed) return;
  parse_until(wish, words, zone);
  if (wish.reason.empty())
    throw Failure(ExitCode::usage, words.reason + " is empty", "say why, for those who ask later");
}

storage::Annotation annotation_meant(const AnnotationWish& wish, const AnnotationWords& words,
                                     const TimeZone& zone, storage::Annotations& annotations) {
  check_wish(wish, words, zone);
  storage::Annotation annotation;
  annotation.loop_name = wish.loop;
  annotation.kind = wish.kind;
  annotation.code = verdict_meant(wish, words, annotations);
  if (wish.kind == kSuppressed) annotation.until_us = parse_until(wish, words, zone);
  annotation.reason = wish.reason;
  return annotation;
}

}  // namespace loopscope::daemon
