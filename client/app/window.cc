#include "client/app/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "absl/strings/str_cat.h"

namespace onesea::client {

struct Window::Impl {
  GLFWwindow* window = nullptr;
  WindowInput input;
  double last_x = 0, last_y = 0;
};

namespace {

std::string g_last_error;  // GLFW reports through a callback without context

void OnError(int code, const char* words) {
  g_last_error = absl::StrCat(words, " (0x", absl::Hex(code), ")");
}

WindowInput& InputOf(GLFWwindow* window) {
  return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

void OnKey(GLFWwindow* window, int key, int, int action, int) {
  if (action != GLFW_PRESS) return;
  WindowInput& input = InputOf(window);
  if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
  if (key == GLFW_KEY_H) input.key_help = true;
  if (key == GLFW_KEY_P) input.key_picture = true;
  if (key == GLFW_KEY_O) input.key_orbit = true;
  if (key == GLFW_KEY_TAB) input.key_panel = true;
  if (key == GLFW_KEY_C) input.key_follow = true;
  if (key == GLFW_KEY_B) input.skipper.spawn = true;
  if (key == GLFW_KEY_SPACE) input.skipper.crate = true;
  if (key == GLFW_KEY_X) input.skipper.explode = true;
  if (key == GLFW_KEY_DELETE) input.skipper.remove = true;
}

void OnScroll(GLFWwindow* window, double, double y) {
  InputOf(window).wheel += static_cast<float>(y);
}

bool IsHeld(GLFWwindow* window, int key) { return glfwGetKey(window, key) == GLFW_PRESS; }

double Axis(GLFWwindow* window, int negative, int positive) {
  return (IsHeld(window, positive) ? 1.0 : 0.0) - (IsHeld(window, negative) ? 1.0 : 0.0);
}

}  // namespace

absl::StatusOr<std::unique_ptr<Window>> Window::Open(const std::string& title, int width,
                                                     int height) {
  glfwSetErrorCallback(OnError);
  if (glfwInit() != GLFW_TRUE) {
    return absl::UnavailableError(
        absl::StrCat("no display: ", g_last_error, "; draw to files with --headless --out=DIR"));
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  auto impl = std::make_unique<Impl>();
  impl->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (impl->window == nullptr) {
    glfwTerminate();
    return absl::UnavailableError(absl::StrCat("no OpenGL 3.3 window: ", g_last_error,
                                               "; draw to files with --headless --out=DIR"));
  }
  glfwMakeContextCurrent(impl->window);
  glfwSwapInterval(1);
  // A tap that falls between two slow pictures still counts.
  glfwSetInputMode(impl->window, GLFW_STICKY_KEYS, GLFW_TRUE);
  glfwSetWindowUserPointer(impl->window, &impl->input);
  glfwSetKeyCallback(impl->window, OnKey);
  glfwSetScrollCallback(impl->window, OnScroll);
  glfwGetCursorPos(impl->window, &impl->last_x, &impl->last_y);
  return std::unique_ptr<Window>(new Window(std::move(impl)));
}

Window::Window(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Window::~Window() {
  glfwDestroyWindow(impl_->window);
  glfwTerminate();
}

bool Window::ShouldClose() const { return glfwWindowShouldClose(impl_->window) == GLFW_TRUE; }

WindowInput Window::Poll() {
  impl_->input = {};
  glfwPollEvents();
  GLFWwindow* window = impl_->window;
  WindowInput input = impl_->input;
  double x = 0, y = 0;
  glfwGetCursorPos(window, &x, &y);
  input.pointer_pressed = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  if (input.pointer_pressed) {
    input.camera.turn_px = x - impl_->last_x;
    input.camera.tilt_px = y - impl_->last_y;
  }
  impl_->last_x = x;
  impl_->last_y = y;
  int window_width = 1, window_height = 1;
  glfwGetWindowSize(window, &window_width, &window_height);
  if (window_width > 0) {
    const double scale = static_cast<double>(width()) / window_width;
    input.pointer_x = static_cast<float>(x * scale);
    input.pointer_y = static_cast<float>(y * scale);
  }
  input.camera.forward = Axis(window, GLFW_KEY_S, GLFW_KEY_W);
  input.camera.right = Axis(window, GLFW_KEY_A, GLFW_KEY_D);
  input.camera.up = Axis(window, GLFW_KEY_Q, GLFW_KEY_E);
  input.camera.fast = IsHeld(window, GLFW_KEY_LEFT_SHIFT);
  input.camera.zoom = input.wheel;
  input.sun_up = Axis(window, GLFW_KEY_LEFT_BRACKET, GLFW_KEY_RIGHT_BRACKET);
  input.skipper.helm = {.ahead = IsHeld(window, GLFW_KEY_UP),
                        .astern = IsHeld(window, GLFW_KEY_DOWN),
                        .port = IsHeld(window, GLFW_KEY_LEFT),
                        .starboard = IsHeld(window, GLFW_KEY_RIGHT)};
  return input;
}

void Window::Present() { glfwSwapBuffers(impl_->window); }

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(impl_->window, &width, &height);
  return width;
}

int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(impl_->window, &width, &height);
  return height;
}

}  // namespace onesea::client
