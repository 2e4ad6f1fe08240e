#pragma once

#include <epoxy/gl.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace onesea::render {

/// A linked GLSL 3.30 program made of embedded files (client/render/shaders/*.glsl).
class ShaderProgram {
 public:
  /// Concatenates the named files after "#version 330 core" and the definitions ("NAME value").
  /// Internal error with the driver's log if they do not compile or link.
  static absl::StatusOr<ShaderProgram> Build(const std::vector<std::string_view>& vertex_files,
                                             const std::vector<std::string_view>& fragment_files,
                                             const std::vector<std::string_view>& definitions = {});
  /// Two of it: SAMPLES 1 and SAMPLES 4, of each pixel.
  static absl::StatusOr<std::array<ShaderProgram, 2>> BuildForSamples(
      const std::vector<std::string_view>& vertex_files,
      const std::vector<std::string_view>& fragment_files,
      std::vector<std::string_view> definitions = {});
  /// From two complete texts.
  static absl::StatusOr<ShaderProgram> BuildText(const std::string& vertex,
                                                 const std::string& fragment);
  ShaderProgram() = default;
  ~ShaderProgram();
  ShaderProgram(ShaderProgram&& other) noexcept;
  ShaderProgram& operator=(ShaderProgram&& other) noexcept;

  void Use() const { glUseProgram(id_); }
  /// -1 (ignored by OpenGL) for a uniform that the compiler removed.
  GLint Uniform(const char* name) const { return glGetUniformLocation(id_, name); }
  /// Use() must have been called.
  void SetSampler(const char* name, int unit) const { glUniform1i(Uniform(name), unit); }

 private:
  explicit ShaderProgram(GLuint id) : id_(id) {}
  GLuint id_ = 0;
};

/// Binding point of the uniform block `Frame`, the same in every program.
inline constexpr GLuint kFrameBlockBinding = 0;

/// Text of an embedded shader; CHECKs that it exists. Written by embed_shaders.cmake.
std::string_view EmbeddedShader(std::string_view name);

}  // namespace onesea::render
