#include <glm/gtc/matrix_transform.hpp>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/materials/ChunkMaterial.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

struct VertexFrame {
  glm::vec3 t, b, n;
};

/// What shaders/mesh.vert and shaders/tangent_frame.glsl make of a mesh.
class TangentFrameTest : public test::GlTest {
 protected:
  VertexFrame frameOf(std::shared_ptr<const Mesh> mesh, const glm::mat4& model = glm::mat4(1.0f)) {
    return {axis("t", mesh, model), axis("b", mesh, model), axis("n", mesh, model)};
  }

  glm::vec3 axis(const char* name, const std::shared_ptr<const Mesh>& mesh, const glm::mat4& model) {
    test::writeText(folder / "frame.frag",
                    "#version 450 core\n#include \"tangent_frame.glsl\"\n"
                    "in vec3 position, normal, tangent;\nflat in float handedness;\nout vec4 color;\n"
                    "void main() {\n  TangentFrame frame = tangentFrame(normal, tangent, handedness, "
                    "!gl_FrontFacing);\n  color = vec4(frame.AXIS, 1.0);\n}\n");
    auto material = std::make_shared<ChunkMaterial>();
    material->setChunk(ProgramSlot, std::make_shared<ProgramChunk>(ShaderSource{
                                        "mesh.vert", "frame.frag", {{"AXIS", name}}, {}, folder}));
    material->setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::None));
    Node root(std::make_shared<Transform>(model));
    root.addChild(test::dressed(material, mesh));
    const FloatImage image = picture(root, 2, 2);
    EXPECT_EQ(image.at(0, 0, 3), 1.0f);
    return {image.at(0, 0, 0), image.at(0, 0, 1), image.at(0, 0, 2)};
  }

  std::filesystem::path folder = test::testFolder();
};

void expectSame(glm::vec3 actual, glm::vec3 expected) {
  EXPECT_LT(glm::distance(actual, expected), 1e-5f)
      << actual.x << ' ' << actual.y << ' ' << actual.z << " is not " << expected.x << ' ' << expected.y
      << ' ' << expected.z;
}

void expectOrthonormal(const VertexFrame& frame) {
  EXPECT_NEAR(glm::length(frame.t), 1.0f, 1e-5f);
  EXPECT_NEAR(glm::length(frame.b), 1.0f, 1e-5f);
  EXPECT_NEAR(glm::length(frame.n), 1.0f, 1e-5f);
  EXPECT_NEAR(glm::dot(frame.t, frame.b), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::dot(frame.t, frame.n), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::dot(frame.b, frame.n), 0.0f, 1e-5f);
}

TEST_F(TangentFrameTest, UprightSquareHasTheWorldAxes) {
  const VertexFrame frame = frameOf(test::square());
  expectSame(frame.t, {1, 0, 0});
  expectSame(frame.b, {0, 1, 0});
  expectSame(frame.n, {0, 0, 1});
}

TEST_F(TangentFrameTest, MirroredTextureTurnsTheTangentAndKeepsUpUp) {
  auto mesh = test::square();
  mesh->tangents.assign(4, {-1, 0, 0, -1});
  const VertexFrame frame = frameOf(mesh);
  expectSame(frame.t, {-1, 0, 0});
  expectSame(frame.b, {0, 1, 0});
  expectSame(frame.n, {0, 0, 1});
}

TEST_F(TangentFrameTest, MirroringTransformDoesTheSame) {
  const VertexFrame frame = frameOf(test::square(), glm::scale(glm::mat4(1.0f), glm::vec3(-2, 1, 1)));
  expectSame(frame.t, {-1, 0, 0});
  expectSame(frame.b, {0, 1, 0});
  expectSame(frame.n, {0, 0, 1});
}

TEST_F(TangentFrameTest, BehindOnlyTheNormalTurns) {
  const VertexFrame frame =
      frameOf(test::square(), glm::rotate(glm::mat4(1.0f), glm::radians(180.0f), {0, 1, 0}));
  expectSame(frame.t, {-1, 0, 0});
  expectSame(frame.b, {0, 1, 0});
  expectSame(frame.n, {0, 0, 1});
}

TEST_F(TangentFrameTest, SkewedAttributesBecomeOrthonormal) {
  auto mesh = test::square();
  mesh->normals.assign(4, glm::normalize(glm::vec3(0.3f, -0.2f, 0.9f)));
  mesh->tangents.assign(4, {0.8f, 0.1f, 0.7f, 1.0f});
  expectOrthonormal(frameOf(mesh, glm::scale(glm::mat4(1.0f), glm::vec3(1, 1.5f, 3))));
}

TEST_F(TangentFrameTest, TangentOfNoUseIsReplaced) {
  auto mesh = test::square();
  for (const glm::vec4& useless : {glm::vec4(0, 0, 0, 1), glm::vec4(0, 0, 1, 1), glm::vec4(0, 0, -1, -1)}) {
    mesh = std::make_shared<Mesh>(*mesh);
    mesh->tangents.assign(4, useless);
    const VertexFrame frame = frameOf(mesh);
    expectOrthonormal(frame);
    expectSame(frame.n, {0, 0, 1});
  }
}

}  // namespace
}  // namespace weft
