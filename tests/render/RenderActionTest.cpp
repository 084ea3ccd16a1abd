#include "weft/scenegraph/RenderAction.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <thread>

#include "GlSnapshot.h"
#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/BlendChunk.h"
#include "weft/chunks/PolygonOffsetChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/materials/ChunkMaterial.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

using test::kPi;
using test::square;
using test::squareCamera;
using testing::HasSubstr;

/// Seen as `color` under the light of lit().
std::shared_ptr<LambertMaterial> matt(glm::vec3 color, float alpha = 1.0f) {
  return std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(color, alpha), nullptr});
}

/// A root with a light from the viewer.
std::shared_ptr<Node> lit() {
  return std::make_shared<Node>(std::make_shared<DirectionalLight>(glm::vec3(kPi)));
}

std::shared_ptr<Node> moved(std::shared_ptr<Node> child, glm::vec3 by, float scale = 1.0f) {
  auto node = std::make_shared<Node>(
      std::make_shared<Transform>(glm::scale(glm::translate(glm::mat4(1.0f), by), glm::vec3(scale))));
  node->addChild(std::move(child));
  return node;
}

glm::vec4 pixel(const FloatImage& image, int x, int y) {
  const auto texel = image.texel(x, y);
  return {texel[0], texel[1], texel[2], texel[3]};
}

#define EXPECT_COLOR(actual, r, g, b) \
  EXPECT_LT(glm::distance(glm::vec3(actual), glm::vec3(r, g, b)), 1e-3f) << #actual

class RenderActionTest : public test::GlTest {};

TEST_F(RenderActionTest, BackgroundIsWhatNothingCovers) {
  const FloatImage image = picture(Node(), 3, 2, {.background = {0.25f, 2.0f, -1.0f, 0.5f}});
  EXPECT_EQ(pixel(image, 2, 1), glm::vec4(0.25f, 2.0f, -1.0f, 0.5f));
  EXPECT_EQ(image.channels(), (std::vector<std::string>{"R", "G", "B", "A"}));
}

TEST_F(RenderActionTest, FirstRowOfThePictureIsItsTop) {
  auto root = lit();
  root->addChild(moved(test::dressed(matt({1, 0, 0})), {-0.5f, 0.5f, 0}, 0.5f));
  const FloatImage image = picture(*root);
  EXPECT_COLOR(pixel(image, 1, 1), 1, 0, 0);
  EXPECT_COLOR(pixel(image, 6, 1), 0, 0, 0);
  EXPECT_COLOR(pixel(image, 1, 6), 0, 0, 0);
}

TEST_F(RenderActionTest, OutermostMaterialGroupWins) {
  auto root = lit();
  root->addChild(std::make_shared<MaterialGroup>(matt({0, 1, 0})))->addChild(test::dressed(matt({1, 0, 0})));
  EXPECT_COLOR(pixel(picture(*root), 4, 4), 0, 1, 0);
}

TEST_F(RenderActionTest, OneCoreShowsUnderEveryNodeThatSharesIt) {
  const auto geometry = std::make_shared<Geometry>(square());
  auto group = std::make_shared<Node>(std::make_shared<MaterialGroup>(matt({1, 1, 1})));
  group->addChild(moved(std::make_shared<Node>(geometry), {-0.5f, 0, 0}, 0.25f));
  group->addChild(moved(std::make_shared<Node>(geometry), {0.5f, 0, 0}, 0.25f));
  auto root = lit();
  root->addChild(group);
  const FloatImage image = picture(*root);
  EXPECT_COLOR(pixel(image, 2, 4), 1, 1, 1);
  EXPECT_COLOR(pixel(image, 5, 4), 1, 1, 1);
  EXPECT_COLOR(pixel(image, 0, 4), 0, 0, 0);
  EXPECT_COLOR(pixel(image, 4, 4), 0, 0, 0);
}

