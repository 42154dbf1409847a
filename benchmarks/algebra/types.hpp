// SPDX-License-Identifier: MIT
// Short names for the types that the rows are made of. Static frames stand where the frames agree
// and are known to.
#pragma once

#include <malus/analyzer.hpp>
#include <malus/importance.hpp>
#include <malus/mueller.hpp>
#include <malus/stokes.hpp>

#include "inputs.hpp"

namespace types {

using malus::exitant;
using malus::ImportanceForm;
using malus::incident;
using malus::MuellerForm;
using malus::StokesForm;

template <class T>
using Moving = malus::Frame<T>;
template <class T>
using Shared = inputs::SharedFrame<T>;

template <class T, StokesForm Form, class F = Moving<T>, class Side = incident>
using Light = malus::Stokes<inputs::Rgb<T>, Side, F, Form>;

/// Light that arrives to light that leaves.
template <class T, MuellerForm Form, class F = Moving<T>>
using Scatter = malus::Mueller<inputs::Rgb<T>, incident, exitant, F, F, Form>;

/// Light that leaves to light that arrives.
template <class T, MuellerForm Form, class F = Moving<T>>
using Transmit = malus::Mueller<inputs::Rgb<T>, exitant, incident, F, F, Form>;

template <class T, ImportanceForm Form>
using Weight = malus::Importance<inputs::Rgb<T>, exitant, Moving<T>, Form>;

template <class T, StokesForm Form>
using Filter = malus::Analyzer<inputs::Rgb<T>, exitant, Moving<T>, Form>;

}  // namespace types
