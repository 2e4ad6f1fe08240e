#include "client/app/mesh_fetcher.h"

#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "common/base/limits.h"
#include "common/ingest/mesh_file.h"
#include "common/wire/body_description.h"
#include "common/wire/bounds.h"

namespace onesea::client {

absl::StatusOr<render::SharedHullMesh> MeshOfFile(const std::string& file, std::uint64_t hash) {
  if (wire::MeshHash(file) != hash) {
    return absl::InvalidArgumentError("mesh: the file isn't the one of this hash");
  }
  ONESEA_ASSIGN_OR_RETURN(const TriangleMesh mesh, ingest::ReadMeshFile(file));
  for (const Vec3d& v : mesh.vertices) {
    for (const double metres : {v.x, v.y, v.z}) {
      if (!(std::abs(metres) <= kHullSizeMaxM)) {
        return absl::InvalidArgumentError(
            absl::StrCat("mesh: a coordinate is ", metres, ", the limit is ±", kHullSizeMaxM));
      }
    }
  }
  return render::PlainModel(mesh.vertices, mesh.triangles);
}

namespace {

std::string_view Text(const absl::Status& status) {
  return {status.message().data(), status.message().size()};
}

}  // namespace

MeshFetcher::MeshFetcher(Fetch fetch) : fetch_(std::move(fetch)), thread_([this] { Run(); }) {}

MeshFetcher::~MeshFetcher() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

render::SharedHullMesh MeshFetcher::Find(std::uint64_t hash) {
  absl::MutexLock lock(&mutex_);
  return entries_[hash].mesh;
}

std::string MeshFetcher::trouble() const {
  absl::MutexLock lock(&mutex_);
  for (const auto& [hash, entry] : entries_) {
    if (!entry.trouble.empty()) return entry.trouble;
  }
  return "";
}

std::optional<std::uint64_t> MeshFetcher::Next() const {
  const std::int64_t now_ns = SystemClock().MonotonicNs();
  for (const auto& [hash, entry] : entries_) {
    if (entry.wanted && entry.not_before_ns <= now_ns) return hash;
  }
  return std::nullopt;
}

void MeshFetcher::Run() {
  // New wishes wake it; those that wait for another try are looked at ten times a second.
  constexpr absl::Duration kLook = absl::Milliseconds(100);
  absl::MutexLock lock(&mutex_);
  while (!stopping_) {
    const std::optional<std::uint64_t> hash = Next();
    if (!hash) {
      mutex_.AwaitWithTimeout(absl::Condition(&stopping_), kLook);
      continue;
    }
    mutex_.Unlock();
    const absl::StatusOr<std::string> file = fetch_(*hash);
    const absl::StatusOr<render::SharedHullMesh> mesh =
        file.ok() ? MeshOfFile(*file, *hash) : file.status();
    mutex_.Lock();
    Entry& entry = entries_[*hash];
    // What came is final, whatever it is; what didn't come may yet.
    entry.wanted = !file.ok();
    entry.not_before_ns = SystemClock().MonotonicNs() + kPauseNs;
    if (mesh.ok()) entry.mesh = *mesh;
    entry.trouble = mesh.ok() ? ""
                              : absl::StrFormat("the hull %016x can't be drawn: %s", *hash,
                                                wire::Printable(Text(mesh.status()), 200));
  }
}

}  // namespace onesea::client
