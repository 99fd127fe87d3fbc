#include "tests/architecture/layout_rules.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "tests/architecture/rooms.hpp"

namespace loopscope::tests::architecture {

namespace {

constexpr std::size_t kMostLines = 300;
constexpr std::size_t kMostReadmeLines = 150;

/// A migration is one subject of the schema in the form that databases hold: it is never split or
/// edited once it was given out, and half of it are comments of columns. Its lines are counted by
/// their width as well, so that it cannot be long sideways.
constexpr std::string_view kMigrations = "storage/migrations/";
constexpr std::size_t kMostMigrationLines = 900;
constexpr std::size_t kMostMigrationWidth = 120;

constexpr std::array<std::string_view, 6> kTopLevel = {"config", "core",    "daemon",
                                                       "deploy", "storage", "tests"};

/// One header serves the variants of a kernel for different processors.
constexpr std::array<std::string_view, 3> kProcessorSuffixes = {"_avx2", "_avx512", "_portable"};

constexpr std::string_view kCommands = "/commands/";

/// The headers that may declare what a source file defines; one of them has to exist.
std::vector<std::string> possible_headers(const std::string& source) {
  std::string stem = source.substr(0, source.rfind('.'));
  std::vector<std::string> headers = {stem + ".hpp"};
  for (const std::string_view suffix : kProcessorSuffixes)
    if (stem.ends_with(suffix))
      headers.push_back(stem.substr(0, stem.size() - suffix.size()) + ".hpp");
  // Each command is one function, and one header lists them all.
  const std::string folder = source.substr(0, source.rfind('/') + 1);
  if (folder.ends_with(kCommands)) headers.push_back(folder + "commands.hpp");
  return headers;
}

std::size_t most_lines(std::string_view path) {
  if (path.ends_with("README.md")) return kMostReadmeLines;
  return path.starts_with(kMigrations) ? kMostMigrationLines : kMostLines;
}

void check_width(const SourceFile& file, std::vector<Violation>& violations) {
  std::size_t number = 0;
  for (const std::string& line : lines_of(file.text)) {
    ++number;
    if (line.size() > kMostMigrationWidth)
      violations.push_back({file.path, number,
                            "is " + std::to_string(line.size()) + " characters wide, at most " +
                                std::to_string(kMostMigrationWidth) + " are allowed"});
  }
}

}  // namespace

std::vector<Violation> check_top_level(std::span<const std::string> folders) {
  std::vector<Violation> violations;
  for (const std::string& folder : folders)
    if (std::find(kTopLevel.begin(), kTopLevel.end(), folder) == kTopLevel.end())
      violations.push_back({folder, 0, "no folder of this name stands at the top level"});
  return violations;
}

std::vector<Violation> check_headers(std::span<const SourceFile> files) {
  std::set<std::string> paths;
  for (const SourceFile& file : files) paths.insert(file.path);
  std::vector<Violation> violations;
  for (const SourceFile& file : files) {
    const bool needs_header = room_of(file.path) != nullptr && file.path.ends_with(".cpp") &&
                              file.path != "daemon/main.cpp";
    if (!needs_header) continue;
    const std::vector<std::string> headers = possible_headers(file.path);
    if (std::none_of(headers.begin(), headers.end(),
                     [&paths](const std::string& header) { return paths.contains(header); }))
      violations.push_back({file.path, 0, "has no header " + headers.front()});
  }
  return violations;
}

std::vector<Violation> check_rooms(std::span<const SourceFile> files) {
  std::vector<Violation> violations;
  for (const SourceFile& file : files)
    if (file.path.starts_with("core/") && !file.path.ends_with("CMakeLists.txt") &&
        room_of(file.path) == nullptr)
      violations.push_back({file.path, 0, "stands in no room of core/"});
  return violations;
}

std::vector<Violation> check_lengths(std::span<const SourceFile> files) {
  std::vector<Violation> violations;
  for (const SourceFile& file : files) {
    const std::size_t count = lines_of(file.text).size();
    const std::size_t most = most_lines(file.path);
    if (count > most)
      violations.push_back({file.path, count,
                            "has " + std::to_string(count) + " lines, at most " +
                                std::to_string(most) + " are allowed"});
    if (file.path.starts_with(kMigrations)) check_width(file, violations);
  }
  return violations;
}

}  // namespace loopscope::tests::architecture
