#include "core/hos/transforms/paired_fft.hpp"

#include <cassert>
#include <fftw3.h>
#include <new>

#include "core/hos/kernels/aligned.hpp"
#include "core/hos/kernels/plan_cache.hpp"

namespace loopscope::core::hos {
namespace {

// FFTW's complex type is an array of two doubles, which is what the buffers hold.
fftw_complex* as_complex(double* values) {
  return reinterpret_cast<fftw_complex*>(values);
}

}  // namespace

struct PairedFft::Plan {
  fftw_plan handle = nullptr;
};

const PairedFft& PairedFft::of_length(std::size_t length) {
  return cached_plan<PairedFft>(length);
}

PairedFft::PairedFft(std::size_t length) : length_(length), plan_(std::make_unique<Plan>()) {
  AlignedVector input(buffer_size());
  AlignedVector output(buffer_size());
  const int samples = static_cast<int>(length);
  plan_->handle =
      fftw_plan_many_dft(1, &samples, static_cast<int>(kBatch / 2), as_complex(input.data()),
                         nullptr, 1, samples, as_complex(output.data()), nullptr, 1, samples,
                         FFTW_FORWARD, FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
  if (plan_->handle == nullptr) {
    throw std::bad_alloc();
  }
}

PairedFft::~PairedFft() {
  if (plan_->handle != nullptr) {
    fftw_destroy_plan(plan_->handle);
  }
}

void PairedFft::execute(std::span<double> input, std::span<double> output) const {
  assert(input.size() == buffer_size() && output.size() == buffer_size());
  fftw_execute_dft(plan_->handle, as_complex(input.data()), as_complex(output.data()));
}

}  // namespace loopscope::core::hos
