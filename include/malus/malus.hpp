// SPDX-License-Identifier: MIT
// Malus: polarised light transport with frames and sides in the types. The umbrella: includes only.
#pragma once

#include <malus/adjoint.hpp>
#include <malus/analysis/decomposition.hpp>
#include <malus/analysis/four_filters.hpp>
#include <malus/analysis/physicality.hpp>
#include <malus/analysis/polarization_state.hpp>
#include <malus/analyzer.hpp>
#include <malus/change_frame.hpp>
#include <malus/config.hpp>
#include <malus/equality.hpp>
#include <malus/error.hpp>
#include <malus/form.hpp>
#include <malus/frame.hpp>
#include <malus/fwd.hpp>
#include <malus/importance.hpp>
#include <malus/measurement.hpp>
#include <malus/mueller.hpp>
#include <malus/optics/depolarizer.hpp>
#include <malus/optics/diattenuator.hpp>
#include <malus/optics/frames.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/optics/microfacet.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/optics/rotator.hpp>
#include <malus/optics/turned.hpp>
#include <malus/path_sweep.hpp>
#include <malus/product.hpp>
#include <malus/propagate.hpp>
#include <malus/radiometry.hpp>
#include <malus/side.hpp>
#include <malus/spaces.hpp>
#include <malus/spectrum.hpp>
#include <malus/stokes.hpp>
#include <malus/sum.hpp>
