#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/core/ImageComparison.h"
#include "weft/io/ExrFile.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/reflectance/LayerLookup.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {

/// Pixels a side of pictures that are compared with the CPU's.
constexpr int kPictureSize = 128;

/// Turns a node's -Z, along which a directional light shines, against `towardsLight`.
inline glm::mat4 shiningFrom(glm::vec3 towardsLight) {
  const glm::vec3 z = glm::normalize(towardsLight);
  const glm::vec3 x =
      glm::normalize(glm::cross(std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), z));
  return {glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), glm::vec4(0, 0, 0, 1)};
}

/// A light under which a white surface that faces it shows 1.
inline std::shared_ptr<Node> unitLight(glm::vec3 towardsLight) {
  auto node = std::make_shared<Node>(std::make_shared<Transform>(shiningFrom(towardsLight)));
  node->addChild(std::make_shared<DirectionalLight>(glm::vec3(glm::pi<float>())));
  return node;
}

inline std::shared_ptr<Node> scene(std::shared_ptr<const Material> material, std::shared_ptr<const Mesh> mesh,
                                   glm::vec3 towardsLight) {
  auto root = std::make_shared<Node>();
  root->addChild(dressed(std::move(material), std::move(mesh)));
  root->addChild(unitLight(towardsLight));
  return root;
}

/// A tangent frame in the world: columns are T, B, N.
struct Frame {
  glm::mat3 axes;
  glm::vec3 toFrame(glm::vec3 world) const { return glm::transpose(axes) * world; }
};

/// The frame in which the square, seen from +Z, is seen from `view`.
inline Frame frameSeenFrom(glm::vec3 view) {
  const glm::vec3 other =
      glm::normalize(glm::cross(view, std::abs(view.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
  // tangent space: to X, Y, Z of the world
  const glm::mat3 local(other, glm::cross(view, other), view);
  return {glm::transpose(local)};
}

/// The square that fills the picture, shaded as if its surface were turned: every view at every
/// pixel without perspective.
inline std::shared_ptr<Mesh> squareWithFrame(const Frame& frame) {
  auto mesh = square();
  mesh->normals.assign(4, frame.axes[2]);
  mesh->tangents.assign(4, glm::vec4(frame.axes[0], 1.0f));
  return mesh;
}

inline glm::vec3 pixelPosition(int x, int y) {
  return {-1.0f + 2.0f * (static_cast<float>(x) + 0.5f) / kPictureSize,
          1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / kPictureSize, 0.0f};
}

/// The picture of such a square: `valueAt(x, y, view)` of each pixel.
template <class ValueAt>
FloatImage pictureOf(const Frame& frame, const ValueAt& valueAt) {
  FloatImage picture(kPictureSize, kPictureSize, {"R", "G", "B", "A"});
  for (int y = 0; y < kPictureSize; ++y)
    for (int x = 0; x < kPictureSize; ++x) {
      const glm::vec3 view = frame.toFrame(glm::normalize(glm::vec3(0, 0, 2) - pixelPosition(x, y)));
      const glm::vec3 value = valueAt(x, y, view);
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = value[c];
      picture.at(x, y, 3) = 1.0f;
    }
  return picture;
}

/// The layers that the shader finds for a light and a view.
inline auto layersOnTheGpu(const ReflectanceField& field) {
  const HemisphereTriangulation& triangulation = field.formula().triangulation();
  const bool hasLayers = field.formula().layerCount() > 0;
  return [&field, &triangulation, hasLayers,
          lookup = hasLayers ? LayerLookup::create(triangulation) : LayerLookup()](glm::vec3 light,
                                                                                   glm::vec3 view) {
    const bool ofViews = field.model().layerDirections() == LayerDirections::Views;
    return hasLayers ? lookup.locate(triangulation, ofViews ? view : light) : DirectionWeights();
  };
}

inline glm::vec3 randomDirection(std::mt19937& random, float lowest) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const float z = lowest + (1.0f - lowest) * unit(random);
  const float phi = 2.0f * glm::pi<float>() * unit(random);
  return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
}

class TurnedSquareTest : public GlTest {
 protected:
  void expectEqualPictures(const FloatImage& actual, const FloatImage& expected, float tolerance,
                           double failingShare = 0.0) {
    const ImageComparison comparison = compareImages(actual, expected, tolerance);
    EXPECT_LE(comparison.failingShare, failingShare) << "largest difference " << comparison.maximum;
    if (comparison.failingShare <= failingShare) return;
    const auto folder = testFolder();
    (void)writeExr(folder / "actual.exr", actual);
    (void)writeExr(folder / "expected.exr", expected);
    (void)writeExr(folder / "difference.exr", differenceImage(actual, expected));
    ADD_FAILURE() << "pictures are kept in " << folder;
  }

  FloatImage render(std::shared_ptr<const Material> material, const Frame& frame, glm::vec3 towardsLight) {
    return picture(*scene(std::move(material), squareWithFrame(frame), towardsLight), kPictureSize,
                   kPictureSize);
  }

  FloatImage render(const BTFMaterialOptions& options, std::shared_ptr<const ReflectanceField> field,
                    const Frame& frame, glm::vec3 towardsLight) {
    return render(valueOf(BTFMaterial::create(std::move(field), options)), frame, towardsLight);
  }
};

}  // namespace weft::test
