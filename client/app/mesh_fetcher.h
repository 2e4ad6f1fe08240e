#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "client/render/hull_models.h"

namespace onesea::client {

/// Gets hulls by the hash of their files and makes them ready to be drawn, on a thread of its own:
/// whoever draws asks for each picture and takes what is there.
class MeshFetcher {
 public:
  /// Blocks until the file's bytes are there.
  using Fetch = std::function<absl::StatusOr<std::string>(std::uint64_t hash)>;

  explicit MeshFetcher(Fetch fetch);
  /// Waits for the file that is under way.
  ~MeshFetcher();

  /// Null until it is there. A file that isn't what its hash says or can't be read stays null; one
  /// that didn't come is asked for again after kPauseNs. Thread-safe.
  render::SharedHullMesh Find(std::uint64_t hash);
  /// Why a hull that was asked for isn't drawn, for people; empty: all are there or under way. Gone
  /// when the file comes after all.
  std::string trouble() const;

  static constexpr std::int64_t kPauseNs = 3'000'000'000;

 private:
  struct Entry {
    render::SharedHullMesh mesh;
    bool wanted = true;
    std::int64_t not_before_ns = 0;
    std::string trouble;
  };
  void Run();
  std::optional<std::uint64_t> Next() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const Fetch fetch_;
  mutable absl::Mutex mutex_;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::map<std::uint64_t, Entry> entries_ ABSL_GUARDED_BY(mutex_);
  std::thread thread_;
};

/// A hull's file as something to draw. InvalidArgument: other bytes than `hash` says, no mesh, or
/// one that is larger than kHullSizeMaxM.
absl::StatusOr<render::SharedHullMesh> MeshOfFile(const std::string& file, std::uint64_t hash);

}  // namespace onesea::client
