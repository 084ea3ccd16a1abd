#pragma once

#include <filesystem>
#include <functional>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "weft/core/Result.h"

struct GLFWwindow;

namespace weft {

/// A window on the desktop with a current OpenGL 4.5 core context, and Dear ImGui in it. One at a
/// time.
class ViewerWindow {
 public:
  /// What happens in the window, but for what Dear ImGui takes for itself. Keys and buttons are
  /// GLFW's.
  struct Listener {
    std::function<void(int key, int modifiers)> keyPressed;
    std::function<void(int button, int modifiers)> buttonPressed;
    std::function<void()> buttonReleased;
    /// How far it went, in heights of the window.
    std::function<void(glm::dvec2 movement)> cursorMoved;
    std::function<void(double steps)> scrolled;
    std::function<void(const std::vector<std::filesystem::path>&)> dropped;
    /// The window wants to be drawn again.
    std::function<void()> exposed;
  };

  /// Fails without a display, and where there is no OpenGL 4.5, saying what was found.
  static Result<std::unique_ptr<ViewerWindow>> create(int width, int height, const std::string& title);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  void setListener(Listener listener) { listener_ = std::move(listener); }
  /// Waits for something to happen, at most so many seconds, and tells the listener.
  void wait(double seconds);
  /// Lets a wait() on another thread end.
  static void wake();
  bool shouldClose() const;
  void close();
  void setTitle(const std::string& title);
  bool isKeyDown(int key) const;

  /// In pixels, 0 while it is minimised.
  glm::ivec2 framebufferSize() const;
  /// Begins Dear ImGui's frame, which finish() draws over what is in the framebuffer by then, and
  /// shows.
  void begin();
  void finish();

 private:
  explicit ViewerWindow(GLFWwindow* window) : window_(window) {}
  void listen();
  void prepareImGui();
  void moveCursor(glm::dvec2 place);

  GLFWwindow* window_;
  Listener listener_;
  glm::dvec2 cursor_{0.0};
  bool hasImGui_ = false;
};

}  // namespace weft
