#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/base/triangle_mesh.h"

/// Meshes from the bytes of a file: STL (text or binary) and OBJ (polygons are cut into triangles;
/// groups, materials, normals and texture are ignored).
///
/// The mesh is welded but not validated. InvalidArgument naming the line or triangle that
/// cannot be read; more than kHullFileBytesMax or kHullTrianglesMax is refused. Units are metres.
namespace onesea::ingest {

absl::StatusOr<TriangleMesh> ReadStl(absl::string_view bytes);
absl::StatusOr<TriangleMesh> ReadObj(absl::string_view bytes);

/// By content: OBJ unless it looks like STL.
absl::StatusOr<TriangleMesh> ReadMeshFile(absl::string_view bytes);

/// A binary STL file of the mesh: coordinates become floats. Pre: at most kHullTrianglesMax.
std::string WriteStl(const TriangleMesh& mesh);

}  // namespace onesea::ingest
