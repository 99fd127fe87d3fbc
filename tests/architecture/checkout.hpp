#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace loopscope::tests::architecture {

/// One source file of the checkout.
struct SourceFile {
  std::string path;  ///< from the root of the checkout, with '/'
  std::string text;
};

/// A broken rule.
struct Violation {
  std::string file;
  std::size_t line = 0;  ///< from 1; 0 = the file or folder as a whole
  std::string message;
};

/// Every source file below the rooms and tests/, in the order of their paths.
[[nodiscard]] std::vector<SourceFile> source_files();

/// Every Markdown file below the rooms and tests/, in the order of their paths, then the two at
/// the top that tell of the code.
[[nodiscard]] std::vector<SourceFile> documents();

/// The folders at the top of the checkout without the hidden ones and the build folders that
/// .gitignore names.
[[nodiscard]] std::vector<std::string> top_level_folders();

/// The lines of a text, without their ends.
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

/// "file:line: message" of each, one a line.
[[nodiscard]] std::string listing(const std::vector<Violation>& violations);

}  // namespace loopscope::tests::architecture
