#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/text/time_text.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/catalogue/annotations.hpp"

namespace loopscope::daemon {

/// Stands for every verdict of a loop.
inline constexpr const char* kAnyCode = "any";

/// What somebody wants to say of a loop's findings, as he entered it.
struct AnnotationWish {
  std::string loop;
  std::string kind;   ///< acknowledged, suppressed or false_positive
  std::string code;   ///< a verdict, or kAnyCode; empty = suppressed: any, else the newest
  std::string until;  ///< of suppressed alone: a time as people write it
  std::string reason;
};

/// What the parts of a wish are called where it was entered.
struct AnnotationWords {
  std::string code = "--code";
  std::string until = "--until";
  std::string reason = "--reason";
  std::string name_the_verdict = "name the verdict that is meant: --code CODE, or --code any";
  std::string list_of_verdicts =
      "`loopscope export --config F verdict_kind` lists them; `any` is all";
  std::string (*tell_time)(std::int64_t time_us, const TimeZone& zone) = format_time;
};

/// What is wrong with the wish by itself, without a look at any database: its time in `zone`, its
/// reason. Throws Failure (usage).
void check_wish(const AnnotationWish& wish, const AnnotationWords& words, const TimeZone& zone);

/// What is to be added, in nobody's name yet. What is said about a verdict is about the newest one,
/// unless another is named. Throws as check_wish(), Failure (usage) for a verdict that is none of a
/// fault and where the newest is none, and storage::DatabaseError.
[[nodiscard]] storage::Annotation annotation_meant(const AnnotationWish& wish,
                                                   const AnnotationWords& words,
                                                   const TimeZone& zone,
                                                   storage::Annotations& annotations);

}  // namespace loopscope::daemon
