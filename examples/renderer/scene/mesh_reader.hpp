// SPDX-License-Identifier: MIT
// Reads triangle meshes from Wavefront OBJ and Stanford PLY files. What is wrong with a file is an
// InputError that names the file, the line where it has lines, and the value; nothing is allocated
// on a header's word alone. Polygons become fans of triangles about their first corner, as in
// Mitsuba, so they should be convex.
#pragma once

#include <filesystem>

#include "../io/input_error.hpp"
#include "mesh.hpp"

namespace renderer {

/// One vertex for each different position/texcoord/normal. `flip_tex_coords` turns v into 1 - v
/// (Mitsuba's default). Corners without a normal in a file that has some get the mean of their
/// faces'. Groups, materials, lines and points are passed over. `asker` is the place that names the
/// file, for the case that it isn't there.
TriangleMesh read_obj(const std::filesystem::path& path, bool flip_tex_coords = true,
                      const Location& asker = {});

/// ascii, binary_little_endian, binary_big_endian; vertex: x y z, nx ny nz, u v or s t; face:
/// vertex_indices or vertex_index. Other elements and properties are passed over. Mitsuba's
/// `flip_tex_coords` is false by default here.
TriangleMesh read_ply(const std::filesystem::path& path, bool flip_tex_coords = false,
                      const Location& asker = {});

}  // namespace renderer
