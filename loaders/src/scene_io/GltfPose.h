#pragma once

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <vector>

#include "GltfFile.h"
#include "weft/scene_io/GltfLoader.h"

namespace weft {

/// Where the nodes of a file stand, each in its parent, and how much of each morph target is in
/// their meshes: as modelled, or as an animation has it at one time.
class GltfPose {
 public:
  /// Samples the animation that the options name. `file` must outlive this.
  static Result<GltfPose> create(const GltfFile& file, const GltfOptions& options);

  /// Child to parent. Fails on what floats cannot hold.
  Result<glm::dmat4> matrix(int node) const;
  /// One weight a morph target of the node's mesh; may be too few, the others are 0.
  std::vector<float> morphWeights(int node) const;

 private:
  /// What an animation says instead of the node.
  struct Sampled {
    std::optional<glm::dvec3> translation{};
    std::optional<glm::dquat> rotation{};
    std::optional<glm::dvec3> scale{};
    std::vector<float> weights{};
  };

  explicit GltfPose(const GltfFile& file) : file_(&file) {}
  Result<void> sample(const tinygltf::Animation& animation, double time);
  Result<void> sample(const tinygltf::AnimationChannel& channel, const tinygltf::AnimationSampler& sampler,
                      double time);

  const GltfFile* file_;
  std::map<int, Sampled> sampled_;
};

/// The names and lengths of all animations.
Result<std::vector<GltfScene::Animation>> animationsOf(const GltfFile& file);

}  // namespace weft
