#include "config/read_settings.hpp"

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <system_error>
#include <utility>

#include "config/cross_rules.hpp"
#include "config/document.hpp"
#include "config/problem_list.hpp"
#include "config/read_tree.hpp"

namespace loopscope::config {

namespace {

/// Some thousand historians fit in; a device or a recording given by mistake is not read to its
/// end.
constexpr std::size_t kLargestFile = std::size_t{256} * 1024;

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
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.is_open() || stream.bad())
    refuse_file(file.string(), "cannot be read: " + std::generic_category().message(errno),
                "does the file exist, and may this user read it?");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
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
