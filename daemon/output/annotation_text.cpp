#include "daemon/output/annotation_text.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "core/text/phrases.hpp"
#include "daemon/text/author_text.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

/// `until` and `since` are as wide as a time with its offset.
constexpr const char* kRow = "{0:<24} {1:<14} {2:<22} {3:<{7}} {4:<28} {5:<{7}} {6}\n";
constexpr const char* kAcknowledged = "acknowledged";

std::size_t time_width(const TimeZone& zone) {
  return format_time(0, zone).size();
}

std::string until_text(const storage::Annotation& annotation, const TimeZone& zone) {
  if (annotation.until_us) return format_time(*annotation.until_us, zone);
  return annotation.kind == kAcknowledged ? "work is entered" : "withdrawn";
}

/// As the view annotation_history ends it.
std::string end_of(const storage::Annotation& annotation, const TimeZone& zone) {
  if (annotation.until_us) return "until " + format_time(*annotation.until_us, zone);
  if (annotation.kind != kAcknowledged) return "until it is withdrawn";
  return "until work done since is entered (loopscope maintenance) and a window lies wholly after "
         "it, or until it is withdrawn";
}

std::string about(const storage::Annotation& annotation) {
  return annotation.code ? "verdict " + printable(*annotation.code) : "whatever the verdict";
}

/// "acknowledged by J. Doe (login ls) since 2026-05-01T00:00:00Z, verdict any, until ...: why".
std::string who_said(const storage::Annotation& said, const TimeZone& zone) {
  return fmt::format("{} by {} since {}, {}{}{}", core::text::code_words(said.kind),
                     printable(author_text(said.author, said.on_behalf_of)),
                     second_in_zone(said.entered_at_us, zone), about(said),
                     said.until_us ? ", until " + format_time(*said.until_us, zone) : "",
                     said.reason.empty() ? "" : ": " + printable(said.reason));
}

/// What else was said of the loop, a sentence each.
std::vector<std::string> others_sentences(const storage::OthersInForce& others,
                                          const TimeZone& zone) {
  std::vector<std::string> sentences;
  for (const storage::Annotation& said : others.replaced)
    sentences.push_back("takes the place of what was in force already: " + who_said(said, zone));
  for (const storage::Annotation& said : others.beside)
    sentences.push_back("stands beside what is in force already: " + who_said(said, zone));
  return sentences;
}

}  // namespace

std::string annotation_table(const std::vector<storage::Annotation>& annotations,
                             const TimeZone& zone) {
  if (annotations.empty()) return "no annotation holds\n";
  const std::size_t width = time_width(zone);
  std::string table =
      fmt::format(kRow, "loop", "what", "verdict", "until", "by", "since", "reason", width);
  for (const storage::Annotation& said : annotations) {
    table += fmt::format(kRow, printable(said.loop_name), said.kind,
                         printable(said.code.value_or("any")), until_text(said, zone),
                         printable(author_text(said.author, said.on_behalf_of)),
                         second_in_zone(said.entered_at_us, zone), printable(said.reason), width);
  }
  return table;
}

std::string annotation_line(const storage::Annotation& annotation, const TimeZone& zone) {
  return fmt::format("{} {}, {}, {}", annotation.kind, printable(annotation.loop_name),
                     about(annotation), end_of(annotation, zone));
}

std::string others_in_force(const storage::OthersInForce& others, const TimeZone& zone) {
  std::string text;
  for (const std::string& sentence : others_sentences(others, zone)) text += "  " + sentence + '\n';
  if (!others.beside.empty())
    text += "  `withdraw` takes back all that holds of the loop, with --code one verdict's\n";
  return text;
}

}  // namespace loopscope::daemon
