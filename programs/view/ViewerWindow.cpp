#include "ViewerWindow.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

namespace weft {
namespace {

constexpr float kFontSize = 13.0f;  // pixels of Dear ImGui's own font

std::string latestError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason was given";
}

/// What OpenGL a window gets that asks for none.
std::string foundOpenGl() {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  GLFWwindow* window = glfwCreateWindow(16, 16, "", nullptr, nullptr);
  if (!window) return "this display has no OpenGL at all: " + latestError();
  glfwMakeContextCurrent(window);
  const auto text = [](GLenum name) { return reinterpret_cast<const char*>(glGetString(name)); };
  const std::string found = fmt::format("this display has {} ({})", text(GL_VERSION), text(GL_RENDERER));
  glfwDestroyWindow(window);
  return found;
}

}  // namespace

Result<std::unique_ptr<ViewerWindow>> ViewerWindow::create(int width, int height, const std::string& title) {
  const char* hint = "weft-render draws pictures without a window";
  if (!glfwInit()) return fail("no window can be opened: " + latestError(), {}, hint);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the scene is drawn into a picture of its own
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window) {
    const std::string found = foundOpenGl();
    glfwTerminate();
    return fail("a window needs OpenGL 4.5, and " + found, {}, hint);
  }
  glfwMakeContextCurrent(window);
  std::unique_ptr<ViewerWindow> made(new ViewerWindow(window));
  made->listen();
  made->prepareImGui();
  return made;
}

ViewerWindow::~ViewerWindow() {
  if (hasImGui_) {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  glfwDestroyWindow(window_);
  glfwTerminate();
}

// Dear ImGui's own callbacks, which are set later, call these.
void ViewerWindow::listen() {
  glfwSetWindowUserPointer(window_, this);
  static constexpr auto self = [](GLFWwindow* window) {
    return static_cast<ViewerWindow*>(glfwGetWindowUserPointer(window));
  };
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action == GLFW_PRESS && !ImGui::GetIO().WantTextInput)
      self(window)->listener_.keyPressed(key, modifiers);
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
    if (action == GLFW_RELEASE)
      self(window)->listener_.buttonReleased();
    else if (!ImGui::GetIO().WantCaptureMouse)
      self(window)->listener_.buttonPressed(button, modifiers);
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    self(window)->moveCursor({x, y});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
    if (!ImGui::GetIO().WantCaptureMouse) self(window)->listener_.scrolled(steps);
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** names) {
    self(window)->listener_.dropped({names, names + count});
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { self(window)->listener_.exposed(); });
  glfwSetFramebufferSizeCallback(window_,
                                 [](GLFWwindow* window, int, int) { self(window)->listener_.exposed(); });
}

void ViewerWindow::moveCursor(glm::dvec2 place) {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  const glm::dvec2 movement = place - std::exchange(cursor_, place);
  listener_.cursorMoved(movement / static_cast<double>(std::max(height, 1)));
}

void ViewerWindow::prepareImGui() {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // no file is left where the program runs
  ImGui::StyleColorsDark();
  float scale = 1.0f, vertical = 1.0f;
  glfwGetWindowContentScale(window_, &scale, &vertical);
  ImFontConfig font;
  font.SizePixels = kFontSize * scale;
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  ImGui::GetStyle().ScaleAllSizes(scale);
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 450");
  hasImGui_ = true;
}

void ViewerWindow::wait(double seconds) {
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

void ViewerWindow::wake() {
  glfwPostEmptyEvent();
}

bool ViewerWindow::shouldClose() const {
  return glfwWindowShouldClose(window_) != 0;
}

void ViewerWindow::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void ViewerWindow::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

bool ViewerWindow::isKeyDown(int key) const {
  return glfwGetKey(window_, key) == GLFW_PRESS;
}

glm::ivec2 ViewerWindow::framebufferSize() const {
  glm::ivec2 size;
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

void ViewerWindow::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void ViewerWindow::finish() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
}

}  // namespace weft
