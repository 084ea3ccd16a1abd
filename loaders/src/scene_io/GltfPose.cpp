#include "GltfPose.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "GltfAccessor.h"

namespace weft {
namespace {

/// Where a time lies between the keys of a channel.
struct KeyInterval {
  std::size_t first = 0;
  std::size_t second = 0;
  double share = 0.0;    ///< of the way from first to second
  double seconds = 0.0;  ///< between them
};

KeyInterval intervalAt(const std::vector<float>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time,
                                      [](double t, float key) { return t < static_cast<double>(key); });
  if (after == times.begin()) return {};
  const auto second = static_cast<std::size_t>(after - times.begin());
  if (after == times.end()) return {second - 1, second - 1, 0.0, 0.0};
  const double start = double{times[second - 1]}, seconds = double{*after} - start;
  return {second - 1, second, (time - start) / seconds, seconds};
}

/// The keys of a channel: `width` numbers each, of a cubic spline three times as many (tangent in,
/// value, tangent out).
struct Keys {
  std::vector<float> times;
  std::vector<float> values;
  std::size_t width;
  std::string interpolation;

  bool isSpline() const { return interpolation == "CUBICSPLINE"; }
  /// `part` of a spline's key: 0, 1, 2 as above.
  double at(std::size_t key, std::size_t k, std::size_t part = 1) const {
    return double{values[isSpline() ? (3 * key + part) * width + k : key * width + k]};
  }
};

std::vector<double> interpolate(const Keys& keys, double time) {
  const KeyInterval at = intervalAt(keys.times, time);
  std::vector<double> result(keys.width);
  const double t = keys.interpolation == "STEP" ? 0.0 : at.share;
  for (std::size_t k = 0; k < keys.width; ++k) {
    const double first = keys.at(at.first, k), second = keys.at(at.second, k);
    if (!keys.isSpline()) {
      result[k] = first + t * (second - first);
    } else {
      const double out = at.seconds * keys.at(at.first, k, 2), in = at.seconds * keys.at(at.second, k, 0);
      result[k] = (2 * t * t * t - 3 * t * t + 1) * first + (t * t * t - 2 * t * t + t) * out +
                  (3 * t * t - 2 * t * t * t) * second + (t * t * t - t * t) * in;
    }
  }
  return result;
}

glm::dquat quatFrom(const std::vector<double>& xyzw) {
  return glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
}

glm::dquat interpolateRotation(const Keys& keys, double time) {
  if (keys.interpolation != "LINEAR") return glm::normalize(quatFrom(interpolate(keys, time)));
  const KeyInterval at = intervalAt(keys.times, time);
  const auto keyAt = [&](std::size_t key) {
    return glm::normalize(quatFrom({keys.at(key, 0), keys.at(key, 1), keys.at(key, 2), keys.at(key, 3)}));
  };
  return glm::slerp(keyAt(at.first), keyAt(at.second), at.share);
}

Result<std::vector<float>> keyTimes(const GltfFile& file, const tinygltf::AnimationSampler& sampler) {
  WEFT_TRY(std::vector<float> times, readFloats(file, sampler.input, 1));
  if (std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end())
    return file.fail("the times of an animation do not increase");
  return times;
}

Result<Keys> keysOf(const GltfFile& file, const tinygltf::AnimationSampler& sampler,
                    const std::string& path) {
  if (sampler.interpolation != "LINEAR" && sampler.interpolation != "STEP" &&
      sampler.interpolation != "CUBICSPLINE")
    return file.fail("an animation has an interpolation that glTF does not know: " + sampler.interpolation);
  const std::size_t components = path == "rotation" ? 4 : path == "weights" ? 1 : 3;
  Keys keys{{}, {}, components, sampler.interpolation};
  WEFT_TRY(keys.times, keyTimes(file, sampler));
  WEFT_TRY(keys.values, readFloats(file, sampler.output, components));
  const std::size_t each = keys.times.size() * (keys.isSpline() ? 3 : 1);
  if (path == "weights") keys.width = keys.values.size() / each;
  if (keys.width == 0 || keys.values.size() != each * keys.width)
    return file.fail("an animation has not as many values as keys");
  return keys;
}

}  // namespace

