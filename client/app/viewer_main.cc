// onesea-view: shows a session's sea in a window, or draws it to PNG files without a display.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "absl/flags/flag.h"
#include "absl/flags/parse.h"
#include "absl/flags/usage.h"
#include "absl/flags/usage_config.h"
#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/app/viewer.h"
#include "common/base/check.h"
#include "common/base/limits.h"

ABSL_FLAG(std::string, server, "127.0.0.1:7310", "HOST:PORT of the server");
ABSL_FLAG(std::string, session, "", "Session to watch; default: the server's only one");
ABSL_FLAG(std::string, offline, "", "Session file to draw without a server");
ABSL_FLAG(bool, headless, false, "Draw PNG files instead of opening a window; needs no display");
ABSL_FLAG(double, seconds, 5.0, "Headless: seconds of sea to draw, (0, 3600]");
ABSL_FLAG(double, fps, 30.0, "Headless: pictures per second of sea, [0.01, 240]");
ABSL_FLAG(std::string, size, "1280x720", "WIDTHxHEIGHT in pixels, 64x64 to 7680x4320");
ABSL_FLAG(std::string, out, "frames", "Folder for pictures, made if missing");
ABSL_FLAG(std::string, camera, "deck", "Where to look from: deck, bridge, mast, swimmer or orbit");
ABSL_FLAG(std::string, eye, "",
          "X,Y,Z in metres (east, north, up): place the camera there instead of the origin");
ABSL_FLAG(double, pitch, 0.0, "With --eye: degrees up, [-85, 85]");
ABSL_FLAG(double, heading, 60.0, "Direction of view in degrees clockwise from north");
ABSL_FLAG(double, sun_elevation, 24.0, "Height of the sun in degrees, [-11, 90]");
ABSL_FLAG(double, sun_azimuth, 100.0, "Where the sun stands, degrees clockwise from north");
ABSL_FLAG(double, time_of_day, -1.0,
          "Solar hour, [0, 24): sets the sun as at an equinox in 30 degrees north");
ABSL_FLAG(double, clouds, 0.3, "Share of the sky that is covered, [0, 1]");
ABSL_FLAG(double, visibility_km, 35.0, "How far one sees, [0.5, 200]");
ABSL_FLAG(std::string, water, "II", "Jerlov water type: I, IB, II, III, 1C, 3C or 5C");
ABSL_FLAG(int, grid, 256, "N of the N x N fields of each cascade: 64, 128, 256, 512 or 1024");
ABSL_FLAG(int, samples, 0,
          "Samples per pixel on edges: 4, or 1 and smoothed afterwards; 0 chooses by the driver");
ABSL_FLAG(bool, live, false, "Headless: draw the session's present, at most --fps a second");
ABSL_FLAG(
    std::string, drive, "",
    "Headless: keys by second since the start, as 0=b,1=up,4=up+left,9=; implies --live. Keys: "
    "up, down, left, right, b, space, x, delete");
ABSL_FLAG(std::string, poses, "",
          "Headless: CSV file for where every body was drawn; implies --live");
ABSL_FLAG(bool, panel, false, "Headless: draw the panel into the pictures too");

namespace onesea::client {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

absl::Status InRange(const char* flag, double value, double low, double high) {
  if (value >= low && value <= high) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("--", flag, "=", value, ": must be in [", low, ", ", high, "]"));
}

absl::Status ReadSize(ViewerOptions& options) {
  const std::string text = absl::GetFlag(FLAGS_size);
  const std::vector<std::string> parts = absl::StrSplit(text, 'x');
  if (parts.size() != 2 || !absl::SimpleAtoi(parts[0], &options.width) ||
      !absl::SimpleAtoi(parts[1], &options.height)) {
    return absl::InvalidArgumentError(absl::StrCat("--size=", text, ": write it as 1280x720"));
  }
  ONESEA_RETURN_IF_ERROR(InRange("size (width)", options.width, 64, 7680));
  return InRange("size (height)", options.height, 64, 4320);
}

