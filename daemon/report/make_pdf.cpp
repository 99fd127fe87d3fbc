#include "daemon/report/make_pdf.hpp"

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>

#include "daemon/report/programs/run_child.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::chrono::minutes kPatience{10};

}  // namespace

std::filesystem::path find_pdf_engine() {
  const char* path = std::getenv("PATH");
  if (const auto program = find_program("weasyprint", path == nullptr ? "" : path)) return *program;
  throw Failure(ExitCode::configuration,
                "weasyprint, which makes the PDF, is not there or may not be started",
                "apt-get install weasyprint, and let the unit start it (examples/reports.conf); or "
                "print report.html from a browser");
}

std::string make_pdf(const std::string& page, const std::filesystem::path& engine,
                     const std::stop_token& stop) {
  ChildResult result = run_child({engine, {"--quiet", "-", "-"}, page, kPatience}, stop);
  if (result.exit_code == 0 && result.out.starts_with("%PDF")) return std::move(result.out);
  throw Failure(ExitCode::fault,
                result.out_of_time ? std::string("weasyprint did not end in time, PDF")
                                   : fmt::format("weasyprint failed (exit code {}), PDF: {}",
                                                 result.exit_code, result.complaint),
                "run `weasyprint report.html report.pdf`; Debian's package weasyprint is what the "
                "page is made for");
}

}  // namespace loopscope::daemon