TEST_F(RenderActionTest, WhatIsNearerHidesWhatIsBehindInAnyOrder) {
  for (const bool nearFirst : {false, true}) {
    auto root = lit();
    const auto near = moved(test::dressed(matt({1, 0, 0})), {0, 0, 0.5f});
    const auto behind = test::dressed(matt({0, 1, 0}));
    root->addChild(nearFirst ? near : behind);
    root->addChild(nearFirst ? behind : near);
    EXPECT_COLOR(pixel(picture(*root), 4, 4), 1, 0, 0);
  }
}

TEST_F(RenderActionTest, PolygonOffsetDecidesWhichOfTwoThingsInOnePlaneShows) {
  for (const bool decalFirst : {false, true})
    for (const float towardsViewer : {-1.0f, 1.0f}) {
      auto material = matt({1, 0, 0});
      material->setChunk(PolygonOffsetSlot,
                         std::make_shared<PolygonOffsetChunk>(towardsViewer, 4.0f * towardsViewer));
      auto root = lit();
      if (decalFirst) root->addChild(test::dressed(material));
      root->addChild(test::dressed(matt({0, 1, 0})));
      if (!decalFirst) root->addChild(test::dressed(material));
      EXPECT_COLOR(pixel(picture(*root), 4, 4), towardsViewer<0.0f, towardsViewer> 0.0f, 0);
    }
}

TEST_F(RenderActionTest, BlendedThingsAreDrawnLastAndFromBackToFront) {
  const auto glass = [](glm::vec3 color) {
    auto material = matt(color, 0.5f);
    material->setChunk(BlendSlot, std::make_shared<BlendChunk>());
    return test::dressed(material);
  };
  auto root = lit();
  root->addChild(moved(glass({1, 0, 0}), {0, 0, 0.5f}));
  root->addChild(moved(glass({0, 1, 0}), {0, 0, 0.25f}));
  root->addChild(test::dressed(matt({0, 0, 1})));
  EXPECT_COLOR(pixel(picture(*root), 4, 4), 0.5f, 0.25f, 0.25f);
}

TEST_F(RenderActionTest, LeavesGLAsItStartsUp) {
  const test::GlSnapshot before = test::takeGlSnapshot();
  auto texture = std::make_shared<Image>(3, 3, 3);
  auto root = lit();
  root->addChild(
      test::dressed(std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(1.0f), texture, true})));
  root->addChild(test::dressed(matt({1, 1, 1})));
  picture(*root);
  EXPECT_EQ(test::difference(test::takeGlSnapshot(), before), "");
}

TEST_F(RenderActionTest, MoreLightsThanTheShadersHaveAreAnError) {
  auto root = lit();
  root->addChild(test::dressed(matt({1, 1, 1})));
  for (int i = 0; i < 255; ++i) root->addChild(std::make_shared<PointLight>(glm::vec3(0.0f)));
  EXPECT_COLOR(pixel(picture(*root), 4, 4), 1, 1, 1);
  root->addChild(std::make_shared<PointLight>(glm::vec3(0.0f)));
  const auto rendered = renderer.render(context(), *root, squareCamera(), RenderTarget(4, 4));
  ASSERT_FALSE(rendered);
  EXPECT_THAT(rendered.error().what, HasSubstr("257 lights, at most 256"));
}

TEST_F(RenderActionTest, GeometryWithoutMaterialIsAnErrorThatNamesIt) {
  auto root = lit();
  root->addChild(std::make_shared<Geometry>(square()), "bare");
  const auto rendered = renderer.render(context(), *root, squareCamera(), RenderTarget(4, 4));
  ASSERT_FALSE(rendered);
  EXPECT_EQ(rendered.error().where, "bare");
}

TEST_F(RenderActionTest, GeometryWithoutTrianglesIsNothing) {
  auto root = lit();
  root->addChild(test::dressed(matt({1, 1, 1}), std::make_shared<Mesh>()));
  EXPECT_COLOR(pixel(picture(*root), 4, 4), 0, 0, 0);
}

