#include "tests/bench/light_viewer.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "absl/strings/str_cat.h"
#include "tests/shared/loopback.h"

namespace onesea::bench {
namespace {

// HTTP/2 frame types and flags, RFC 9113 section 6.
enum : std::uint8_t {
  kData = 0,
  kHeaders = 1,
  kReset = 3,
  kSettings = 4,
  kPing = 6,
  kGoAway = 7,
  kWindow = 8
};
constexpr std::uint8_t kAckFlag = 1;
constexpr std::uint8_t kEndStream = 1;
constexpr std::uint8_t kEndHeaders = 4;
constexpr std::uint32_t kWindowBytes = 4 << 20;

std::string BigEndian(std::uint32_t value, int bytes) {
  std::string out;
  for (int n = bytes - 1; n >= 0; --n) out.push_back(static_cast<char>(value >> (8 * n)));
  return out;
}

std::string HttpFrame(std::uint8_t type, std::uint8_t flags, std::uint32_t stream,
                      const std::string& payload) {
  std::string out = BigEndian(static_cast<std::uint32_t>(payload.size()), 3);
  out.push_back(static_cast<char>(type));
  out.push_back(static_cast<char>(flags));
  return out + BigEndian(stream, 4) + payload;
}

// HPACK (RFC 7541): a literal header field that is not indexed; all strings here are below 127
// bytes.
std::string Text(const std::string& text) {
  std::string out(1, static_cast<char>(text.size()));
  out.append(text);
  return out;
}

std::string RequestHeaders() {
  return absl::StrCat("\x83\x86",                               // :method POST, :scheme http
                      "\x04", Text("/onesea.v1.OneSea/Watch"),  // :path
                      "\x01", Text("localhost"),                // :authority
                      "\x0f\x10", Text("application/grpc"),     // content-type
                      std::string(1, '\0'), Text("te"), Text("trailers"));
}

std::string Setting(std::uint16_t id, std::uint32_t value) {
  return BigEndian(id, 2) + BigEndian(value, 4);
}

std::uint32_t ReadBigEndian(const char* at, int bytes) {
  std::uint32_t value = 0;
  for (int n = 0; n < bytes; ++n) value = value << 8 | static_cast<std::uint8_t>(at[n]);
  return value;
}

}  // namespace

LightViewer::~LightViewer() {
  if (fd_ >= 0) close(fd_);
}

LightViewer::LightViewer(LightViewer&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), in_(std::move(other.in_)) {}

bool LightViewer::Open(int port, const std::string& session, bool every_frame) {
  fd_ = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = Loopback(port);
  if (connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) return false;
  SetNoDelay(fd_);
  fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL) | O_NONBLOCK);
  std::string hello = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
  hello += HttpFrame(kSettings, 0, 0, Setting(2, 0) + Setting(4, kWindowBytes));
  hello += HttpFrame(kWindow, 0, 0, BigEndian(kWindowBytes, 4));
  hello += HttpFrame(kHeaders, kEndHeaders, 1, RequestHeaders());
  SendAll(hello);
  v1::WatchRequest request;
  request.mutable_open()->set_session(session);
  request.mutable_open()->set_every_frame(every_frame);
  request.mutable_open()->set_client_name("light");
  SendMessage(request);
  return !broken_;
}

void LightViewer::Fail(const std::string& why) {
  broken_ = true;
  if (trouble_.empty()) trouble_ = why;
}

void LightViewer::SendAll(const std::string& bytes) {
  // A few dozen bytes a second: a full socket buffer means that nobody reads.
  const ssize_t sent = send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent != static_cast<ssize_t>(bytes.size())) return Fail("the server does not read");
  bytes_ += sent;
}

void LightViewer::SendMessage(const v1::WatchRequest& request) {
  const std::string body = request.SerializeAsString();
  SendAll(HttpFrame(
      kData, 0, 1,
      std::string(1, '\0') + BigEndian(static_cast<std::uint32_t>(body.size()), 4) + body));
}

bool LightViewer::Receive() {
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t size = recv(fd_, buffer.data(), buffer.size(), 0);
    if (size == 0) Fail("the server closed the connection");
    if (size < 0) return !broken_ && (errno == EAGAIN || errno == EWOULDBLOCK);
    if (size == 0) return false;
    bytes_ += size;
    in_.append(buffer.data(), static_cast<std::size_t>(size));
    if (static_cast<std::size_t>(size) < buffer.size()) return true;
  }
}

bool LightViewer::NextMessage(FrameSeen* out) {
  constexpr std::size_t kHeader = 9;
  while (!broken_) {
    if (TakeMessage(out)) return true;
    if (in_.size() - in_at_ < kHeader) break;
    const char* head = in_.data() + in_at_;
    const std::size_t size = ReadBigEndian(head, 3);
    if (in_.size() - in_at_ < kHeader + size) break;
    OnHttpFrame(static_cast<std::uint8_t>(head[3]), static_cast<std::uint8_t>(head[4]),
                head + kHeader, size);
    in_at_ += kHeader + size;
  }
  in_.erase(0, in_at_);
  in_at_ = 0;
  return false;
}

void LightViewer::OnHttpFrame(std::uint8_t type, std::uint8_t flags, const char* payload,
                              std::size_t size) {
  switch (type) {
    case kData:
      messages_.append(payload, size);
      GiveBackWindow(size);
      break;
    case kHeaders:
      if ((flags & kEndStream) != 0) Fail("the server ended the stream");
      break;
    case kSettings:
      if ((flags & kAckFlag) == 0) SendAll(HttpFrame(kSettings, kAckFlag, 0, ""));
      break;
    case kPing:
      if ((flags & kAckFlag) == 0)
        SendAll(HttpFrame(kPing, kAckFlag, 0, std::string(payload, size)));
      break;
    case kReset:
    case kGoAway:
      Fail(absl::StrCat("the server sent HTTP/2 frame type ", static_cast<int>(type)));
      break;
    default:
      break;  // WINDOW_UPDATE: our few bytes never fill a window
  }
}

void LightViewer::GiveBackWindow(std::size_t size) {
  window_owed_ += size;
  if (window_owed_ < kWindowBytes / 4) return;
  const std::string owed = BigEndian(static_cast<std::uint32_t>(window_owed_), 4);
  SendAll(HttpFrame(kWindow, 0, 0, owed) + HttpFrame(kWindow, 0, 1, owed));
  window_owed_ = 0;
}

bool LightViewer::TakeMessage(FrameSeen* out) {
  constexpr std::size_t kPrefix = 5;
  if (messages_.size() < kPrefix) return false;
  const std::size_t size = ReadBigEndian(messages_.data() + 1, 4);
  if (messages_.size() < kPrefix + size) return false;
  const bool parsed = response_.ParseFromArray(messages_.data() + kPrefix, static_cast<int>(size));
  messages_.erase(0, kPrefix + size);
  if (!parsed) Fail("a frame that does not parse");
  if (!parsed) return false;
  out->sequence = response_.sequence();
  out->due_ns = response_.stamp().server_monotonic_ns();
  if (++unacknowledged_ == 4) {
    v1::WatchRequest ack;
    ack.mutable_ack()->set_sequence(response_.sequence());
    ack.mutable_ack()->set_drift_m(0.0f);
    SendMessage(ack);
    unacknowledged_ = 0;
  }
  return true;
}

}  // namespace onesea::bench
