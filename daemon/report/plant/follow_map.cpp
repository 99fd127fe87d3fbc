#include "daemon/report/plant/follow_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <vector>

#include "core/text/phrases.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using storage::PlantLead;
using storage::PlantOscillationRow;

constexpr std::size_t kMostBoxes = 12;
constexpr double kWidth = 520.0;
constexpr double kBoxWidth = 206.0;  // "cascade master, 59.9 min behind"
constexpr double kBoxHeight = 36.0;
constexpr double kPitch = 46.0;  // from one row to the next
constexpr double kMargin = 4.0;
constexpr std::size_t kNameLength = 16;  // characters that fit into a box

struct Box {
  const PlantOscillationRow::Member* member = nullptr;
  std::size_t number = 0;  ///< in the list of members, from 1
};

/// Places in the order of the boxes.
struct Arrow {
  std::size_t from = 0;
  std::size_t to = 0;
  double gain = 0.0;
};

/// The members that are shaken most; the source, then by their lag.
std::vector<Box> boxes_of(const PlantOscillationRow& event) {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < std::min(kMostBoxes, event.members.size()); ++k)
    boxes.push_back({&event.members[k], k + 1});
  std::ranges::stable_sort(boxes, [](const Box& one, const Box& other) {
    const bool source = one.member->role == "source", other_source = other.member->role == "source";
    return source != other_source ? source : one.member->lag_s < other.member->lag_s;
  });
  return boxes;
}

/// What a loop tells of another one that no third one tells as well, where that could be found out:
/// else a loop that only passes the oscillation on seems to lead as much as its source.
double PlantLead::*shown_gain(const PlantOscillationRow& event) {
  const bool known = std::ranges::any_of(
      event.leads, [](double d) { return d > 0.0; }, &PlantLead::direct);
  return known ? &PlantLead::direct : &PlantLead::gain;
}

/// By how much more `from` foretells `to` than the other way round.
double net_gain(const PlantOscillationRow& event, std::int64_t from, std::int64_t to) {
  double PlantLead::*const gain = shown_gain(event);
  double net = 0.0;
  for (const PlantLead& lead : event.leads) {
    if (lead.from_loop_id == from && lead.to_loop_id == to) net += lead.*gain;
    if (lead.from_loop_id == to && lead.to_loop_id == from) net -= lead.*gain;
  }
  return net;
}

std::optional<Arrow> strongest_to(const PlantOscillationRow& event, const std::vector<Box>& boxes,
                                  std::size_t to) {
  std::optional<Arrow> strongest;
  for (std::size_t from = 0; from < boxes.size(); ++from) {
    const double gain = net_gain(event, boxes[from].member->loop_id, boxes[to].member->loop_id);
    if (from != to && gain > (strongest ? strongest->gain : 0.0)) strongest = {from, to, gain};
  }
  return strongest;
}

/// A step down, a step to the right.
struct Corner {
  double left = 0.0;
  double top = 0.0;
};

/// In pixels of the drawing.
std::string tenths(double length) {
  return fmt::format("{:.1f}", length);
}

class Stairs {
 public:
  explicit Stairs(std::size_t count)
      : step_(count > 1 ? (kWidth - kBoxWidth - 2.0 * kMargin) / static_cast<double>(count - 1)
                        : 0.0) {}

  [[nodiscard]] Corner corner(std::size_t place) const {
    return {kMargin + step_ * static_cast<double>(place),
            kMargin + kPitch * static_cast<double>(place)};
  }

