// That relief is the right way round in the rendered picture: measured wool, baked hills whose
// every slope is known, and materials on mirrored and turned quads (docs/conventions.md).

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "BakedSource.h"
#include "GlTest.h"
#include "Relief.h"
#include "SomeViews.h"
#include "weft/core/Direction.h"
#include "weft/core/ImageComparison.h"
#include "weft/fitter/FieldFit.h"
#include "weft/io/ExrFile.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Tangents.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

constexpr float kFar = 1000.0f;  // so that all pixels see the same view

/// The square with other texture coordinates, and the frames that follow from them.
std::shared_ptr<const Mesh> squareWithTexture(std::vector<glm::vec2> texcoords) {
  auto mesh = square();
  mesh->texcoords = std::move(texcoords);
  mesh->tangents.clear();
  generateTangents(*mesh);
  return mesh;
}

/// Parallel light under which a white surface that faces it shows 1.
std::shared_ptr<Node> lightFrom(glm::vec3 direction) {
  const glm::mat4 toLight = glm::lookAt(direction, glm::vec3(0.0f), glm::vec3(0.1f, 0.99f, 0.0f));
  auto node = std::make_shared<Node>(std::make_shared<Transform>(glm::inverse(toLight)));
  node->addChild(std::make_shared<DirectionalLight>(glm::vec3(glm::pi<float>())));
  return node;
}

Camera cameraFrom(glm::vec3 direction, float distance) {
  Camera camera = Camera::lookAt(distance * direction, {0, 0, 0});
  camera.verticalFieldOfView = 2.0f * std::atan(1.0f / distance);
  camera.nearPlane = 0.5f * distance;
  camera.farPlane = 2.0f * distance;
  return camera;
}

constexpr int kTexels = 24;  // of what is baked

class ReliefPictureTest : public GlTest {
 protected:
  FloatImage render(std::shared_ptr<const Material> material, std::shared_ptr<const Mesh> mesh,
                    glm::vec3 light, const Camera& camera, int size) {
    Node root;
    root.addChild(dressed(std::move(material), std::move(mesh)));
    root.addChild(lightFrom(light));
    const RenderTarget target(size, size, Precision::Float);
    requireDone(renderer.render(context(), root, camera, target));
    return target.read(context());
  }

  /// The top view, a pixel a texel.
  FloatImage topView(const std::shared_ptr<const BTFMaterial>& material, double theta, double phi,
                     int texels = kTexels) {
    return luminanceOf(
        render(material, square(), directionFromDegrees(theta, phi), cameraFrom({0, 0, 1}, kFar), texels));
  }
};

std::shared_ptr<const BTFMaterial> materialOf(const BtfSource& source, const char* model) {
  FitOptions options;
  options.model.name = model;
  auto fit = valueOf(fitReflectanceField(source, options));
  return valueOf(BTFMaterial::create(std::make_shared<const ReflectanceField>(std::move(fit.field))));
}

TEST_F(ReliefPictureTest, WoolIsBrightOnTheSideThatFacesTheLight) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_WOOL64.zip");
  const SomeViews aroundTheTop(valueOf(openBtf(file)), {0, 1, 2, 3, 4, 5, 6});
  const auto wool = materialOf(aroundTheTop, "rfp");
  const auto lit = [&](double phi) { return topView(wool, 30, phi, aroundTheTop.description().width); };
  EXPECT_GT(printed("ribs.columns", flankScore(lit(0), lit(180), Axis::Columns)), 0.7);
  EXPECT_LT(printed("ribs.rows", flankScore(lit(90), lit(270), Axis::Rows)), -0.2);
}

// --- Baked hills ---

constexpr int kSamples = 4 * kTexels;

/// The smooth relief of a place, x to the right and y up, both with a period of 1, and how it rises
/// with x and y: without symmetry.
struct RoundHills {
  float height, alongX, alongY;

  static RoundHills at(float x, float y) {
    const float turn = glm::two_pi<float>();
    const float a = turn * x;
    const float b = turn * (2.0f * y + x);
    const float c = turn * (2.0f * x - y);
    return {0.04f * std::sin(a) + 0.02f * std::cos(b) + 0.015f * std::sin(c),
            turn * (0.04f * std::cos(a) - 0.02f * std::sin(b) + 0.03f * std::cos(c)),
            turn * (-0.04f * std::sin(b) - 0.015f * std::cos(c))};
  }
};

