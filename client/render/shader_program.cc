#include "client/render/shader_program.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"

namespace onesea::render {
namespace {

std::string Assemble(const std::vector<std::string_view>& files,
                     const std::vector<std::string_view>& definitions) {
  std::string text = "#version 330 core\n";
  for (std::string_view definition : definitions)
    text.append("#define ").append(definition).append("\n");
  for (std::string_view file : files) text.append("#line 1\n").append(EmbeddedShader(file));
  return text;
}

absl::StatusOr<GLuint> Compile(GLenum stage, const std::string& text) {
  const char* pointer = text.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &pointer, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok != 0) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  glDeleteShader(shader);
  return absl::InternalError(absl::StrCat("a shader does not compile: ", log, "\n", text));
}

}  // namespace

absl::StatusOr<ShaderProgram> ShaderProgram::Build(
    const std::vector<std::string_view>& vertex_files,
    const std::vector<std::string_view>& fragment_files,
    const std::vector<std::string_view>& definitions) {
  return BuildText(Assemble(vertex_files, definitions), Assemble(fragment_files, definitions));
}

absl::StatusOr<std::array<ShaderProgram, 2>> ShaderProgram::BuildForSamples(
    const std::vector<std::string_view>& vertex_files,
    const std::vector<std::string_view>& fragment_files,
    std::vector<std::string_view> definitions) {
  std::array<ShaderProgram, 2> programs;
  definitions.emplace_back();
  for (std::size_t n = 0; n < programs.size(); ++n) {
    definitions.back() = n == 0 ? "SAMPLES 1" : "SAMPLES 4";
    auto program = Build(vertex_files, fragment_files, definitions);
    if (!program.ok()) return program.status();
    programs[n] = std::move(*program);
  }
  return programs;
}

absl::StatusOr<ShaderProgram> ShaderProgram::BuildText(const std::string& vertex_text,
                                                       const std::string& fragment_text) {
  const absl::StatusOr<GLuint> vertex = Compile(GL_VERTEX_SHADER, vertex_text);
  if (!vertex.ok()) return vertex.status();
  const absl::StatusOr<GLuint> fragment = Compile(GL_FRAGMENT_SHADER, fragment_text);
  if (!fragment.ok()) {
    glDeleteShader(*vertex);
    return fragment.status();
  }
  ShaderProgram program(glCreateProgram());
  glAttachShader(program.id_, *vertex);
  glAttachShader(program.id_, *fragment);
  glLinkProgram(program.id_);
  glDeleteShader(*vertex);
  glDeleteShader(*fragment);
  GLint ok = 0;
  glGetProgramiv(program.id_, GL_LINK_STATUS, &ok);
  if (ok == 0) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program.id_, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return absl::InternalError(absl::StrCat("a shader program does not link: ", log));
  }
  const GLuint block = glGetUniformBlockIndex(program.id_, "Frame");
  if (block != GL_INVALID_INDEX) glUniformBlockBinding(program.id_, block, kFrameBlockBinding);
  return program;
}

ShaderProgram::~ShaderProgram() {
  if (id_ != 0) glDeleteProgram(id_);
}
ShaderProgram::ShaderProgram(ShaderProgram&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
ShaderProgram& ShaderProgram::operator=(ShaderProgram&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

}  // namespace onesea::render