Result<GltfPose> GltfPose::create(const GltfFile& file, const GltfOptions& options) {
  GltfPose pose(file);
  if (!options.time) return pose;
  const auto& animations = file.model.animations;
  const auto found = std::find_if(animations.begin(), animations.end(), [&](const auto& animation) {
    return options.animation.empty() || animation.name == options.animation;
  });
  if (found == animations.end())
    return file.fail(options.animation.empty() ? "the file has no animation"
                                               : "there is no animation \"" + options.animation + "\"");
  WEFT_TRY_VOID(pose.sample(*found, *options.time));
  return pose;
}

Result<void> GltfPose::sample(const tinygltf::Animation& animation, double time) {
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    if (channel.target_node < 0) continue;  // an extension's
    if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size())
      return file_->fail("an animation names a sampler that does not exist");
    WEFT_TRY_VOID(sample(channel, animation.samplers[static_cast<std::size_t>(channel.sampler)], time));
  }
  return {};
}

Result<void> GltfPose::sample(const tinygltf::AnimationChannel& channel,
                              const tinygltf::AnimationSampler& sampler, double time) {
  const std::string& path = channel.target_path;
  if (path != "translation" && path != "rotation" && path != "scale" && path != "weights")
    return {};  // an extension's
  WEFT_TRY(const Keys keys, keysOf(*file_, sampler, path));
  Sampled& sampled = sampled_[channel.target_node];
  if (path == "rotation") {
    sampled.rotation = interpolateRotation(keys, time);
    return {};
  }
  const std::vector<double> value = interpolate(keys, time);
  if (path == "translation") sampled.translation = {value[0], value[1], value[2]};
  if (path == "scale") sampled.scale = {value[0], value[1], value[2]};
  if (path == "weights") sampled.weights.assign(value.begin(), value.end());
  return {};
}

Result<glm::dmat4> GltfPose::matrix(int index) const {
  const tinygltf::Node& node = file_->model.nodes[static_cast<std::size_t>(index)];
  const auto failed = [&] {
    return file_->fail("node " + std::to_string(index) + " has a broken transform");
  };
  const auto sizeIs = [](const std::vector<double>& values, std::size_t size) {
    return values.empty() || values.size() == size;
  };
  if (!sizeIs(node.matrix, 16) || !sizeIs(node.translation, 3) || !sizeIs(node.rotation, 4) ||
      !sizeIs(node.scale, 3))
    return failed();
  glm::dmat4 matrix(1.0);
  if (!node.matrix.empty()) {
    for (std::size_t i = 0; i < 16; ++i)
      matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = node.matrix[i];
  } else {
    const auto vector = [](const std::vector<double>& values) {
      return glm::dvec3(values[0], values[1], values[2]);
    };
    glm::dvec3 translation(0.0), scale(1.0);
    glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
    if (!node.translation.empty()) translation = vector(node.translation);
    if (!node.rotation.empty()) rotation = quatFrom(node.rotation);
    if (!node.scale.empty()) scale = vector(node.scale);
    if (const auto found = sampled_.find(index); found != sampled_.end()) {
      if (found->second.translation) translation = *found->second.translation;
      if (found->second.rotation) rotation = *found->second.rotation;
      if (found->second.scale) scale = *found->second.scale;
    }
    matrix = glm::translate(matrix, translation) * glm::mat4_cast(glm::normalize(rotation));
    matrix = glm::scale(matrix, scale);
  }
  if (!isFinite(glm::mat4(matrix))) return failed();
  return matrix;
}

std::vector<float> GltfPose::morphWeights(int index) const {
  if (const auto found = sampled_.find(index); found != sampled_.end() && !found->second.weights.empty())
    return found->second.weights;
  const tinygltf::Node& node = file_->model.nodes[static_cast<std::size_t>(index)];
  const std::vector<double>& weights =
      node.weights.empty() ? file_->model.meshes[static_cast<std::size_t>(node.mesh)].weights : node.weights;
  return {weights.begin(), weights.end()};
}

Result<std::vector<GltfScene::Animation>> animationsOf(const GltfFile& file) {
  std::vector<GltfScene::Animation> animations;
  for (const tinygltf::Animation& animation : file.model.animations) {
    double last = 0.0;
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      WEFT_TRY(const std::vector<float> times, keyTimes(file, sampler));
      last = std::max(last, double{times.back()});
    }
    animations.push_back({animation.name, last});
  }
  return animations;
}

}  // namespace weft
