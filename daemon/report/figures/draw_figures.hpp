#pragma once

#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "daemon/report/figures/figure.hpp"

namespace loopscope::daemon {

/// The plotting program on PATH. Throws Failure (configuration) naming its package when there is
/// none.
[[nodiscard]] std::filesystem::path find_gnuplot();

/// Draws figures with one run of gnuplot, scripts in and pictures out through pipes, so that no
/// file is left behind. The pictures are SVG that a browser and WeasyPrint read alike. Throws
/// Failure (fault) with gnuplot's words when it fails or cannot be started, when it takes longer
/// than half a minute and when `stop` is requested. One picture a figure.
[[nodiscard]] std::vector<Picture> draw_figures(std::span<const Figure> figures,
                                                const std::filesystem::path& gnuplot,
                                                const std::stop_token& stop = {});

/// The SVG documents of gnuplot's output, one after the other, made compact.
[[nodiscard]] std::vector<std::string> split_svg(const std::string& output);

}  // namespace loopscope::daemon