TEST_F(RenderActionTest, GraphOfAnyDepthIsDrawn) {
  auto node = test::dressed(matt({1, 1, 1}));
  std::vector<std::shared_ptr<Node>> chain{node};  // lets them go one by one, not by recursion
  for (int i = 0; i < 100000; ++i) {
    auto parent = std::make_shared<Node>();
    parent->addChild(node);
    chain.push_back(node = std::move(parent));
  }
  auto root = lit();
  root->addChild(node);
  EXPECT_COLOR(pixel(picture(*root), 4, 4), 1, 1, 1);
  root.reset();
  node.reset();
  while (!chain.empty()) chain.pop_back();
}

TEST_F(RenderActionTest, TwoContextsDrawTheSameScene) {
  auto texture = std::make_shared<Image>(1, 1, 3);
  texture->bytes = {255, 0, 255};
  auto root = lit();
  root->addChild(test::dressed(std::make_shared<LambertMaterial>(LambertOptions{glm::vec4(1.0f), texture})));
  const auto other = test::valueOf(HeadlessWindow::create(true));
  const RenderTarget target(8, 8);  // one picture in each context, too
  for (int frame = 0; frame < 2; ++frame)
    for (HeadlessWindow* each : {window.get(), other.get()}) {
      each->makeCurrent();
      ASSERT_TRUE(renderer.render(each->context(), *root, squareCamera(), target));
      EXPECT_COLOR(pixel(target.read(each->context()), 4, 4), 1, 0, 1);
    }
}

TEST_F(RenderActionTest, SceneOutlivesEveryContext) {
  auto root = lit();
  root->addChild(test::dressed(matt({1, 1, 0})));
  picture(*root);
  window.reset();
  window = test::valueOf(HeadlessWindow::create(true));
  EXPECT_COLOR(pixel(picture(*root), 4, 4), 1, 1, 0);
  window.reset();
  root.reset();  // no context is current: a GL call would crash
}

TEST_F(RenderActionTest, ObjectsOfDestroyedOwnersAreDeletedInTheirContextAtItsNextFrame) {
  auto block = std::make_shared<UniformBlockChunk>(std::vector<std::byte>(16));
  block->activate(context(), uniformSlot(2));
  GLint buffer = 0;
  glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 2, &buffer);
  block->deactivate(context(), uniformSlot(2));
  ASSERT_TRUE(glIsBuffer(static_cast<GLuint>(buffer)));

  const auto other = test::valueOf(HeadlessWindow::create(true));  // is current now
  std::thread([&] { block.reset(); }).join();
  window->makeCurrent();
  EXPECT_TRUE(glIsBuffer(static_cast<GLuint>(buffer)));
  picture(Node());
  EXPECT_FALSE(glIsBuffer(static_cast<GLuint>(buffer)));
}

TEST_F(RenderActionTest, ObjectsOfManyOwnersAreDeletedInAFewFrames) {
  std::vector<std::unique_ptr<UniformBlockChunk>> blocks;
  std::vector<GLuint> buffers;
  for (int i = 0; i < 5000; ++i) {
    blocks.push_back(std::make_unique<UniformBlockChunk>(std::vector<std::byte>(16)));
    blocks.back()->activate(context(), uniformSlot(2));
    GLint buffer = 0;
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 2, &buffer);
    buffers.push_back(static_cast<GLuint>(buffer));
  }
  blocks.back()->deactivate(context(), uniformSlot(2));
  const auto left = [&] { return std::count_if(buffers.begin(), buffers.end(), glIsBuffer); };
  blocks.resize(10);
  EXPECT_EQ(left(), 5000);
  for (int frame = 0; frame < 20; ++frame) picture(Node());
  EXPECT_EQ(left(), 10);
}

