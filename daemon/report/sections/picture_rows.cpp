#include "daemon/report/sections/picture_rows.hpp"

#include "daemon/report/figures/compact_svg.hpp"

namespace loopscope::daemon {
namespace {

Fields picture_fields(const Picture& picture) {
  return {{"title", picture.title}, {"src", svg_uri(picture.svg)},
          {"width", picture.width}, {"height", picture.height},
          {"alt", picture.alt},     {"whole_window", picture.whole_window}};
}

}  // namespace

List picture_rows(std::span<const Picture> pictures) {
  return rows(pictures, picture_fields);
}

}  // namespace loopscope::daemon
