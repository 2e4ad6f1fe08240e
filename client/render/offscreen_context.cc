#include "client/render/offscreen_context.h"

#include <epoxy/egl.h>

#include <array>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"

namespace onesea::render {
namespace {

// NVIDIA's EGL has no surfaceless platform and Mesa's devices need no display, hence devices first.
std::vector<std::pair<std::string, EGLDisplay>> Displays() {
  std::vector<std::pair<std::string, EGLDisplay>> displays;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base")) {
    std::array<EGLDeviceEXT, 8> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
      for (EGLint i = 0; i < count; ++i) {
        displays.emplace_back(
            absl::StrCat("device ", i),
            eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)],
                                     nullptr));
      }
    }
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    displays.emplace_back("surfaceless", eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                                  EGL_DEFAULT_DISPLAY, nullptr));
  }
  displays.emplace_back("default display", eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

absl::StatusOr<EGLContext> MakeCurrent(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY) return absl::UnavailableError("no display");
  if (!eglInitialize(display, nullptr, nullptr)) {
    return absl::UnavailableError(absl::StrCat("eglInitialize 0x", absl::Hex(eglGetError())));
  }
  eglBindAPI(EGL_OPENGL_API);
  constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    3,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    3,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_NONE};
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) {
    constexpr EGLint kConfig[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_NONE};
    EGLint count = 0;
    eglChooseConfig(display, kConfig, &config, 1, &count);
  }
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kAttributes);
  if (context == EGL_NO_CONTEXT) {
    return absl::UnavailableError(
        absl::StrCat("no 3.3 core context, 0x", absl::Hex(eglGetError())));
  }
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    eglDestroyContext(display, context);
    return absl::UnavailableError(
        absl::StrCat("no surfaceless context, 0x", absl::Hex(eglGetError())));
  }
  return context;
}

}  // namespace

absl::StatusOr<std::unique_ptr<OffscreenContext>> OffscreenContext::Create() {
  std::string reasons;
  for (const auto& [path, display] : Displays()) {
    const absl::StatusOr<EGLContext> context = MakeCurrent(display);
    if (context.ok()) {
      return std::unique_ptr<OffscreenContext>(new OffscreenContext(display, *context, path));
    }
    absl::StrAppend(&reasons, reasons.empty() ? "" : "; ", path, ": ", context.status().message());
  }
  return absl::UnavailableError(
      absl::StrCat("no OpenGL without a window (install libgl1-mesa-dri): ", reasons));
}

OffscreenContext::~OffscreenContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace onesea::render
