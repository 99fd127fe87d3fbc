#include "tests/plants/network/draw_streams.hpp"

namespace loopscope::tests::network {
namespace {

using effects::Random;

class Drawing {
 public:
  explicit Drawing(Random& random) : random_(random) {}

  void flow(std::size_t from, std::size_t to, double lag_s, double delay_s) {
    add(from, to, false, random_.log_uniform(0.1, 0.6), lag_s, delay_s);
  }
  void pv(std::size_t from, std::size_t to, double lag_s, double delay_s) {
    add(from, to, true, random_.log_uniform(0.1, 0.5), lag_s, delay_s);
  }
  [[nodiscard]] std::vector<Stream> take() { return std::move(streams_); }

 private:
  /// Not every pipe is there.
  static constexpr double kThere = 0.75;

  void add(std::size_t from, std::size_t to, bool carries_pv, double gain, double lag_s,
           double delay_s) {
    const double lag = lag_s * random_.log_uniform(0.5, 2.0);
    const double delay = delay_s * random_.log_uniform(0.5, 2.0);
    gain *= random_.sign();
    if (random_.chance(kThere)) streams_.push_back({from, to, carries_pv, gain, lag, delay});
  }

  Random& random_;
  std::vector<Stream> streams_;
};

void within(const Unit& unit, Drawing& draw) {
  draw.flow(unit.feed, unit.level, 2.0, 1.0);
  draw.flow(unit.feed, unit.temperature, 20.0, 5.0);
  draw.flow(unit.feed, unit.pressure, 5.0, 2.0);
  draw.flow(unit.steam, unit.temperature, 5.0, 2.0);
  draw.flow(unit.steam, unit.pressure, 8.0, 2.0);
  draw.pv(unit.pressure, unit.steam, 0.5, 0.4);
  draw.pv(unit.pressure, unit.feed, 0.5, 0.4);
  draw.pv(unit.pressure, unit.outflow, 0.5, 0.4);
  draw.flow(unit.outflow, unit.level, 1.0, 0.4);
  draw.flow(unit.level, unit.outflow, 1.0, 0.4);
  draw.flow(unit.reflux, unit.temperature, 10.0, 5.0);
  draw.flow(unit.reflux, unit.level, 10.0, 5.0);
  draw.pv(unit.temperature, unit.pressure, 15.0, 5.0);
  draw.pv(unit.pressure, unit.reflux, 2.0, 1.0);
}

void between(const Unit& from, const Unit& to, Drawing& draw, double way_s) {
  draw.flow(from.outflow, to.level, 3.0, way_s);
  draw.flow(from.level, to.level, 3.0, way_s);
  draw.flow(from.outflow, to.pressure, 5.0, way_s);
  draw.flow(from.outflow, to.temperature, 15.0, way_s);
  draw.pv(from.temperature, to.temperature, 20.0, 3.0 * way_s);
  draw.pv(from.pressure, to.pressure, 3.0, 0.5 * way_s);
  draw.pv(from.pressure, to.feed, 1.0, 0.5 * way_s);
}

}  // namespace

std::vector<Stream> draw_streams(const std::vector<Unit>& units, std::size_t steam,
                                 std::size_t feed, Random& random) {
  Drawing draw(random);
  for (std::size_t i = 0; i < units.size(); ++i) {
    within(units[i], draw);
    draw.pv(steam, units[i].steam, 1.0, 0.6);
    draw.flow(units[i].steam, steam, 3.0, 0.6);
    draw.pv(feed, units[i].feed, 1.0, 0.6);
    draw.flow(units[i].feed, feed, 3.0, 0.6);
    if (i > 0) between(units[i - 1], units[i], draw, 6.0);
  }
  // The recycle: a long way back.
  between(units.back(), units.front(), draw, 40.0);
  draw.flow(units.back().reflux, units.front().feed, 10.0, 30.0);
  draw.flow(units.back().temperature, units.front().temperature, 10.0, 30.0);
  return draw.take();
}

}  // namespace loopscope::tests::network
