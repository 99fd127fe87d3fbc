#include "config/read_settings.hpp"

#include <cstddef>
#include <utility>

#include "config/cross_rules.hpp"
#include "config/document.hpp"
#include "config/problem_list.hpp"
#include "config/read_bounded.hpp"
#include "config/read_tree.hpp"

namespace loopscope::config {

namespace {

/// Some thousand historians fit in; a device or a recording given by mistake is not read to its
/// end.
constexpr std::size_t kLargestFile = std::size_t{256} * 1024;
constexpr int kPatience_s = 10;

std::string lines(const std::string& file, const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += file + ": ";
    if (!problem.path.empty()) text += problem.path + ": ";
    text += problem.message;
  }
  return text;
}

[[noreturn]] void refuse_file(const std::string& name, const std::string& why,
                              const std::string& hint) {
  throw SettingsError(name, {{{}, why, hint}});
}

std::string content(const std::filesystem::path& file) {
  try {
    return read_bounded(file, kLargestFile, kPatience_s);
  } catch (const UnreadableFile& error) {
    refuse_file(file.string(), error.what(), error.hint());
  }
}

}  // namespace

SettingsError::SettingsError(const std::string& file, std::vector<Problem> problems)
    : std::runtime_error(lines(file, problems)), file_(file), problems_(std::move(problems)) {}

Settings read_settings(const std::filesystem::path& file) {
  return parse_settings(content(file), file.string());
}

Settings parse_settings(std::string_view text, const std::string& name) {
  if (text.size() > kLargestFile)
    refuse_file(name, "is larger than 256 KiB", "is this the settings file?");
  Document document = read_document(text);
  if (!document.readable) throw SettingsError(name, std::move(document.problems));
  ProblemList problems;
  for (Problem& problem : document.problems) problems.add(std::move(problem));
  Settings settings = read_tree(document.root, problems);
  check_cross_rules(settings, problems);
  if (!problems.problems().empty()) throw SettingsError(name, problems.problems());
  return settings;
}

}  // namespace loopscope::config
