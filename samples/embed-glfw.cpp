// Weft in a program of raw OpenGL, whose own ring goes around Weft's ball: embed-glfw wool.rf.exr
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <cstdio>

#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/PassiveWindow.h"
#include "weft/scenegraph/Shapes.h"

constexpr const char* kVertexShader = R"(#version 450
uniform mat4 viewProjection;
out gl_PerVertex { vec4 gl_Position; };
void main() {
  float angle = gl_VertexID / 2 * 0.0981747704, radius = 1.15 + 0.25 * (gl_VertexID % 2);
  gl_Position = viewProjection * vec4(radius * cos(angle), 0, radius * sin(angle), 1);
})";
constexpr const char* kFragmentShader = "#version 450\nout vec4 c; void main() { c = vec4(1, 0.6, 0, 1); }";

weft::Result<void> run(GLFWwindow* window, const char* field) {
  WEFT_TRY(const auto passive, weft::PassiveWindow::adopt());
  WEFT_TRY(const auto material, weft::loadBTFMaterial(field, {.textureScale = glm::vec2(12)}));
  weft::Node ball(std::make_shared<weft::MaterialGroup>(material));
  ball.addChild(std::make_shared<weft::Geometry>(std::make_shared<weft::Mesh>(weft::makeSphere())));
  ball.addChild(std::make_shared<weft::DirectionalLight>(glm::vec3(3)));
  const weft::Camera camera = weft::Camera::lookAt({2, 2, 4}, {0, 0, 0});

  GLuint pipeline = 0;  // the program's own state is set once: Weft leaves it as it is
  const GLuint vertexProgram = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &kVertexShader);
  const GLuint fragmentProgram = glCreateShaderProgramv(GL_FRAGMENT_SHADER, 1, &kFragmentShader);
  const glm::mat4 viewProjection = camera.projection(1) * camera.view;
  glProgramUniformMatrix4fv(vertexProgram, 0, 1, GL_FALSE, &viewProjection[0][0]);
  glGenProgramPipelines(1, &pipeline);
  glUseProgramStages(pipeline, GL_VERTEX_SHADER_BIT, vertexProgram);
  glUseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT, fragmentProgram);
  glBindProgramPipeline(pipeline);
  glEnable(GL_DEPTH_TEST);
  for (; !glfwWindowShouldClose(window); glfwPollEvents()) {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 66);  // half of the ring before Weft, half after it
    WEFT_TRY_VOID(passive->render(ball, camera));
    glDrawArrays(GL_TRIANGLE_STRIP, 64, 66);
    glfwSwapBuffers(window);
  }
  return {};
}

int main(int argc, char** argv) {
  if (argc != 2 || !glfwInit()) return std::fputs("usage, on a display: embed-glfw NAME.rf.exr\n", stderr), 1;
  GLFWwindow* window = glfwCreateWindow(600, 600, "Weft", nullptr, nullptr);
  glfwMakeContextCurrent(window);
  const auto done = run(window, argv[1]);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
  glfwTerminate();
  return done ? 0 : 2;
}
