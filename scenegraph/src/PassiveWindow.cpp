#include "weft/scenegraph/PassiveWindow.h"

#include <epoxy/gl.h>

#include <optional>

#include "weft/chunks/GLName.h"
#include "weft/chunks/GLStateGuard.h"

namespace weft {

namespace {

/// What a part of the default framebuffer or of an own one is asked for.
GLenum firstDrawn() {
  GLint buffer = GL_NONE;
  glGetIntegerv(GL_DRAW_BUFFER0, &buffer);
  if (buffer == GL_BACK) return GL_BACK_LEFT;
  if (buffer == GL_FRONT || buffer == GL_LEFT || buffer == GL_FRONT_AND_BACK) return GL_FRONT_LEFT;
  return static_cast<GLenum>(buffer);
}

/// How colours must be written for the host's current framebuffer.
Encoding encodingToWrite() {
  const GLenum drawn = firstDrawn();
  if (drawn == GL_NONE) return Encoding::Linear;
  const auto property = [&](GLenum name) {
    GLint value = 0;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, drawn, name, &value);
    return value;
  };
  if (property(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE ||
      property(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT)
    return Encoding::Linear;
  const bool encodes =
      glIsEnabled(GL_FRAMEBUFFER_SRGB) && property(GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) == GL_SRGB;
  return encodes ? Encoding::Linear : Encoding::Srgb;
}

}  // namespace

Result<std::unique_ptr<PassiveWindow>> PassiveWindow::adopt() {
  if (!hasCurrentContext())
    return fail("no OpenGL context is current on this thread", {}, "make the host's context current first");
  if (!epoxy_is_desktop_gl() || epoxy_gl_version() < 45)
    return fail("the current context is below OpenGL 4.5",
                reinterpret_cast<const char*>(glGetString(GL_VERSION)), "ask for a newer one");
  return std::unique_ptr<PassiveWindow>(new PassiveWindow);
}

Result<void> PassiveWindow::render(const Node& root, const Camera& camera, HostState after) {
  if (glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return fail("the current framebuffer is not complete", "OpenGL");
  std::optional<GLStateGuard> guard;
  if (after == HostState::Restored) guard.emplace();
  const Encoding encoding = encodingToWrite();
  resetGLState();
  return renderer_.renderInPlace(context_, root, camera, encoding);
}

}  // namespace weft
