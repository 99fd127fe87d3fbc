#include "core/plant/following.hpp"

#include <algorithm>
#include <cmath>

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kFewestInCommon = 8;
constexpr int kRounds = 8;

bool recorded(Complex z) {
  return std::isfinite(z.real());
}

/// Sums of x conj(y) over the points at which both loops are known now and one point before.
struct CrossSums {
  double zz = 0.0, rr = 0.0;       // now
  double zz1 = 0.0, rr1 = 0.0;     // before
  Complex zr = 0.0, zr1 = 0.0;     // now with now, before with before
  Complex z_z1 = 0.0, r_r1 = 0.0;  // now with before
  Complex z_r1 = 0.0, r_z1 = 0.0;
  std::size_t count = 0;

  void add(Complex z, Complex z1, Complex r, Complex r1) {
    zz += std::norm(z), rr += std::norm(r), zz1 += std::norm(z1), rr1 += std::norm(r1);
    zr += z * std::conj(r), zr1 += z1 * std::conj(r1);
    z_z1 += z * std::conj(z1), r_r1 += r * std::conj(r1);
    z_r1 += z * std::conj(r1), r_z1 += r * std::conj(z1);
    ++count;
  }

  /// Least squares of z - a z1 on r - a r1.
  [[nodiscard]] Complex gain(Complex a) const {
    const Complex cross = zr - std::conj(a) * z_r1 - a * std::conj(r_z1) + std::norm(a) * zr1;
    const double power = rr - 2.0 * std::real(std::conj(a) * r_r1) + std::norm(a) * rr1;
    return power > 0.0 ? cross / power : 0.0;
  }
  /// Of u = z - g r: sum u conj(u1), sum |u1|^2, sum |u|^2.
  [[nodiscard]] Complex turned(Complex g) const {
    return z_z1 - std::conj(g) * z_r1 - g * r_z1 + std::norm(g) * r_r1;
  }
  [[nodiscard]] double before(Complex g) const {
    return zz1 - 2.0 * std::real(std::conj(g) * zr1) + std::norm(g) * rr1;
  }
  [[nodiscard]] double now(Complex g) const {
    return zz - 2.0 * std::real(std::conj(g) * zr) + std::norm(g) * rr;
  }
  /// Of e, with the best a.
  [[nodiscard]] double left(Complex g) const {
    const double power = before(g);
    return now(g) - (power > 0.0 ? std::norm(turned(g)) / power : 0.0);
  }
  /// The same with the roles changed.
  [[nodiscard]] CrossSums turned_round() const {
    return {rr, zz, rr1, zz1, std::conj(zr), std::conj(zr1), r_r1, z_z1, r_z1, z_r1, count};
  }
};

/// Generalised least squares of z on r: (s1 / s0)^(n - 3).
double following_p(const CrossSums& sums) {
  const double alone = sums.left(0.0);
  if (!(alone > 0.0)) return 1.0;
  double least = alone;
  // From the loop's own rhythm and from none: the sum of squares may have two valleys.
  const Complex own = sums.zz1 > 0.0 ? sums.z_z1 / sums.zz1 : 0.0;
  for (Complex a : {own, Complex(0.0)})
    for (int round = 0; round < kRounds; ++round) {
      const Complex g = sums.gain(a);
      least = std::min(least, std::max(0.0, sums.left(g)));
      const double power = sums.before(g);
      if (!(power > 0.0)) break;
      a = sums.turned(g) / power;
    }
  return std::pow(least / alone, static_cast<double>(sums.count) - 3.0);
}

/// Calls `visit(z, z1, r, r1)` with the points in common, now and one before; unknown ones are NaN.
template <typename Visit>
void visit_pairs(const Envelope& envelope, const Envelope& course, Visit visit) {
  const std::int64_t from = std::max(envelope.first, course.first);
  const std::int64_t to = std::min(envelope.end(), course.end());
  for (std::int64_t j = from; j < to; ++j)
    visit(envelope.at(j), envelope.at(j - 1), course.at(j), course.at(j - 1));
}

}  // namespace

Following follow(const Envelope& envelope, const Envelope& course) {
  CrossSums sums;
  Complex cross = 0.0;
  double power = 0.0, own = 0.0, count = 0.0;
  visit_pairs(envelope, course, [&](Complex z, Complex z1, Complex r, Complex r1) {
    if (!recorded(z) || !recorded(r)) return;
    cross += z * std::conj(r), power += std::norm(r), own += std::norm(z), count += 1.0;
    if (recorded(z1) && recorded(r1)) sums.add(z, z1, r, r1);
  });
  Following result;
  result.points = sums.count;
  if (sums.count < kFewestInCommon || !(power > 0.0)) return result;
  result.p = std::min(1.0, 2.0 * std::min(following_p(sums), following_p(sums.turned_round())));
  result.gain = cross / power;
  result.followed = std::norm(cross) / power / count;
  result.rest = std::max(0.0, own / count - result.followed);
  return result;
}

}  // namespace loopscope::core::plant
