#pragma once

#include <span>

namespace loopscope::daemon {

/// What stands in a page as it is, compiled in by embed_page.cmake.
struct PageAsset {
  const char* text;
  const char* sha256;  ///< of its text, 64 hexadecimal digits
};

[[nodiscard]] PageAsset page_style();
[[nodiscard]] PageAsset page_script();
/// Of a loop's live page alone: the files of trend/, one behind the other.
[[nodiscard]] PageAsset trend_script();

/// A file of templates/, compiled in by embed_page.cmake.
struct PageTemplate {
  const char* name;  ///< of the file, without ending
  const char* text;
};

[[nodiscard]] std::span<const PageTemplate> page_templates();

}  // namespace loopscope::daemon
