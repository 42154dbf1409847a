// SPDX-License-Identifier: MIT
// The operations that are measured, one file a kind.
#pragma once

namespace operations {

template <class T>
void add_stokes_rows();
template <class T>
void add_mueller_rows();
template <class T>
void add_importance_rows();
template <class T>
void add_mixed_rows();

template <class T>
void add_rows() {
  add_stokes_rows<T>();
  add_mueller_rows<T>();
  add_importance_rows<T>();
  add_mixed_rows<T>();
}

}  // namespace operations
