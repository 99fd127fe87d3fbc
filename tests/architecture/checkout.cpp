#include "tests/architecture/checkout.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string_view>

#include "tests/support/source_dir.hpp"

namespace loopscope::tests::architecture {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kFolders = {"core",   "config", "storage",
                                                      "daemon", "deploy", "tests"};
constexpr std::array<std::string_view, 8> kSourceSuffixes = {".hpp", ".cpp", ".inc",   ".sql",
                                                             ".sh",  ".py",  ".cmake", ".txt"};

std::string content(const fs::path& file) {
  const std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

bool is_source(const fs::path& file) {
  const std::string suffix = file.extension().string();
  return std::find(kSourceSuffixes.begin(), kSourceSuffixes.end(), suffix) != kSourceSuffixes.end();
}

std::vector<SourceFile> files_that(const std::function<bool(const fs::path&)>& wanted) {
  std::vector<SourceFile> files;
  const fs::path root = source_dir();
  for (const std::string_view folder : kFolders) {
    if (!fs::is_directory(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() && wanted(entry.path()))
        files.push_back(
            {entry.path().lexically_relative(root).generic_string(), content(entry.path())});
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::vector<SourceFile> source_files() {
  return files_that(is_source);
}

std::vector<SourceFile> documents() {
  std::vector<SourceFile> files =
      files_that([](const fs::path& file) { return file.extension() == ".md"; });
  for (const char* top : {"CONTRIBUTING.md", "README.md"})
    files.push_back({top, content(fs::path(source_dir()) / top)});
  return files;
}

std::vector<std::string> top_level_folders() {
  std::vector<std::string> folders;
  for (const auto& entry : fs::directory_iterator(source_dir())) {
    const std::string name = entry.path().filename().string();
    const bool ignored = name.starts_with('.') || name == "build" || name.starts_with("build-");
    if (entry.is_directory() && !ignored) folders.push_back(name);
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string listing(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations) {
    text += violation.file;
    if (violation.line > 0) text += ":" + std::to_string(violation.line);
    text += ": " + violation.message + "\n";
  }
  return text;
}

}  // namespace loopscope::tests::architecture