HeightField hills() {
  HeightField field(kSamples, kSamples, 1.0f / kSamples);
  for (int row = 0; row < kSamples; ++row)
    for (int column = 0; column < kSamples; ++column)
      field.at(column, row).height = RoundHills::at((static_cast<float>(column) + 0.5f) / kSamples,
                                                    -(static_cast<float>(row) + 0.5f) / kSamples)
                                         .height;
  return field;
}

std::vector<glm::vec3> rings(std::initializer_list<std::pair<int, int>> thetasAndCounts) {
  std::vector<glm::vec3> directions{{0, 0, 1}};
  for (const auto& [theta, count] : thetasAndCounts)
    for (int i = 0; i < count; ++i) directions.push_back(directionFromDegrees(theta, 360.0 * i / count));
  return directions;
}

BakeOptions fewDirections() {
  BakeOptions options;
  options.width = options.height = kTexels;
  options.bounces = 0;
  options.views = rings({{30, 8}, {60, 12}});
  options.lights = rings({{30, 8}, {60, 12}});
  return options;
}

/// How well brightness that depends on the side of a light follows a slope, over all pixels.
double slopeScore(const FloatImage& plus, const FloatImage& minus, float RoundHills::*slope) {
  std::vector<double> difference, descent;
  for (int y = 0; y < plus.height(); ++y)
    for (int x = 0; x < plus.width(); ++x) {
      const RoundHills place =
          RoundHills::at((static_cast<float>(x) + 0.5f) / static_cast<float>(plus.width()),
                         -(static_cast<float>(y) + 0.5f) / static_cast<float>(plus.height()));
      difference.push_back(static_cast<double>(plus.at(x, y, 0) - minus.at(x, y, 0)));
      descent.push_back(static_cast<double>(-(place.*slope)));
    }
  return correlation(difference, descent);
}

class BakedRelief : public ReliefPictureTest, public testing::WithParamInterface<const char*> {};

TEST_P(BakedRelief, IsBrightWhereTheSurfaceFacesTheLight) {
  const auto material = materialOf(BakedSource(hills(), fewDirections()), GetParam());
  const FloatImage fromPlusX = topView(material, 30, 0);
  const FloatImage fromMinusX = topView(material, 30, 180);
  const FloatImage fromPlusY = topView(material, 30, 90);
  const FloatImage fromMinusY = topView(material, 30, 270);
  EXPECT_GT(printed("hills.x", slopeScore(fromPlusX, fromMinusX, &RoundHills::alongX)), 0.95);
  EXPECT_GT(printed("hills.y", slopeScore(fromPlusY, fromMinusY, &RoundHills::alongY)), 0.95);
  EXPECT_LT(std::abs(slopeScore(fromPlusX, fromMinusX, &RoundHills::alongY)), 0.3);
  EXPECT_LT(std::abs(slopeScore(fromPlusY, fromMinusY, &RoundHills::alongX)), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Models, BakedRelief, testing::Values("rfp", "rfnl"),
                         [](const auto& test) { return std::string(test.param); });

/// Black but for a white plateau, whose middle is where (column, row) = (11, 14) begin.
HeightField plateau(float height) {
  HeightField field(kSamples, kSamples, 1.0f / kSamples);
  for (int row = 0; row < kSamples; ++row)
    for (int column = 0; column < kSamples; ++column) {
      const bool inside = column >= 32 && column < 56 && row >= 44 && row < 68;
      field.at(column, row).height = inside ? height : 0.0f;
      field.at(column, row).albedo = glm::vec3(inside ? 1.0f : 0.0f);
    }
  return field;
}

/// The middle of what is bright on the square, in texels to the right and down, as a camera sees
/// it.
glm::vec2 brightMiddle(const FloatImage& picture, const Camera& camera) {
  const glm::mat4 toClip = camera.projection(1.0f) * camera.view;
  constexpr int kSteps = 8;  // a texel
  glm::vec2 sum(0.0f);
  float weight = 0.0f;
  for (int y = 0; y < kTexels * kSteps; ++y)
    for (int x = 0; x < kTexels * kSteps; ++x) {
      const glm::vec2 texel((static_cast<float>(x) + 0.5f) / kSteps, (static_cast<float>(y) + 0.5f) / kSteps);
      const glm::vec4 clip =
          toClip * glm::vec4(2.0f * texel.x / kTexels - 1.0f, 1.0f - 2.0f * texel.y / kTexels, 0.0f, 1.0f);
      const auto pixel = [&](float ndc, int size) {
        return std::clamp(static_cast<int>((0.5f + 0.5f * ndc) * static_cast<float>(size)), 0, size - 1);
      };
      const float value =
          picture.at(pixel(clip.x / clip.w, picture.width()), pixel(-clip.y / clip.w, picture.height()), 0);
      sum += value * texel;
      weight += value;
    }
  return sum / weight;
}

// A plateau of height h is seen -h tan(theta) (cos phi, sin phi) from its place, y up.
TEST_F(ReliefPictureTest, WhatStandsHighMovesAgainstTheView) {
  constexpr float kHeight = 2.0f;  // texels
  BakeOptions options = fewDirections();
  options.lights = rings({{15, 6}});
  const auto material = materialOf(BakedSource(plateau(kHeight / kTexels), options), "rfp");
  float worst = 0.0f;
  for (const double theta : {0.0, 30.0, 60.0})
    for (const double phi : {0.0, 60.0, 90.0, 180.0, 270.0}) {
      const glm::vec3 v = directionFromDegrees(theta, phi);
      const Camera camera = cameraFrom(v, kFar);
      const FloatImage picture = render(material, square(), {0, 0, 1}, camera, 8 * kTexels);
      const glm::vec2 middle = brightMiddle(picture, camera);
      const glm::vec2 expected = glm::vec2(11.0f, 14.0f) + kHeight / v.z * glm::vec2(-v.x, v.y);
      worst = std::max(worst, glm::distance(middle, expected));
      EXPECT_LT(glm::distance(middle, expected), 0.3f)
          << theta << ", " << phi << ": " << middle.x << ", " << middle.y << ", not " << expected.x << ", "
          << expected.y;
    }
  printed("plateau.texelsOff", static_cast<double>(worst));
}

// --- Mirrored and turned quads ---

constexpr int kPixels = 96;

/// A picture whose pixel (x, y) is that of `picture` at place(x, y).
template <class Place>
FloatImage rearranged(const FloatImage& picture, Place place) {
  FloatImage result(picture.width(), picture.height(), picture.channels());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const auto [fromX, fromY] = place(x, y);
      std::ranges::copy(picture.texel(fromX, fromY), result.texel(x, y).begin());
    }
  return result;
}

