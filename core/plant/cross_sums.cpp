#include "core/plant/cross_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace loopscope::core::plant {
namespace {

using Complex = std::complex<double>;

/// Sums that the compiler may carry side by side; the same order on every kind of processor.
constexpr std::size_t kLanes = 4;

struct Lanes {
  std::array<double, kLanes> of{};

  [[nodiscard]] double total() const { return (of[0] + of[1]) + (of[2] + of[3]); }
};

/// Of x conj(y).
struct ProductLanes {
  Lanes real, imaginary;

  void add(std::size_t lane, double xr, double xi, double yr, double yi) {
    real.of[lane] += xr * yr + xi * yi;
    imaginary.of[lane] += xi * yr - xr * yi;
  }
  [[nodiscard]] Complex total() const { return {real.total(), imaginary.total()}; }
};

/// The points in common, real and imaginary parts apart; 0 where either envelope is unknown, and
/// one 0 before the first.
class CommonPoints {
 public:
  CommonPoints(const Envelope& z, const Envelope& r) {
    const std::int64_t from = std::max(z.first, r.first);
    const auto size =
        static_cast<std::size_t>(std::max<std::int64_t>(0, std::min(z.end(), r.end()) - from));
    // Lanes of zeros at the end need no loop of their own.
    stride_ = (size + kLanes) / kLanes * kLanes + kLanes;
    parts_.assign(4 * stride_, 0.0);
    if (size == 0) return;
    const auto* const z_points = &z.points[static_cast<std::size_t>(from - z.first)];
    const auto* const r_points = &r.points[static_cast<std::size_t>(from - r.first)];
    for (std::size_t k = 0; k < size; ++k) put(k, Complex(z_points[k]), Complex(r_points[k]));
    end_run(size);
  }

  [[nodiscard]] EnvelopeSums sums() const {
    Lanes zz, rr;
    ProductLanes zr, z_z1, r_r1, z_r1, r_z1;
    const double *zx = part(0), *zy = part(1), *rx = part(2), *ry = part(3);
    for (std::size_t k = 1; k + kLanes <= stride_; k += kLanes)
      for (std::size_t i = 0; i < kLanes; ++i) {
        const std::size_t now = k + i, before = now - 1;
        zz.of[i] += zx[now] * zx[now] + zy[now] * zy[now];
        rr.of[i] += rx[now] * rx[now] + ry[now] * ry[now];
        zr.add(i, zx[now], zy[now], rx[now], ry[now]);
        z_z1.add(i, zx[now], zy[now], zx[before], zy[before]);
        r_r1.add(i, rx[now], ry[now], rx[before], ry[before]);
        z_r1.add(i, zx[now], zy[now], rx[before], ry[before]);
        r_z1.add(i, rx[now], ry[now], zx[before], zy[before]);
      }
    EnvelopeSums sums;
    sums.points = {zr.total(), zz.total(), rr.total(), known_};
    CrossSums& pairs = sums.pairs;
    pairs = {sums.points.zz - firsts_.zz,
             sums.points.rr - firsts_.rr,
             sums.points.zz - lasts_.zz,
             sums.points.rr - lasts_.rr,
             sums.points.zr - firsts_.zr,
             sums.points.zr - lasts_.zr,
             z_z1.total(),
             r_r1.total(),
             z_r1.total(),
             r_z1.total(),
             known_ - firsts_.count};
    return sums;
  }

 private:
  [[nodiscard]] const double* part(std::size_t number) const { return &parts_[number * stride_]; }

  void put(std::size_t k, Complex z, Complex r) {
    if (!std::isfinite(z.real()) || !std::isfinite(r.real())) {
      end_run(k);
      return;
    }
    parts_[k + 1] = z.real(), parts_[stride_ + k + 1] = z.imag();
    parts_[2 * stride_ + k + 1] = r.real(), parts_[3 * stride_ + k + 1] = r.imag();
    if (run_ == 0) add(firsts_, k);
    ++run_, ++known_;
  }
  /// Of points that follow each other, behind point k - 1.
  void end_run(std::size_t k) {
    if (run_ > 0) add(lasts_, k - 1);
    run_ = 0;
  }
  void add(PointSums& sums, std::size_t k) const {
    const Complex z(part(0)[k + 1], part(1)[k + 1]), r(part(2)[k + 1], part(3)[k + 1]);
    sums.zr += z * std::conj(r);
    sums.zz += std::norm(z), sums.rr += std::norm(r);
    ++sums.count;
  }

  std::size_t stride_ = 0;
  std::vector<double> parts_;  // of z and r, real and imaginary by turns
  std::size_t known_ = 0, run_ = 0;
  PointSums firsts_, lasts_;  // of the runs: without a point before, without one behind
};

}  // namespace

EnvelopeSums sum_over_common(const Envelope& z, const Envelope& r) {
  return CommonPoints(z, r).sums();
}

}  // namespace loopscope::core::plant
