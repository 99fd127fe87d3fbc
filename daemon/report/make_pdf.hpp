#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

namespace loopscope::daemon {

/// The program that turns a page into a PDF, on PATH. Throws Failure (configuration) naming its
/// package when there is none.
[[nodiscard]] std::filesystem::path find_pdf_engine();

/// A page as PDF, through pipes. Throws Failure (fault) with the engine's words when it fails or
/// takes longer than ten minutes, std::system_error when it cannot be started.
[[nodiscard]] std::string make_pdf(const std::string& page, const std::filesystem::path& engine,
                                   const std::stop_token& stop = {});

}  // namespace loopscope::daemon