/// Close to the square, which is seen up to 48 degrees from its normal; no pixel looks along a
/// border of the view lookup's texels, where rounding decides.
Camera closeCamera() {
  return cameraFrom({0, 0, 1}, 1.27f);
}

class TurnedQuad : public ReliefPictureTest {
 protected:
  void expectEqualPictures(const FloatImage& actual, const FloatImage& expected, const FloatImage& unturned) {
    EXPECT_LT(compareImages(actual, expected).maximum, 1e-3f);
    EXPECT_GT(compareImages(actual, unturned).mean, 0.01) << "could not fail";
    if (!HasFailure()) return;
    const auto folder = testFolder();
    requireDone(writeExr(folder / "actual.exr", actual));
    requireDone(writeExr(folder / "expected.exr", expected));
  }

  std::shared_ptr<const BTFMaterial> material = materialOf(BakedSource(hills(), fewDirections()), "rfp");
  glm::vec3 light = directionFromDegrees(50, 25);
};

TEST_F(TurnedQuad, MirroredTextureIsTheMirroredPicture) {
  const FloatImage upright = render(material, square(), light, closeCamera(), kPixels);
  const auto mirrored = squareWithTexture({{1, 1}, {0, 1}, {0, 0}, {1, 0}});
  const FloatImage actual = render(material, mirrored, {-light.x, light.y, light.z}, closeCamera(), kPixels);
  expectEqualPictures(actual, rearranged(upright, [](int x, int y) { return std::pair(kPixels - 1 - x, y); }),
                      upright);
}

TEST_F(TurnedQuad, TextureTurnedByAQuarterIsTheTurnedPicture) {
  const FloatImage upright = render(material, square(), light, closeCamera(), kPixels);
  // Counter-clockwise: the texture's right is up.
  const auto turned = squareWithTexture({{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  const FloatImage actual = render(material, turned, {-light.y, light.x, light.z}, closeCamera(), kPixels);
  expectEqualPictures(actual, rearranged(upright, [](int x, int y) { return std::pair(kPixels - 1 - y, x); }),
                      upright);
}

TEST_F(TurnedQuad, TextureTurnedByAQuarterAndMirroredIsThatPicture) {
  const FloatImage upright = render(material, square(), light, closeCamera(), kPixels);
  // u and v exchanged: mirrored at the diagonal from the upper left to the lower right.
  const auto exchanged = squareWithTexture({{1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const FloatImage actual =
      render(material, exchanged, {-light.y, -light.x, light.z}, closeCamera(), kPixels);
  expectEqualPictures(actual, rearranged(upright, [](int x, int y) { return std::pair(y, x); }), upright);
}

}  // namespace
}  // namespace weft::test
