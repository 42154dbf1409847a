// SPDX-License-Identifier: MIT
// Meshes: what begins like a PLY file is read as one, all else as OBJ.
#include "scene/mesh_reader.hpp"
#include "scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  const auto bytes = fuzz::text_of(data, size);
  const bool is_ply = bytes.starts_with("ply");
  const auto path = scratch.write(is_ply ? "a.ply" : "a.obj", bytes);
  fuzz::expect_read_or_refused(path, [&] {
    const renderer::TriangleMesh mesh =
        is_ply ? renderer::read_ply(path) : renderer::read_obj(path);
    for (const auto& triangle : mesh.triangles)
      for (const auto corner : triangle)
        if (corner >= mesh.positions.size()) std::abort();
    for (const auto& p : mesh.positions)
      for (int i = 0; i < 3; ++i)
        if (!std::isfinite(p[i])) std::abort();
  });
  return 0;
}