absl::Status ReadSun(ViewSettings& settings) {
  settings.sun_elevation_deg = absl::GetFlag(FLAGS_sun_elevation);
  settings.sun_azimuth_deg = absl::GetFlag(FLAGS_sun_azimuth);
  ONESEA_RETURN_IF_ERROR(InRange("sun_elevation", settings.sun_elevation_deg, -11.0, 90.0));
  ONESEA_RETURN_IF_ERROR(InRange("sun_azimuth", settings.sun_azimuth_deg, -360.0, 360.0));
  const double hour = absl::GetFlag(FLAGS_time_of_day);
  if (hour == -1.0) return absl::OkStatus();
  ONESEA_RETURN_IF_ERROR(InRange("time_of_day", hour, 0.0, 24.0));
  // Declination 0: the sun's path is the celestial equator.
  const double hour_angle = (hour - 12.0) * 15.0 * kDegree, latitude = 30.0 * kDegree;
  const double east = -std::sin(hour_angle), up = std::cos(latitude) * std::cos(hour_angle);
  const double north = -std::sin(latitude) * std::cos(hour_angle);
  settings.sun_elevation_deg = std::max(-11.0, std::asin(up) / kDegree);
  settings.sun_azimuth_deg = std::atan2(east, north) / kDegree;
  return absl::OkStatus();
}

absl::Status ReadWater(ViewSettings& settings) {
  const std::string wanted = absl::GetFlag(FLAGS_water);
  const std::vector<std::string> names = {"I", "IB", "II", "III", "1C", "3C", "5C"};
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (names[n] == wanted) {
      settings.water = static_cast<int>(n);
      return absl::OkStatus();
    }
  }
  return absl::InvalidArgumentError(
      absl::StrCat("--water=", wanted, ": choose one of I, IB, II, III, 1C, 3C, 5C"));
}

absl::Status ReadEye(CameraControl& camera) {
  const std::string text = absl::GetFlag(FLAGS_eye);
  if (text.empty()) return absl::OkStatus();
  const std::vector<std::string> parts = absl::StrSplit(text, ',');
  double place[3] = {};
  for (std::size_t n = 0; n < 3; ++n) {
    const double limit = n == 2 ? 20'000.0 : kQueryCoordinateMaxM;
    if (parts.size() != 3 || !absl::SimpleAtod(parts[n], &place[n]) ||
        !(std::abs(place[n]) <= limit)) {
      return absl::InvalidArgumentError(
          absl::StrCat("--eye=", text, ": write it as X,Y,Z in metres"));
    }
  }
  const double pitch = absl::GetFlag(FLAGS_pitch);
  ONESEA_RETURN_IF_ERROR(InRange("pitch", pitch, -85.0, 85.0));
  camera.PlaceAt({place[0], place[1], place[2]}, pitch * kDegree);
  return absl::OkStatus();
}

