#include "core/hos/record_fft.hpp"

#include <fftw3.h>
#include <new>

#include "core/hos/plan_cache.hpp"

namespace loopscope::core::hos {
namespace {

fftw_complex* as_complex(std::complex<double>* values) {
  return reinterpret_cast<fftw_complex*>(values);
}

}  // namespace

struct RecordFft::Plan {
  fftw_plan handle = nullptr;
};

const RecordFft& RecordFft::of_length(std::size_t length) {
  return cached_plan<RecordFft>(length);
}

RecordFft::RecordFft(std::size_t length) : length_(length), plan_(std::make_unique<Plan>()) {
  std::vector<double> input(length);
  std::vector<std::complex<double>> output(length / 2 + 1);
  // Estimated, so that two runs on one processor give the same digits; unaligned, since the records
  // are ordinary vectors.
  plan_->handle =
      fftw_plan_dft_r2c_1d(static_cast<int>(length), input.data(), as_complex(output.data()),
                           FFTW_ESTIMATE | FFTW_UNALIGNED | FFTW_PRESERVE_INPUT);
  if (plan_->handle == nullptr) throw std::bad_alloc();
}

RecordFft::~RecordFft() {
  if (plan_->handle != nullptr) fftw_destroy_plan(plan_->handle);
}

std::vector<std::complex<double>> RecordFft::transform(std::vector<double> record) const {
  record.resize(length_, 0.0);
  std::vector<std::complex<double>> result(length_ / 2 + 1);
  fftw_execute_dft_r2c(plan_->handle, record.data(), as_complex(result.data()));
  return result;
}

}  // namespace loopscope::core::hos
