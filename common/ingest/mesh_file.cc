#include "common/ingest/mesh_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "common/base/check.h"
#include "common/base/limits.h"

#include "tiny_obj_loader.h"

namespace onesea::ingest {
namespace {

constexpr std::size_t kStlHeaderBytes = 80;
constexpr std::size_t kStlTriangleBytes = 50;

absl::Status CheckSize(absl::string_view bytes) {
  if (static_cast<std::int64_t>(bytes.size()) <= kHullFileBytesMax) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("hull file has ", bytes.size(), " bytes, at most ", kHullFileBytesMax));
}
absl::Status TooManyTriangles(std::size_t count) {
  return absl::InvalidArgumentError(
      absl::StrCat("hull has ", count, " triangles, at most ", kHullTrianglesMax));
}

std::uint32_t LittleEndian32(const char* at) {
  std::uint32_t value = 0;
  for (int n = 0; n < 4; ++n) value |= std::uint32_t{static_cast<unsigned char>(at[n])} << (8 * n);
  return value;
}

// A text file may be as long as a binary one claims to be by chance, and binary headers may begin
// with "solid"; only the length tells.
bool IsBinaryStl(absl::string_view bytes) {
  return bytes.size() >= kStlHeaderBytes + 4 &&
         bytes.size() == kStlHeaderBytes + 4 +
                             kStlTriangleBytes * LittleEndian32(bytes.data() + kStlHeaderBytes);
}

absl::StatusOr<TriangleMesh> ReadBinaryStl(absl::string_view bytes) {
  TriangleMesh mesh;
  const std::uint32_t count = LittleEndian32(bytes.data() + kStlHeaderBytes);
  if (count > kHullTrianglesMax) return TooManyTriangles(count);
  const char* at = bytes.data() + kStlHeaderBytes + 4;
  for (std::uint32_t n = 0; n < count; ++n, at += kStlTriangleBytes) {
    for (int corner = 0; corner < 3; ++corner) {
      const auto number = [&](int axis) {
        return double{std::bit_cast<float>(LittleEndian32(at + 12 + 12 * corner + 4 * axis))};
      };
      mesh.vertices.push_back({number(0), number(1), number(2)});
    }
    mesh.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  }
  return mesh;
}

absl::StatusOr<TriangleMesh> ReadTextStl(absl::string_view bytes) {
  TriangleMesh mesh;
  int line_number = 0, corners = 0;
  for (absl::string_view line : absl::StrSplit(bytes, '\n')) {
    ++line_number;
    const std::vector<absl::string_view> words =
        absl::StrSplit(line, absl::ByAnyChar(" \t\r"), absl::SkipEmpty());
    if (words.empty()) continue;
    if (words[0] == "vertex") {
      Vec3d v;
      if (words.size() != 4 || !absl::SimpleAtod(words[1], &v.x) ||
          !absl::SimpleAtod(words[2], &v.y) || !absl::SimpleAtod(words[3], &v.z)) {
        return absl::InvalidArgumentError(
            absl::StrCat("STL line ", line_number, ": expected \"vertex x y z\""));
      }
      mesh.vertices.push_back(v);
      ++corners;
    } else if (words[0] == "endloop") {
      if (corners != 3) {
        return absl::InvalidArgumentError(
            absl::StrCat("STL line ", line_number, ": a facet has ", corners, " corners, not 3"));
      }
      const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.triangles.push_back({last - 3, last - 2, last - 1});
      if (mesh.triangles.size() > kHullTrianglesMax) return TooManyTriangles(mesh.triangles.size());
      corners = 0;
    }
  }
  if (corners != 0) {
    return absl::InvalidArgumentError(absl::StrCat("STL line ", line_number, ": the file is cut"));
  }
  return mesh;
}

bool LooksLikeTextStl(absl::string_view bytes) {
  const absl::string_view start = absl::StripLeadingAsciiWhitespace(bytes.substr(0, 512));
  return absl::StartsWith(start, "solid");
}

}  // namespace

absl::StatusOr<TriangleMesh> ReadStl(absl::string_view bytes) {
  if (absl::Status s = CheckSize(bytes); !s.ok()) return s;
  absl::StatusOr<TriangleMesh> mesh;
  if (IsBinaryStl(bytes)) {
    mesh = ReadBinaryStl(bytes);
  } else if (LooksLikeTextStl(bytes)) {
    mesh = ReadTextStl(bytes);
  } else if (bytes.size() >= kStlHeaderBytes + 4) {
    const std::uint64_t count = LittleEndian32(bytes.data() + kStlHeaderBytes);
    return absl::InvalidArgumentError(
        absl::StrCat("STL: ", bytes.size(), " bytes, but ", count, " triangles need ",
                     kStlHeaderBytes + 4 + kStlTriangleBytes * count));
  } else {
    return absl::InvalidArgumentError("STL: neither text nor a binary header");
  }
  if (mesh.ok()) Weld(*mesh);
  return mesh;
}

absl::StatusOr<TriangleMesh> ReadObj(absl::string_view bytes) {
  if (absl::Status s = CheckSize(bytes); !s.ok()) return s;
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(std::string(bytes), "", config)) {
    return absl::InvalidArgumentError(
        absl::StrCat("OBJ: ", absl::StripAsciiWhitespace(reader.Error())));
  }
  TriangleMesh mesh;
  const auto& numbers = reader.GetAttrib().vertices;
  for (std::size_t n = 0; n + 2 < numbers.size(); n += 3) {
    mesh.vertices.push_back({numbers[n], numbers[n + 1], numbers[n + 2]});
  }
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    const auto& indices = shape.mesh.indices;
    if (mesh.triangles.size() + indices.size() / 3 > kHullTrianglesMax) {
      return TooManyTriangles(mesh.triangles.size() + indices.size() / 3);
    }
    for (std::size_t n = 0; n + 2 < indices.size(); n += 3) {
      std::array<std::uint32_t, 3> triangle;
      for (int k = 0; k < 3; ++k) {
        const int index = indices[n + k].vertex_index;
        if (index < 0 || static_cast<std::size_t>(index) >= mesh.vertices.size()) {
          return absl::InvalidArgumentError(
              absl::StrCat("OBJ: a face names vertex ", index + 1, " of ", mesh.vertices.size()));
        }
        triangle[k] = static_cast<std::uint32_t>(index);
      }
      mesh.triangles.push_back(triangle);
    }
  }
  Weld(mesh);
  return mesh;
}

std::string WriteStl(const TriangleMesh& mesh) {
  ONESEA_CHECK(mesh.triangles.size() <= kHullTrianglesMax) << mesh.triangles.size();
  std::string out(kStlHeaderBytes, '\0');
  const auto put = [&](std::uint32_t word) {
    for (int n = 0; n < 4; ++n) out.push_back(static_cast<char>(word >> (8 * n)));
  };
  const auto put_vector = [&](Vec3d v) {
    for (const double x : {v.x, v.y, v.z}) put(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [a, b, c] : mesh.triangles) {
    put_vector({});  // a normal of zeros: readers make it from the corners
    for (const std::uint32_t corner : {a, b, c}) put_vector(mesh.vertices[corner]);
    out.append(2, '\0');
  }
  return out;
}

absl::StatusOr<TriangleMesh> ReadMeshFile(absl::string_view bytes) {
  return IsBinaryStl(bytes) || LooksLikeTextStl(bytes) ? ReadStl(bytes) : ReadObj(bytes);
}

}  // namespace onesea::ingest
