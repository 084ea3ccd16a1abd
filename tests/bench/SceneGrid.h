#pragma once

#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <random>
#include <vector>

#include "weft/core/Image.h"
#include "weft/scenegraph/Mesh.h"

namespace weft::bench {

/// A box around the origin, each side with the whole image.
inline Mesh makeBox(glm::vec3 size) {
  Mesh mesh;
  for (int side = 0; side < 6; ++side) {
    glm::vec3 normal(0.0f), across(0.0f), along(0.0f);
    normal[side / 2] = across[(side / 2 + 1) % 3] = side % 2 == 0 ? 1.0f : -1.0f;
    along[(side / 2 + 2) % 3] = 1.0f;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      mesh.positions.push_back(0.5f * size * (normal + corner.x * across + corner.y * along));
      mesh.normals.push_back(normal);
      mesh.tangents.emplace_back(across, 1.0f);
      mesh.texcoords.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
    }
    for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3})
      mesh.indices.push_back(static_cast<std::uint32_t>(4 * side) + corner);
  }
  return mesh;
}

/// 100 x 100 transformed boxes in a plane with textured materials mixed at random: what both sides
/// draw.
class SceneGrid {
 public:
  static constexpr int kSide = 100;
  static constexpr int kMaterials = 10;
  static constexpr int kPicture = 256;
  static constexpr float kFieldOfView = 0.7f;
  static constexpr float kDistance = 150.0f;
  static constexpr float kNearDistance = 7.46f;  ///< from which 42 boxes are in the picture
  static constexpr glm::vec3 kTowardsLight{0.3713906764f, 0.5570860145f, 0.7427813527f};

  struct Item {
    glm::mat4 place;
    std::size_t mesh;
    std::size_t material;
  };

  explicit SceneGrid(bool shared) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    if (shared) meshes.push_back(std::make_shared<Mesh>(makeBox(glm::vec3(0.7f))));
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        if (!shared)
          meshes.push_back(std::make_shared<Mesh>(makeBox({0.6f + 0.2f * unit(random), 0.7f, 0.7f})));
        const glm::vec2 corner(0.5f * (kSide - 1));
        const glm::vec3 position(glm::vec2(x, y) - corner, 0.0f);
        const glm::vec3 axis = glm::normalize(glm::vec3(unit(random), unit(random), unit(random)) - 0.3f);
        items.push_back({glm::rotate(glm::translate(glm::mat4(1.0f), position), 6.0f * unit(random), axis),
                         meshes.size() - 1,
                         static_cast<std::size_t>(kMaterials * unit(random)) % kMaterials});
      }
    for (int i = 0; i < kMaterials; ++i) {
      auto image = std::make_shared<Image>(64, 64, 3);
      const int red = static_cast<int>(random() % 128), green = static_cast<int>(random() % 128);
      for (std::size_t k = 0; k < image->bytes.size(); ++k)
        image->bytes[k] = static_cast<std::uint8_t>((k % 3 == 0   ? red
                                                     : k % 3 == 1 ? green
                                                                  : 64) +
                                                    random() % 128);
      images.push_back(std::move(image));
    }
  }

  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<Item> items;
};

/// Milliseconds by the clock, and of processor time on all threads, which other work on the machine
/// disturbs less.
struct FrameTime {
  double clock;
  double processor;
};

/// Runs `draw` until GL has finished it; `discard`: nothing is rasterized.
FrameTime timed(bool discard, const std::function<void()>& draw);

/// One of the two scene graphs, with a context of its own and a picture of half floats.
class Side {
 public:
  virtual ~Side() = default;

  virtual void makeCurrent() = 0;
  /// Sees all boxes, or a few.
  virtual void look(bool all) = 0;
  virtual FrameTime frame(bool discard) = 0;
  /// The red, green and blue of a frame, row by row from the bottom.
  virtual std::vector<float> picture() = 0;
  /// Prints what a frame consists of.
  virtual void explain() {}
};

}  // namespace weft::bench
