#include "client/render/gl_objects.h"

#include "common/base/check.h"

namespace onesea::render {

void ColorTarget::Resize(int new_width, int new_height, GLenum internal_format) {
  if (width == new_width && height == new_height) return;
  width = new_width;
  height = new_height;
  BindTexture(0, GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format), width, height, 0, GL_RGBA,
               GL_FLOAT, nullptr);
  SetSampling(GL_TEXTURE_2D, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
      << "format " << internal_format << " can't be drawn to at " << width << "x" << height;
}

void ColorTarget::Bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, width, height);
}

}  // namespace onesea::render
