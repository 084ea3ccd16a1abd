#pragma once

namespace weft::bench {

/// A headless OpenGL 4.5 context of the compatibility profile, which OpenSceneGraph's shaders with
/// gl_ModelViewProjectionMatrix need and HeadlessWindow does not make. Current when it is new.
class CompatibilityContext {
 public:
  CompatibilityContext();
  ~CompatibilityContext();
  CompatibilityContext(const CompatibilityContext&) = delete;
  CompatibilityContext& operator=(const CompatibilityContext&) = delete;

  void makeCurrent();

 private:
  void* display_;  // EGLDisplay
  void* context_;  // EGLContext
};

}  // namespace weft::bench
