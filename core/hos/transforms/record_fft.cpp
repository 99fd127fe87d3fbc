#include "core/hos/transforms/record_fft.hpp"

#include <fftw3.h>
#include <new>

#include "core/hos/kernels/plan_cache.hpp"

namespace loopscope::core::hos {
namespace {

// What the vector instructions of FFTW ask for (`fftw_alignment_of`); plans for any alignment
// do without them and take twice as long.
static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= 16);

fftw_complex* as_complex(std::complex<double>* values) {
  return reinterpret_cast<fftw_complex*>(values);
}

}  // namespace

struct RecordFft::Plan {
  fftw_plan forward = nullptr;
  fftw_plan backward = nullptr;
};

const RecordFft& RecordFft::of_length(std::size_t length) {
  return cached_plan<RecordFft>(length);
}

RecordFft::RecordFft(std::size_t length) : length_(length), plan_(std::make_unique<Plan>()) {
  std::vector<double> input(length);
  std::vector<std::complex<double>> output(length / 2 + 1);
  // Estimated, so that two runs on one processor give the same digits. For the alignment of these
  // two, which that of every vector is.
  const int samples = static_cast<int>(length);
  plan_->forward = fftw_plan_dft_r2c_1d(samples, input.data(), as_complex(output.data()),
                                        FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  plan_->backward = fftw_plan_dft_c2r_1d(samples, as_complex(output.data()), input.data(),
                                         FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  if (plan_->forward == nullptr || plan_->backward == nullptr) throw std::bad_alloc();
}

RecordFft::~RecordFft() {
  for (const fftw_plan plan : {plan_->forward, plan_->backward}) {
    if (plan != nullptr) fftw_destroy_plan(plan);
  }
}

std::vector<std::complex<double>> RecordFft::transform(std::vector<double> record) const {
  record.resize(length_, 0.0);
  std::vector<std::complex<double>> result(length_ / 2 + 1);
  fftw_execute_dft_r2c(plan_->forward, record.data(), as_complex(result.data()));
  return result;
}

std::vector<double> RecordFft::inverse(std::vector<std::complex<double>> spectrum) const {
  std::vector<double> record(length_);
  fftw_execute_dft_c2r(plan_->backward, as_complex(spectrum.data()), record.data());
  for (double& value : record) value /= static_cast<double>(length_);
  return record;
}

}  // namespace loopscope::core::hos