absl::StatusOr<ViewerOptions> ReadOptions() {
  ViewerOptions options;
  ONESEA_RETURN_IF_ERROR(ReadSize(options));
  ONESEA_RETURN_IF_ERROR(ReadSun(options.settings));
  ONESEA_RETURN_IF_ERROR(ReadWater(options.settings));
  options.seconds = absl::GetFlag(FLAGS_seconds);
  options.frames_per_second = absl::GetFlag(FLAGS_fps);
  options.grid_size = absl::GetFlag(FLAGS_grid);
  options.samples = absl::GetFlag(FLAGS_samples);
  options.out = absl::GetFlag(FLAGS_out);
  options.settings.cloud_cover = absl::GetFlag(FLAGS_clouds);
  options.settings.visibility_km = absl::GetFlag(FLAGS_visibility_km);
  ONESEA_RETURN_IF_ERROR(InRange("seconds", options.seconds, 1e-3, 3600.0));
  ONESEA_RETURN_IF_ERROR(InRange("fps", options.frames_per_second, 0.01, 240.0));
  ONESEA_RETURN_IF_ERROR(InRange("clouds", options.settings.cloud_cover, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(InRange("visibility_km", options.settings.visibility_km, 0.5, 200.0));
  const int n = options.grid_size;
  if (n < 64 || n > 1024 || (n & (n - 1)) != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("--grid=", n, ": must be 64, 128, 256, 512 or 1024"));
  }
  if (options.samples != 0 && options.samples != 1 && options.samples != 4) {
    return absl::InvalidArgumentError(
        absl::StrCat("--samples=", options.samples, ": must be 0, 1 or 4"));
  }
  const double heading = absl::GetFlag(FLAGS_heading);
  ONESEA_RETURN_IF_ERROR(InRange("heading", heading, -360.0, 360.0));
  ONESEA_ASSIGN_OR_RETURN(options.camera, CameraControl::FromPreset(absl::GetFlag(FLAGS_camera),
                                                                    (90.0 - heading) * kDegree));
  ONESEA_ASSIGN_OR_RETURN(options.drive, DriveScript::Parse(absl::GetFlag(FLAGS_drive)));
  options.poses = absl::GetFlag(FLAGS_poses);
  options.live = absl::GetFlag(FLAGS_live) || !options.drive.empty() || !options.poses.empty();
  if (options.live && !absl::GetFlag(FLAGS_headless)) {
    return absl::InvalidArgumentError("--live, --drive and --poses need --headless");
  }
  ONESEA_RETURN_IF_ERROR(ReadEye(options.camera));
  if (absl::GetFlag(FLAGS_headless)) options.settings.show_panel = absl::GetFlag(FLAGS_panel);
  return options;
}

absl::Status Run() {
  ONESEA_ASSIGN_OR_RETURN(ViewerOptions options, ReadOptions());
  const std::string file = absl::GetFlag(FLAGS_offline);
  auto opened = file.empty() ? JoinServer(absl::GetFlag(FLAGS_server), absl::GetFlag(FLAGS_session))
                             : OpenSessionFile(file);
  if (!opened.ok()) return opened.status();
  SeaSource& source = **opened;
  if (!absl::GetFlag(FLAGS_headless)) return RunWindow(source, std::move(options));
  return options.live ? RunLive(source, std::move(options))
                      : RunHeadless(source, std::move(options));
}

// Abseil names flags with underscores; people write --sun-elevation. Values are left alone.
std::vector<std::string> WithUnderscores(int argc, char** argv) {
  std::vector<std::string> arguments(argv, argv + argc);
  for (std::size_t n = 1; n < arguments.size(); ++n) {
    std::string& text = arguments[n];
    if (!absl::StartsWith(text, "--")) continue;
    for (std::size_t c = 2; c < text.size() && text[c] != '='; ++c) {
      if (text[c] == '-') text[c] = '_';
    }
  }
  return arguments;
}

}  // namespace
}  // namespace onesea::client

int main(int argc, char** argv) {
  absl::SetProgramUsageMessage(
      "Shows a session's sea, synthesised in this process and checked against the server.\n\n"
      "  onesea-view                                       the only session of 127.0.0.1:7310\n"
      "  onesea-view --server=HOST:PORT --session=NAME     another one\n"
      "  onesea-view --headless --seconds=5 --size=1280x720 --out=DIR   PNG files, no display\n"
      "  onesea-view --headless --drive=0=b,2=up,8=up+left --seconds=15      drives a boat\n"
      "  onesea-view --offline=FILE.textproto              no server\n\n"
      "In the window: H lists the keys.");
  absl::FlagsUsageConfig config;
  const auto is_ours = [](absl::string_view file) {
    return absl::EndsWith(file, "client/app/viewer_main.cc");
  };
  config.contains_help_flags = is_ours;
  config.contains_helpshort_flags = is_ours;
  absl::SetFlagsUsageConfig(config);
  std::vector<std::string> arguments = onesea::client::WithUnderscores(argc, argv);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size());
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  const std::vector<char*> rest =
      absl::ParseCommandLine(static_cast<int>(pointers.size()), pointers.data());
  if (rest.size() > 1) {
    std::fprintf(stderr, "onesea-view: what is \"%s\"? See onesea-view --help\n", rest[1]);
    return 2;
  }
  const absl::Status status = onesea::client::Run();
  if (status.ok()) return 0;
  std::fprintf(stderr, "onesea-view: %s\n", std::string(status.message()).c_str());
  return 1;
}
