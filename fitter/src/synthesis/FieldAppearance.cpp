#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <memory>

#include "BorderTexels.h"
#include "TexelValues.h"
#include "weft/core/Color.h"
#include "weft/reflectance/LoomModel.h"

namespace weft {
namespace {

/// Of a display: the steps of stored values that linear ones make are about as one over this root.
float displayWeight(float mean) {
  return 0.5f / std::sqrt(std::max(mean, 0.0f) + 0.02f);
}

/// `loom`: weights times a square root of the metric of the components, and base colours.
class LoomAppearance : public TexelValues {
 public:
  LoomAppearance(const ReflectanceField& field, const LoomModel& model, const std::vector<int>& views)
      : field_(field), components_(model.components()) {
    const ModelledLights lights = field.formula().modelledLights(field.description().lights);
    Eigen::MatrixXd metric = Eigen::MatrixXd::Zero(components_, components_);
    const Eigen::VectorXd mean = meanWeights();
    double color = 0.0, pairs = 0.0;
    for (const int view : views)
      for (std::size_t i = 0; i < lights.directions.size(); ++i) {
        if (lights.factors[i] <= 0.0f) continue;
        const float* m = lights.layers[static_cast<std::size_t>(view)].data() +
                         i * static_cast<std::size_t>(model.mapChannels());
        const Eigen::VectorXd component =
            Eigen::Map<const Eigen::VectorXf>(m, components_).cast<double>() * double{lights.factors[i]};
        const double y = component.dot(mean), weight = displayWeight(static_cast<float>(y));
        metric += weight * weight * component * component.transpose();
        color += weight * weight * y * y;
        pairs += 1.0;
      }
    // principalAppearance() takes the mean over values; a distance here is a mean over pairs.
    const double scale = (components_ + 3) / std::max(pairs, 1.0);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(metric * scale);
    root_ = (solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * solver.eigenvectors().transpose())
                .cast<float>();
    colorScale_ = static_cast<float>(std::sqrt(color * scale));
  }

  int width() const override { return field_.width(); }
  int height() const override { return field_.height(); }
  int count() const override { return components_ + 3; }

  void read(int x, int y, std::span<float> out) const override {
    const std::span<const float> numbers = field_.shared().texel(x, y);
    Eigen::Map<Eigen::VectorXf>(out.data(), components_) =
        root_ * Eigen::Map<const Eigen::VectorXf>(numbers.data() + 3, components_);
    for (int c = 0; c < 3; ++c)
      out[static_cast<std::size_t>(components_ + c)] =
          colorScale_ * std::sqrt(kLuminanceWeights[c]) * numbers[static_cast<std::size_t>(c)];
  }

 private:
  Eigen::VectorXd meanWeights() const {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(components_);
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x)
        for (int k = 0; k < components_; ++k) mean[k] += double{field_.shared().at(x, y, 3 + k)};
    return mean / (static_cast<double>(width()) * height());
  }

  const ReflectanceField& field_;
  int components_;
  Eigen::MatrixXf root_;
  float colorScale_ = 0.0f;
};

/// Other models: stored RGB of representative pairs.
class PairAppearance : public TexelValues {
 public:
  PairAppearance(const ReflectanceField& field, const std::vector<int>& views) : field_(field) {
    const std::vector<glm::vec3>& lights = field.description().lights;
    for (const int view : spread(views, 20))
      for (const std::size_t light : spread(indices(lights), 12))
        pairs_.push_back({field.description().views[static_cast<std::size_t>(view)], lights[light]});
  }

  int width() const override { return field_.width(); }
  int height() const override { return field_.height(); }
  int count() const override { return 3 * static_cast<int>(pairs_.size()); }

  void read(int x, int y, std::span<float> out) const override {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const glm::vec3 stored =
          encode(Encoding::Gamma22, field_.evaluate(x, y, pairs_[i].light, pairs_[i].view));
      for (int c = 0; c < 3; ++c) out[3 * i + static_cast<std::size_t>(c)] = stored[c];
    }
  }

 private:
  struct Pair {
    glm::vec3 view, light;
  };

  static std::vector<std::size_t> indices(const std::vector<glm::vec3>& lights) {
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (lights[i].z > 0.0f) above.push_back(i);
    return above;
  }

  /// Directions are sorted by polar angle, then azimuth: so these lie apart.
  template <class T>
  static std::vector<T> spread(const std::vector<T>& all, std::size_t wanted) {
    const std::size_t count = std::min(all.size(), wanted);
    std::vector<T> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
    return chosen;
  }

  const ReflectanceField& field_;
  std::vector<Pair> pairs_;
};

std::unique_ptr<TexelValues> valuesOf(const ReflectanceField& field, const std::vector<int>& views) {
  if (const auto* loom = dynamic_cast<const LoomModel*>(&field.model()); loom && !loom->hasGloss())
    return std::make_unique<LoomAppearance>(field, *loom, views);
  return std::make_unique<PairAppearance>(field, views);
}

}  // namespace

Result<AppearanceSample> appearanceOf(const ReflectanceField& field, const PolarRange& range) {
  const ReflectanceFieldDescription& description = field.description();
  const std::vector<int> views = viewsWithin(description.views, range);
  if (views.empty()) return fail("no view lies in the range of polar angles", description.source);
  WEFT_TRY(AppearanceSample sample, principalAppearance(*valuesOf(field, views), {}));
  sample.name = description.source;
  // Where relief moves texels, a fit has mixed opposite borders, which hides how unlike they are.
  const float shift = largestShift(field.model().registration(), description.views);
  sample.repeats = shift < 1.0f && repeats(sample.vectors);
  if (!sample.repeats) keepFromBorder(sample, shift);
  return sample;
}

}  // namespace weft
