#include "daemon/report/annotate/entry_text.hpp"

#include <fmt/format.h>

#include "daemon/report/plant/annotated_table.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

/// "verdict valve stiction, until 2026-03-01 13:00 CET".
std::string about_and_until(const storage::Annotation& said, const TimeZone& zone) {
  return fmt::format("{}, until {}",
                     said.code ? "verdict " + in_words(*said.code) : "whatever the verdict",
                     until_words(said.kind, said.until_us, zone));
}

std::string told_of(const char* how, const storage::Annotation& said, const TimeZone& zone) {
  return fmt::format("{} already: {} by {} since {}, {}{}", how, in_words(said.kind),
                     author_text(said.author, said.on_behalf_of),
                     minute_in_zone(said.entered_at_us, zone), about_and_until(said, zone),
                     said.reason.empty() ? "." : ": " + said.reason);
}

}  // namespace

std::string entered_sentence(const storage::Annotation& annotation, const TimeZone& zone) {
  return fmt::format("Entered: {}, {}.", in_words(annotation.kind),
                     about_and_until(annotation, zone));
}

std::vector<std::string> others_told(const storage::OthersInForce& others, const TimeZone& zone) {
  std::vector<std::string> sentences;
  for (const storage::Annotation& said : others.replaced)
    sentences.push_back(told_of("Takes the place of what was in force", said, zone));
  for (const storage::Annotation& said : others.beside)
    sentences.push_back(told_of("Stands beside what is in force", said, zone));
  return sentences;
}

}  // namespace loopscope::daemon
