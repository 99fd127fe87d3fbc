#pragma once

// Everything that the headers which are compiled for each kind of processor include and that is
// compiled once: lane_basis.hpp says why it has to be named before them.
#include "core/model/fit/batched/lane_kernel.hpp"
#include "core/model/record/loop_data.hpp"
#include "core/model/response/noise_model.hpp"
#include "core/model/response/process_shape.hpp"
#include "core/model/valve_law/stem_friction.hpp"
#include "core/model/valve_law/valve_law.hpp"
#include "core/model/vectors/lane_basis.hpp"
