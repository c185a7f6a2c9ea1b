// SPDX-License-Identifier: Apache-2.0
//
// 4x4 matrices: row-major in NumPy, column-major in GLM.
#pragma once

#include <vector>

#include "bindings.h"

namespace halfspace::python {

/// Reads 16 numbers, row by row.
inline glm::dmat4 matrix_at(const double* rows) {
  glm::dmat4 m;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) m[column][row] = rows[4 * row + column];
  }
  return m;
}

/// Returns an array of shape (4, 4).
inline py::array_t<double> array_of(const glm::dmat4& m) {
  const glm::dmat4 rows = glm::transpose(m);
  return py::array_t<double>({py::ssize_t{4}, py::ssize_t{4}}, &rows[0].x);
}

/// Returns the matrices of an array of shape (N, 4, 4).
inline std::vector<glm::dmat4> matrices_of(const Array<double>& array) {
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4)
    throw InputError("transforms have the wrong shape; expected (N, 4, 4)");
  std::vector<glm::dmat4> list;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) list.push_back(matrix_at(array.data() + 16 * i));
  return list;
}

/// Returns the matrix of an array of shape (4, 4).
inline glm::dmat4 matrix_of(const Array<double>& array) {
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) throw InputError("a matrix has the wrong shape; expected (4, 4)");
  return matrix_at(array.data());
}

}  // namespace halfspace::python
