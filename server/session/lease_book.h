#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace onesea::server {

/// Who may command which body, for how long. A lease is a secret that its holder shows with every
/// command; each use prolongs it by its duration. Real time is an argument. Not thread-safe.
class LeaseBook {
 public:
  /// `make_secret` gives a new text that nobody can guess.
  explicit LeaseBook(std::function<std::string()> make_secret);

  /// A lease for a body that nobody holds (any more). PermissionDenied naming the holder. A holder
  /// who shows the running lease gets the same again, for `duration_s` from now.
  absl::StatusOr<std::string> Take(std::uint32_t body_id, std::string_view shown,
                                   std::string_view holder, double duration_s, std::int64_t now_ns);

  /// OK if `shown` is the running lease of the body, or if nobody holds it and `shown` is empty;
  /// prolongs it. PermissionDenied otherwise.
  absl::Status Use(std::uint32_t body_id, std::string_view shown, std::int64_t now_ns);

  /// Pre: as Use().
  absl::Status Release(std::uint32_t body_id, std::string_view shown, std::int64_t now_ns);
  /// The body is gone.
  void Forget(std::uint32_t body_id) { leases_.erase(body_id); }

  /// Empty: nobody.
  std::string Holder(std::uint32_t body_id, std::int64_t now_ns) const;

 private:
  struct Lease {
    std::string secret, holder;
    std::int64_t duration_ns = 0, end_ns = 0;
  };
  const Lease* Running(std::uint32_t body_id, std::int64_t now_ns) const;

  std::function<std::string()> make_secret_;
  std::map<std::uint32_t, Lease> leases_;
};

/// 128 bits of the system's randomness in hexadecimal.
std::string RandomSecret();

}  // namespace onesea::server
