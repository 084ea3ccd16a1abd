#pragma once

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string_view>

#include "TextFile.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Node.h"

namespace weft::test {

constexpr float kPi = std::numbers::pi_v<float>;

/// A square from -1 to 1 in the plane z = 0, facing +Z, with its texture upright.
inline std::shared_ptr<Mesh> square() {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh->normals.assign(4, {0, 0, 1});
  mesh->tangents.assign(4, {1, 0, 0, 1});
  mesh->texcoords = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh->indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// Looks at the square from the +Z side, so that it fills a square picture exactly.
inline Camera squareCamera() {
  Camera camera = Camera::lookAt({0, 0, 2}, {0, 0, 0});
  camera.verticalFieldOfView = 2.0f * std::atan(0.5f);
  return camera;
}

/// A geometry below a material.
inline std::shared_ptr<Node> dressed(std::shared_ptr<const Material> material,
                                     std::shared_ptr<const Mesh> mesh = square()) {
  auto node = std::make_shared<Node>(std::make_shared<MaterialGroup>(std::move(material)));
  node->addChild(std::make_shared<Geometry>(std::move(mesh)));
  return node;
}

}  // namespace weft::test
