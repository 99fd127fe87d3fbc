#pragma once

// Everything that the headers which are compiled for each kind of processor include and that is
// compiled once: lane_basis.hpp says why it has to be named before them.
#include "core/model/lane_basis.hpp"
#include "core/model/lane_kernel.hpp"
#include "core/model/loop_data.hpp"
#include "core/model/noise_model.hpp"
#include "core/model/op_step.hpp"
#include "core/model/process_shape.hpp"
#include "core/model/stem_friction.hpp"
#include "core/model/valve_law.hpp"
