#include "tests/architecture/document_rules.hpp"

#include <algorithm>
#include <regex>
#include <string>

namespace loopscope::tests::architecture {

namespace {

namespace fs = std::filesystem;

bool is_pattern(const std::string& path) {
  static const std::regex capitals("(NAME|NNNN|KIND|FILE|DIR)");
  return std::regex_search(path, capitals);
}

/// Whether a file beside it is called so but for its ending.
bool is_stem(const fs::path& path) {
  if (!fs::is_directory(path.parent_path())) return false;
  const std::string stem = path.filename().string() + ".";
  return std::ranges::any_of(fs::directory_iterator(path.parent_path()), [&](const auto& entry) {
    return entry.path().filename().string().starts_with(stem);
  });
}

std::vector<std::string> matches(const std::string& line, const std::regex& wanted) {
  std::vector<std::string> found;
  for (std::sregex_iterator at(line.begin(), line.end(), wanted), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

}  // namespace

std::vector<Violation> check_paths(std::span<const SourceFile> documents, const fs::path& root) {
  static const std::regex link_of(R"(\]\(([^)#: ]+)(?:#[^)]*)?\))");
  static const std::regex path_of(
      "`((?:core|config|storage|daemon|deploy|tests)/[A-Za-z0-9_./-]+)`");
  std::vector<Violation> violations;
  for (const SourceFile& document : documents) {
    const fs::path folder = root / fs::path(document.path).parent_path();
    const std::vector<std::string> lines = lines_of(document.text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const std::string& link : matches(lines[i], link_of))
        if (!fs::exists(folder / link))
          violations.push_back({document.path, i + 1, "the link " + link + " leads nowhere"});
      for (const std::string& path : matches(lines[i], path_of))
        if (!is_pattern(path) && !fs::exists(root / path) && !is_stem(root / path))
          violations.push_back({document.path, i + 1, path + " does not exist"});
    }
  }
  return violations;
}

}  // namespace loopscope::tests::architecture
