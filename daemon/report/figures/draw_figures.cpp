#include "daemon/report/figures/draw_figures.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <system_error>

#include "daemon/report/figures/compact_svg.hpp"
#include "daemon/report/figures/gnuplot_text.hpp"
#include "daemon/report/programs/run_child.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::string_view kDocument = "<?xml";

std::string script_of(std::span<const Figure> figures) {
  std::string script = "set encoding utf8\n";
  for (const Figure& figure : figures) {
    script += picture_start(figure.width, figure.height) + figure.script;
  }
  return script;
}

[[noreturn]] void refuse(const ChildResult& result) {
  constexpr const char* kHint =
      "run `gnuplot --version`; Debian's package gnuplot-nox is what the pictures are made for";
  if (result.out_of_time)
    throw Failure(ExitCode::fault, "gnuplot did not end in time, pictures", kHint);
  throw Failure(ExitCode::fault,
                fmt::format("gnuplot failed (exit code {}), pictures{}{}", result.exit_code,
                            result.complaint.empty() ? "" : ": ", result.complaint),
                kHint);
}

ChildResult run_gnuplot(const ChildCommand& command, const std::stop_token& stop) {
  try {
    return run_child(command, stop);
  } catch (const std::system_error& error) {
    throw Failure(ExitCode::fault, std::string("gnuplot cannot be started: ") + error.what(),
                  "memory or processes of this user have run out: end what is not needed");
  }
}

}  // namespace

std::filesystem::path find_gnuplot() {
  const char* path = std::getenv("PATH");
  if (const auto program = find_program("gnuplot", path == nullptr ? "" : path)) return *program;
  throw Failure(
      ExitCode::configuration,
      "gnuplot, which draws the pictures, is not there or may not be started",
      "apt-get install gnuplot-nox, and let the unit start it (examples/reports.conf); or "
      "ask for a report without pictures: --no-pictures");
}

std::vector<std::string> split_svg(const std::string& output) {
  std::vector<std::string> documents;
  for (std::size_t begin = output.find(kDocument); begin != std::string::npos;) {
    const std::size_t end = output.find(kDocument, begin + 1);
    documents.push_back(compact_svg(std::string_view(output).substr(begin, end - begin)));
    begin = end;
  }
  return documents;
}

std::vector<Picture> draw_figures(std::span<const Figure> figures,
                                  const std::filesystem::path& gnuplot,
                                  const std::stop_token& stop) {
  const std::string script = script_of(figures);
  // Neither the user's settings nor the system's: they could hold anything.
  const ChildResult result =
      run_gnuplot({gnuplot, {"--default-settings", kInputName}, script}, stop);
  const std::vector<std::string> documents = split_svg(result.out);
  if (result.exit_code != 0 || documents.size() != figures.size()) refuse(result);
  std::vector<Picture> pictures;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const Figure& figure = figures[k];
    pictures.push_back(
        {figure.title, figure.alt, documents[k], figure.width, figure.height, figure.whole_window});
  }
  return pictures;
}

}  // namespace loopscope::daemon