TEST_F(RenderActionTest, ChangedChunkShowsInEveryContext) {
  auto material = std::make_shared<LambertMaterial>();
  const auto color = std::make_shared<UniformBlockChunk>(blockBytes(glm::vec4(1, 0, 0, 1)));
  material->setChunk(uniformSlot(2), color);
  auto root = lit();
  root->addChild(test::dressed(material));
  const auto other = test::valueOf(HeadlessWindow::create(true));
  const RenderTarget target(8, 8);
  for (const glm::vec4& next : {glm::vec4(1, 0, 0, 1), glm::vec4(0, 0, 1, 1)}) {
    color->set(blockBytes(next));
    for (HeadlessWindow* each : {window.get(), other.get()}) {
      each->makeCurrent();
      ASSERT_TRUE(renderer.render(each->context(), *root, squareCamera(), target));
      EXPECT_COLOR(pixel(target.read(each->context()), 4, 4), next.r, next.g, next.b);
    }
  }
}

TEST_F(RenderActionTest, GLErrorsComeBackFromRender) {
  glBindBuffer(GL_TEXTURE_2D, 0);  // no such target
  const auto rendered = renderer.render(context(), Node(), squareCamera(), RenderTarget(4, 4));
  ASSERT_FALSE(rendered);
  EXPECT_EQ(rendered.error().where, "OpenGL");
}

class RenderTargetTest : public test::GlTest {};

TEST_F(RenderTargetTest, NothingRenderedReadsAsZeros) {
  const FloatImage image = RenderTarget(3, 2).read(context());
  EXPECT_EQ(image.width(), 3);
  for (const float value : image.values()) EXPECT_EQ(value, 0.0f);
}

TEST_F(RenderTargetTest, DownsamplingAveragesBoxes) {
  auto root = lit();
  root->addChild(moved(test::dressed(matt({0.3f, 0.6f, 0.9f})), {0.3f, -0.2f, 0}, 0.6f));
  const RenderTarget target(12, 6, Precision::Float);
  ASSERT_TRUE(renderer.render(context(), *root, squareCamera(), target));
  const FloatImage full = target.read(context());
  const FloatImage small = target.read(context(), 3);
  ASSERT_EQ(small.width(), 4);
  ASSERT_EQ(small.height(), 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      for (int channel = 0; channel < 4; ++channel) {
        float sum = 0.0f;
        for (int i = 0; i < 9; ++i) sum += full.at(3 * x + i % 3, 3 * y + i / 3, channel);
        EXPECT_NEAR(small.at(x, y, channel), sum / 9.0f, 1e-6f);
      }
}

TEST_F(RenderTargetTest, HalfPicturesSayThatTheyAre) {
  const RenderTarget target(2, 2);
  ASSERT_TRUE(renderer.render(context(), Node(), squareCamera(), target, {.background = glm::vec4(0.1f)}));
  FloatImage image = target.read(context());
  EXPECT_EQ(image.precision(), Precision::Half);
  EXPECT_NEAR(image.at(0, 0, 0), 0.1f, 1e-4f);
  EXPECT_EQ(image.at(0, 0, 0), roundToHalf(image.at(0, 0, 0)));
}

TEST_F(RenderTargetTest, LargerThanTheGLAllowsIsAnError) {
  const RenderTarget target(context().limits().textureSize + 1, 1);
  const auto rendered = renderer.render(context(), Node(), squareCamera(), target);
  ASSERT_FALSE(rendered);
  EXPECT_THAT(rendered.error().what, HasSubstr("larger than"));
}

TEST_F(RenderTargetTest, TooLargeForGLsMemoryIsOneErrorThatSaysHowLargeItMayBe) {
  const int side = context().limits().targetSize;
  const RenderTarget target(side, side, Precision::Float);
  const auto prepared = target.prepare(context());
  if (prepared) GTEST_SKIP() << "there is memory for " << side << " x " << side;
  EXPECT_THAT(prepared.error().what,
              testing::MatchesRegex("a picture of .* pixels of floats is larger than the "
                                    "[0-9]+ x [0-9]+ that this OpenGL allows"));
  const auto rendered = renderer.render(context(), Node(), squareCamera(), target);
  ASSERT_FALSE(rendered);
  EXPECT_EQ(rendered.error().what, prepared.error().what) << "and not what GL says itself";
}

}  // namespace
}  // namespace weft
