#include "server/app/listen_address.h"

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace onesea::server {
namespace {

// Four numbers of which the first is 127; "127.evil.example" is a name and not an address.
bool IsLoopbackV4(const std::string& host) {
  const std::vector<std::string> parts = absl::StrSplit(host, '.');
  if (parts.size() != 4 || parts[0] != "127") return false;
  for (const std::string& part : parts) {
    int number = -1;
    if (!absl::SimpleAtoi(part, &number) || number < 0 || number > 255) return false;
  }
  return true;
}

}  // namespace

absl::Status CheckListenAddress(const std::string& address, bool insecure_public) {
  if (absl::StartsWith(address, "unix:")) return absl::OkStatus();
  const std::size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon == std::string::npos ? 0 : colon);
  int port = -1;
  if (host.empty() || !absl::SimpleAtoi(address.substr(colon + 1), &port) || port < 0 ||
      port > 65535) {
    return absl::InvalidArgumentError(
        absl::StrCat("--listen=", address, ": is not HOST:PORT, as in 127.0.0.1:7310"));
  }
  if (insecure_public || host == "localhost" || host == "[::1]" || IsLoopbackV4(host)) {
    return absl::OkStatus();
  }
  return absl::FailedPreconditionError(
      absl::StrCat("--listen=", address,
                   ": others could reach this address, and the server neither encrypts nor asks "
                   "who they are; listen on 127.0.0.1, or add --insecure_public if the network is "
                   "yours"));
}

}  // namespace onesea::server
