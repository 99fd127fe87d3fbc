#pragma once

namespace loopscope::daemon {

/// A file of this folder that stands in every page, compiled in by embed_page.cmake.
struct PageAsset {
  const char* text;
  const char* sha256;  ///< of its text, 64 hexadecimal digits
};

[[nodiscard]] PageAsset page_style();
[[nodiscard]] PageAsset page_script();

}  // namespace loopscope::daemon
