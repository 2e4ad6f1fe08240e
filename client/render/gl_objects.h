#pragma once

#include <epoxy/gl.h>

#include <utility>

/// Owners of OpenGL names. A context must be current when they are made and destroyed.
namespace onesea::render {

template <void (*kMake)(GLuint*), void (*kDelete)(GLuint)>
class GlName {
 public:
  GlName() { kMake(&id_); }
  ~GlName() {
    if (id_ != 0) kDelete(id_);
  }
  GlName(GlName&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

namespace internal {
inline void MakeTexture(GLuint* id) { glGenTextures(1, id); }
inline void DeleteTexture(GLuint id) { glDeleteTextures(1, &id); }
inline void MakeBuffer(GLuint* id) { glGenBuffers(1, id); }
inline void DeleteBuffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void MakeFramebuffer(GLuint* id) { glGenFramebuffers(1, id); }
inline void DeleteFramebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void MakeRenderbuffer(GLuint* id) { glGenRenderbuffers(1, id); }
inline void DeleteRenderbuffer(GLuint id) { glDeleteRenderbuffers(1, &id); }
inline void MakeVertexArray(GLuint* id) { glGenVertexArrays(1, id); }
inline void DeleteVertexArray(GLuint id) { glDeleteVertexArrays(1, &id); }
}  // namespace internal

using Texture = GlName<internal::MakeTexture, internal::DeleteTexture>;
using Buffer = GlName<internal::MakeBuffer, internal::DeleteBuffer>;
using Framebuffer = GlName<internal::MakeFramebuffer, internal::DeleteFramebuffer>;
using Renderbuffer = GlName<internal::MakeRenderbuffer, internal::DeleteRenderbuffer>;
using VertexArray = GlName<internal::MakeVertexArray, internal::DeleteVertexArray>;

inline void BindTexture(int unit, GLenum target, const Texture& texture) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, texture.id());
}

inline void SetSampling(GLenum target, GLint minify, GLint magnify, GLint wrap) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, minify);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, magnify);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, wrap);
}

/// Pixels from left to right and from bottom to top, the last ones not included.
struct PixelBox {
  int left = 0, bottom = 0, right = 0, top = 0;

  bool empty() const { return left >= right || bottom >= top; }
  void Scissor() const { glScissor(left, bottom, right - left, top - bottom); }
};

/// A linear-filtered 2-D colour target: texture and framebuffer of one size.
struct ColorTarget {
  Texture texture;
  Framebuffer framebuffer;
  int width = 0, height = 0;

  /// (Re)allocates when the size differs. CHECKs that the framebuffer is complete.
  void Resize(int new_width, int new_height, GLenum internal_format);
  void Bind() const;
};

}  // namespace onesea::render
