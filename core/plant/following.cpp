#include "core/plant/following.hpp"

#include <algorithm>
#include <cmath>

#include "core/plant/cross_sums.hpp"

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kFewestInCommon = 8;
constexpr int kRounds = 8;
/// Of a, which is of the order of 1: what is left of it changes no p of a thousand points.
constexpr double kSettled = 1e-12;

/// What is left of one series, z, when the other, r, and its own past are taken off.
class CochraneOrcutt {
 public:
  explicit CochraneOrcutt(const CrossSums& sums) : s_(sums) {}

  /// Least squares of z - a z1 on r - a r1.
  [[nodiscard]] Complex gain(Complex a) const {
    const Complex cross =
        s_.zr - std::conj(a) * s_.z_r1 - a * std::conj(s_.r_z1) + std::norm(a) * s_.zr1;
    const double power = s_.rr - 2.0 * std::real(std::conj(a) * s_.r_r1) + std::norm(a) * s_.rr1;
    return power > 0.0 ? cross / power : 0.0;
  }
  /// Of u = z - g r: sum u conj(u1), sum |u1|^2, sum |u|^2.
  [[nodiscard]] Complex turned(Complex g) const {
    return s_.z_z1 - std::conj(g) * s_.z_r1 - g * s_.r_z1 + std::norm(g) * s_.r_r1;
  }
  [[nodiscard]] double before(Complex g) const {
    return s_.zz1 - 2.0 * std::real(std::conj(g) * s_.zr1) + std::norm(g) * s_.rr1;
  }
  [[nodiscard]] double now(Complex g) const {
    return s_.zz - 2.0 * std::real(std::conj(g) * s_.zr) + std::norm(g) * s_.rr;
  }
  /// Of e, with the best a.
  [[nodiscard]] double left(Complex g) const {
    const double power = before(g);
    return now(g) - (power > 0.0 ? std::norm(turned(g)) / power : 0.0);
  }

 private:
  const CrossSums& s_;
};

/// The same with the roles changed.
CrossSums turned_round(const CrossSums& s) {
  return {s.rr,   s.zz,   s.rr1,  s.zz1,  std::conj(s.zr), std::conj(s.zr1),
          s.r_r1, s.z_z1, s.r_z1, s.z_r1, s.count};
}

/// Generalised least squares of z on r: (s1 / s0)^(n - 3).
double following_p(const CrossSums& sums) {
  const CochraneOrcutt regression(sums);
  const double alone = regression.left(0.0);
  if (!(alone > 0.0)) return 1.0;
  double least = alone;
  // From the loop's own rhythm and from none: the sum of squares may have two valleys.
  const Complex own = sums.zz1 > 0.0 ? sums.z_z1 / sums.zz1 : 0.0;
  for (Complex a : {own, Complex(0.0)})
    for (int round = 0; round < kRounds; ++round) {
      const Complex g = regression.gain(a);
      least = std::min(least, std::max(0.0, regression.left(g)));
      const double power = regression.before(g);
      if (!(power > 0.0)) break;
      const Complex next = regression.turned(g) / power;
      const bool settled = std::norm(next - a) < kSettled * kSettled;
      a = next;
      if (settled) break;
    }
  return std::pow(least / alone, static_cast<double>(sums.count) - 3.0);
}

}  // namespace

Following follow(const Envelope& envelope, const Envelope& course) {
  const auto [pairs, points] = sum_over_common(envelope, course);
  Following result;
  result.points = pairs.count;
  if (pairs.count < kFewestInCommon || !(points.rr > 0.0)) return result;
  result.p = std::min(1.0, 2.0 * std::min(following_p(pairs), following_p(turned_round(pairs))));
  result.gain = points.zr / points.rr;
  result.followed = std::norm(points.zr) / points.rr / static_cast<double>(points.count);
  result.rest = std::max(0.0, points.zz / static_cast<double>(points.count) - result.followed);
  return result;
}

}  // namespace loopscope::core::plant
