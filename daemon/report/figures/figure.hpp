#pragma once

#include <string>

namespace loopscope::daemon {

/// One picture of a page: what gnuplot draws, and what a reader is told beside it. `script` holds
/// numbers and words of this program only, never a name, a tag or a unit that somebody typed:
/// those stand in the page.
struct Figure {
  std::string title;  ///< caption, plain text
  std::string alt;    ///< what it shows, plain text, for those who cannot see it
  std::string
      script;        ///< of gnuplot: its data blocks and one plot, on a canvas `width` by `height`
  int width = 520;   ///< CSS pixels
  int height = 320;  ///< CSS pixels
  bool whole_window = false;  ///< a live page shows a trend that can be zoomed in its place
};

/// A drawn figure.
struct Picture {
  std::string title;
  std::string alt;
  std::string svg;
  int width = 0;
  int height = 0;
  bool whole_window = false;  ///< as of its figure
};

}  // namespace loopscope::daemon