  /// Down from a box and to the right into a later one; up and to the left into an earlier one. No
  /// line crosses a box.
  [[nodiscard]] Fields arrow(const Arrow& arrow, double share) const {
    const Corner from = corner(arrow.from), to = corner(arrow.to);
    const bool down = arrow.to > arrow.from;
    const double aside = std::min(14.0, 0.5 * step_);
    const double end = down ? to.left : to.left + kBoxWidth;
    const int back = down ? -7 : 7;
    return {{"x", tenths(down ? from.left + aside : from.left + kBoxWidth - aside)},
            {"begin", tenths(down ? from.top + kBoxHeight : from.top)},
            {"y", tenths(to.top + 0.5 * kBoxHeight + (down ? 5.0 : -5.0))},
            {"shaft_end", tenths(end + back)},
            {"thickness", tenths(1.0 + 2.0 * share)},
            {"end", tenths(end)},
            {"back", back}};
  }

 private:
  double step_;
};

/// By characters, not bytes.
std::string shortened(const std::string& name) {
  std::size_t characters = 0, at = 0;
  for (; at < name.size(); ++at) {
    const bool begins = (static_cast<unsigned char>(name[at]) & 0xC0U) != 0x80U;
    if (begins && ++characters > kNameLength) break;
  }
  return at < name.size() ? name.substr(0, at) + "\u2026" : name;
}

Fields box_fields(const Box& box, const Corner& corner, const PlantOscillationRow& event) {
  const bool source = box.member->role == "source";
  return {{"left", tenths(corner.left)},
          {"top", tenths(corner.top)},
          {"box_width", fmt::to_string(kBoxWidth)},
          {"box_height", fmt::to_string(kBoxHeight)},
          {"fill", source ? "#fbeee6" : "#ffffff"},
          {"stroke", source ? "#b34700" : "#a9b4c0"},
          {"text_left", tenths(corner.left + 7.0)},
          {"name_base", tenths(corner.top + 15.0)},
          {"number", static_cast<std::int64_t>(box.number)},
          {"name", shortened(box.member->loop_name)},
          {"words_base", tenths(corner.top + 29.0)},
          {"words", role_and_lag(*box.member, event)}};
}

List arrow_rows(const std::vector<Arrow>& arrows, const Stairs& stairs) {
  const double most = arrows.empty() ? 1.0 : std::ranges::max(arrows, {}, &Arrow::gain).gain;
  return rows(arrows, [&](const Arrow& arrow) { return stairs.arrow(arrow, arrow.gain / most); });
}

List box_rows(const std::vector<Box>& boxes, const Stairs& stairs,
              const PlantOscillationRow& event) {
  List made;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    made.push_back(box_fields(boxes[k], stairs.corner(k), event));
  return made;
}

}  // namespace

Markup follow_map(const PlantOscillationRow& event) {
  if (event.leads.empty()) return {};
  const std::vector<Box> boxes = boxes_of(event);
  const Stairs stairs(boxes.size());
  std::vector<Arrow> arrows;
  for (std::size_t to = 0; to < boxes.size(); ++to)
    if (const auto arrow = strongest_to(event, boxes, to)) arrows.push_back(*arrow);
  const double height = 2.0 * kMargin + kPitch * static_cast<double>(boxes.size() - 1) + kBoxHeight;
  return render("follow_map", {{"width", fmt::format("{:g}", kWidth)},
                               {"height", fmt::format("{:g}", height)},
                               {"arrows", arrow_rows(arrows, stairs)},
                               {"boxes", box_rows(boxes, stairs, event)}});
}

std::string lag_words(const storage::PlantOscillationRow::Member& member,
                      const storage::PlantOscillationRow& event) {
  if (!event.source_name || member.role == "source") return {};
  return core::text::duration(std::abs(member.lag_s)) + (member.lag_s < 0.0 ? " ahead" : " behind");
}

std::string role_words(std::string_view role) {
  return role == "victim" ? "affected loop" : in_words(role);
}

std::string role_and_lag(const storage::PlantOscillationRow::Member& member,
                         const storage::PlantOscillationRow& event) {
  const std::string lag = lag_words(member, event);
  return role_words(member.role) + (lag.empty() ? "" : ", " + lag);
}

}  // namespace loopscope::daemon
