#include "server/session/lease_book.h"

#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace onesea::server {
namespace {

// In the time that it takes whatever differs, so that nobody guesses a secret letter by letter.
bool SameSecret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t n = 0; n < a.size(); ++n) difference |= static_cast<unsigned>(a[n] ^ b[n]);
  return difference == 0;
}

}  // namespace

LeaseBook::LeaseBook(std::function<std::string()> make_secret)
    : make_secret_(std::move(make_secret)) {}

const LeaseBook::Lease* LeaseBook::Running(std::uint32_t body_id, std::int64_t now_ns) const {
  const auto found = leases_.find(body_id);
  if (found == leases_.end() || found->second.end_ns <= now_ns) return nullptr;
  return &found->second;
}

absl::StatusOr<std::string> LeaseBook::Take(std::uint32_t body_id, std::string_view shown,
                                            std::string_view holder, double duration_s,
                                            std::int64_t now_ns) {
  const Lease* running = Running(body_id, now_ns);
  if (running != nullptr && !SameSecret(running->secret, shown)) {
    return absl::PermissionDeniedError(
        absl::StrCat("body ", body_id, " is held by '", running->holder, "' for ",
                     (running->end_ns - now_ns) / 1'000'000'000 + 1, " s more unless it is used"));
  }
  Lease lease;
  lease.secret = running != nullptr ? running->secret : make_secret_();
  lease.holder = std::string(holder);
  lease.duration_ns = static_cast<std::int64_t>(duration_s * 1e9);
  lease.end_ns = now_ns + lease.duration_ns;
  const std::string secret = lease.secret;
  leases_[body_id] = std::move(lease);
  return secret;
}

absl::Status LeaseBook::Use(std::uint32_t body_id, std::string_view shown, std::int64_t now_ns) {
  const Lease* running = Running(body_id, now_ns);
  if (running == nullptr) {
    if (shown.empty()) return absl::OkStatus();
    return absl::PermissionDeniedError(
        absl::StrCat("lease: it has run out or isn't of body ", body_id, "; take another"));
  }
  if (!SameSecret(running->secret, shown)) {
    return absl::PermissionDeniedError(
        absl::StrCat("body ", body_id, " is held by '", running->holder, "'; show its lease"));
  }
  leases_[body_id].end_ns = now_ns + running->duration_ns;
  return absl::OkStatus();
}

absl::Status LeaseBook::Release(std::uint32_t body_id, std::string_view shown,
                                std::int64_t now_ns) {
  if (absl::Status status = Use(body_id, shown, now_ns); !status.ok()) return status;
  leases_.erase(body_id);
  return absl::OkStatus();
}

std::string LeaseBook::Holder(std::uint32_t body_id, std::int64_t now_ns) const {
  const Lease* running = Running(body_id, now_ns);
  return running == nullptr ? "" : running->holder;
}

std::string RandomSecret() {
  std::random_device device;
  std::string secret;
  for (int word = 0; word < 4; ++word) absl::StrAppendFormat(&secret, "%08x", device());
  return secret;
}

}  // namespace onesea::server
