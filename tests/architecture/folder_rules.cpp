#include "tests/architecture/folder_rules.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "tests/architecture/include_rules.hpp"
#include "tests/architecture/rooms.hpp"

namespace loopscope::tests::architecture {

namespace {

constexpr std::size_t kMostFiles = 60;
constexpr std::size_t kMostFilesOfSplitRooms = 30;

/// Rooms and parts of rooms that consist of folders of one subject each.
constexpr std::array<std::string_view, 5> kSplit = {"core/hos", "core/model", "daemon/service",
                                                    "daemon/report", "storage/results"};

std::string folder_of(std::string_view path) {
  return std::string(path.substr(0, path.rfind('/')));
}

using Graph = std::map<std::string, std::set<std::string>>;

Graph folder_includes(std::span<const SourceFile> files) {
  Graph graph;
  for (const SourceFile& file : files) {
    if (room_of(file.path) == nullptr) continue;
    const std::string folder = folder_of(file.path);
    for (const std::string& line : lines_of(file.text)) {
      const auto include = include_of(line);
      if (!include || !include->quoted || room_of(include->header) == nullptr) continue;
      if (const std::string other = folder_of(include->header); other != folder)
        graph[folder].insert(other);
    }
  }
  return graph;
}

std::set<std::string> reached_from(const std::string& folder, const Graph& graph) {
  std::set<std::string> reached;
  std::vector<std::string> open = {folder};
  while (!open.empty()) {
    const auto found = graph.find(open.back());
    open.pop_back();
    if (found == graph.end()) continue;
    for (const std::string& next : found->second)
      if (reached.insert(next).second) open.push_back(next);
  }
  return reached;
}

bool is_split(std::string_view folder) {
  return std::ranges::any_of(
      kSplit, [&](std::string_view part) { return folder == part || lies_below(folder, part); });
}

/// The README that says what a folder is for: that of its room.
std::string readme_of(const std::string& folder) {
  const Room* room = room_of(folder + "/x");
  return std::string(room->path) + "/README.md";
}

}  // namespace

std::vector<Violation> check_folder_circles(std::span<const SourceFile> files) {
  const Graph graph = folder_includes(files);
  std::map<std::string, std::set<std::string>> reached;
  for (const auto& [folder, others] : graph) reached[folder] = reached_from(folder, graph);
  std::vector<Violation> violations;
  std::set<std::string> told;
  for (const auto& [folder, below] : reached) {
    if (!below.contains(folder) || !told.insert(folder).second) continue;
    std::string circle = "includes in a circle:";
    for (const std::string& other : below) {
      if (!reached[other].contains(folder)) continue;
      circle += " " + other;
      told.insert(other);
    }
    violations.push_back({folder, 0, circle});
  }
  return violations;
}

std::vector<Violation> check_folder_sizes(std::span<const SourceFile> files) {
  std::map<std::string, std::size_t> counts;
  for (const SourceFile& file : files)
    if (room_of(file.path) != nullptr) ++counts[folder_of(file.path)];
  std::vector<Violation> violations;
  for (const auto& [folder, count] : counts) {
    const std::size_t most = is_split(folder) ? kMostFilesOfSplitRooms : kMostFiles;
    if (count > most)
      violations.push_back({folder, 0,
                            "holds " + std::to_string(count) + " files, at most " +
                                std::to_string(most) + " are allowed"});
  }
  return violations;
}

std::vector<Violation> check_folder_purposes(std::span<const SourceFile> files,
                                             std::span<const SourceFile> documents) {
  std::map<std::string, std::string> texts;
  std::set<std::string> folders;
  for (const SourceFile& document : documents) texts[document.path] = document.text;
  for (const SourceFile& file : files) {
    const Room* room = room_of(file.path);
    if (room != nullptr && folder_of(file.path) != room->path) folders.insert(folder_of(file.path));
  }
  std::vector<Violation> violations;
  for (const std::string& folder : folders) {
    const std::string readme = readme_of(folder);
    const std::string name = folder.substr(folder_of(readme).size() + 1);
    if (texts[readme].find("| `" + name + "/`") == std::string::npos)
      violations.push_back({folder, 0, readme + " does not say what it is for"});
  }
  return violations;
}

}  // namespace loopscope::tests::architecture
