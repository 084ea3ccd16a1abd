#include "models/LodFitter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "FitWeights.h"
#include "solvers/LightPolynomials.h"
#include "solvers/LightSpacing.h"
#include "solvers/PackedSamples.h"
#include "solvers/PairSubspace.h"
#include "weft/core/BatchEncoding.h"
#include "weft/reflectance/LightMaps.h"

namespace weft {
namespace {

// Coordinates beyond the components that are kept of a level: of Y, and of Cb and Cr.
constexpr std::array<std::size_t, 3> kCoordinates{56, 14, 14};
// Texels of the coarsest level, as multiples of the components.
constexpr std::size_t kTexelsAComponent = 2;

Eigen::VectorXf asVector(std::span<const float> numbers) {
  return Eigen::Map<const Eigen::VectorXf>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

// The coordinates of one channel, a row a texel.
Eigen::Map<const Eigen::MatrixXf, 0, Eigen::Stride<1, Eigen::Dynamic>> coordinatesOf(const NumberImage& image,
                                                                                     std::size_t first,
                                                                                     std::size_t count) {
  return {image.values.data() + first,
          static_cast<Eigen::Index>(image.texels()),
          static_cast<Eigen::Index>(count),
          {1, static_cast<Eigen::Index>(image.numbers)}};
}

}  // namespace

Result<std::unique_ptr<FieldFitter>> LodFitter::create(const FitProblem& problem) {
  return std::make_unique<LodFitter>(problem);
}

LodFitter::LodFitter(const FitProblem& problem)
    : problem_(problem), training_(problem.width, problem.height, pairs()), scales_(pairs(), 1.0f) {
  const ModelOptions& options = problem.model->options();
  const auto chroma = static_cast<std::size_t>(options.number("chroma"));
  channels_[0].components = static_cast<std::size_t>(options.number("components"));
  channels_[1] = {.components = chroma, .firstComponent = channels_[0].components};
  channels_[2] = {.components = chroma, .firstComponent = channels_[0].components + chroma};
}

void LodFitter::gather(int pass, TexelRun& texels, std::vector<double>& ofRow) const {
  pass == 0 ? gatherTraining(texels, ofRow) : gatherCoordinates(texels, ofRow);
}

Result<void> LodFitter::endPass(int pass, std::span<const std::vector<double>> ofRows) {
  if (pass == 0)
    findSubspace(ofRows);
  else
    makeLevels(coordinateImage(ofRows));
  return {};
}

float LodFitter::cosineOf(std::size_t pair) const {
  constexpr float kLowest = 0.02f;
  return problem_.cosineInModel ? 1.0f : std::max(problem_.lights[pair % problem_.lights.size()].z, kLowest);
}

std::span<const glm::vec3> LodFitter::valuesOf(const TexelSamples& samples) const {
  return problem_.weighted ? samples.linear : samples.stored;
}

void LodFitter::gatherTraining(TexelRun& texels, std::vector<double>& ofRow) const {
  std::vector<glm::vec3> values;
  for (int i = 0; i < texels.size(); ++i) {
    if (!training_.contains(texels.x() + i, texels.y())) continue;
    values.clear();
    for (const glm::vec3& value : valuesOf(texels.fitted(i))) values.push_back(yCbCrFromRgb(value));
    packSamples(floatsOf(std::span(values)), ofRow);
  }
}

// Of one channel, `[texel][pair]`.
std::vector<float> LodFitter::trainingOf(int channel, std::span<const std::vector<double>> ofRows) const {
  const std::size_t packed = packedSize(3 * pairs());
  std::vector<float> training;
  training.reserve(training_.count() * pairs());
  std::vector<glm::vec3> samples(pairs());
  for (const std::vector<double>& row : ofRows)
    for (std::size_t at = 0; at + packed <= row.size(); at += packed) {
      unpackSamples(std::span(row).subspan(at, packed), floatsOf(std::span(samples)));
      for (const glm::vec3& sample : samples) training.push_back(sample[channel]);
    }
  return training;
}

void LodFitter::findSubspace(std::span<const std::vector<double>> ofRows) {
  findMeans(ofRows);
  std::size_t firstCoordinate = 0;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    Channel& channel = channels_[c];
    std::vector<float> values = trainingOf(static_cast<int>(c), ofRows);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= scales_[i % pairs()];
    const Eigen::VectorXf mean = asVector(channel.mean).cwiseProduct(asVector(scales_));
    channel.basis = pairSubspace(values, {mean.data(), pairs()}, channel.components + kCoordinates[c]);
    channel.firstCoordinate = firstCoordinate;
    firstCoordinate += channel.coordinates();
    const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> terms =
        asVector(scales_).asDiagonal() * channel.basis;
    channel.projector.emplace(std::span(terms.data(), static_cast<std::size_t>(terms.size())),
                              channel.coordinates());
  }
}

// Of all training texels, and with them how pairs are weighed.
void LodFitter::findMeans(std::span<const std::vector<double>> ofRows) {
  std::array<std::vector<double>, 3> sums;
  for (std::size_t c = 0; c < sums.size(); ++c) {
    sums[c].resize(pairs());
    const std::vector<float> values = trainingOf(static_cast<int>(c), ofRows);
    for (std::size_t i = 0; i < values.size(); ++i)
      sums[c][i % pairs()] += double{values[i]} / static_cast<double>(training_.count());
  }
  std::vector<double> squaredWeights, cosines;
  for (std::size_t pair = 0; pair < pairs(); ++pair) {
    if (problem_.weighted) scales_[pair] = displayWeight(static_cast<float>(sums[0][pair]));
    squaredWeights.push_back(double{scales_[pair]} * double{scales_[pair]});
    cosines.push_back(double{cosineOf(pair)});
  }
  phong_ = fitPhongMean(problem_.views, problem_.lights, sums[0], squaredWeights, cosines,
                        sharpestExponent(problem_.lights));
  for (std::size_t c = 1; c < 3; ++c) {
    double products = 0.0, squares = 0.0;
    for (std::size_t pair = 0; pair < pairs(); ++pair) {
      products += squaredWeights[pair] * cosines[pair] * sums[c][pair];
      squares += squaredWeights[pair] * cosines[pair] * cosines[pair];
    }
    chroma_[c - 1] = static_cast<float>(products / squares);
  }
  for (std::size_t pair = 0; pair < pairs(); ++pair) {
    const glm::vec3 view = problem_.views[pair / problem_.lights.size()];
    const glm::vec3 light = problem_.lights[pair % problem_.lights.size()];
    channels_[0].mean.push_back(cosineOf(pair) * phong_.value(light, view));
    for (std::size_t c = 1; c < 3; ++c) channels_[c].mean.push_back(cosineOf(pair) * chroma_[c - 1]);
  }
}

void LodFitter::gatherCoordinates(TexelRun& texels, std::vector<double>& ofRow) const {
  const auto count = static_cast<std::size_t>(texels.size());
  std::array<std::vector<float>, 3> coordinates;
  std::vector<float> values(count * pairs());
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const glm::vec3> samples = valuesOf(texels.fitted(static_cast<int>(i)));
      for (std::size_t pair = 0; pair < pairs(); ++pair)
        values[i * pairs() + pair] =
            yCbCrFromRgb(samples[pair])[static_cast<int>(c)] - channels_[c].mean[pair];
    }
    coordinates[c].resize(count * channels_[c].coordinates());
    channels_[c].projector->project(values, coordinates[c]);
  }
  std::vector<float> ofTexel;
  for (std::size_t i = 0; i < count; ++i) {
    ofTexel.clear();
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const auto ofChannel =
          std::span(coordinates[c]).subspan(i * channels_[c].coordinates(), channels_[c].coordinates());
      ofTexel.insert(ofTexel.end(), ofChannel.begin(), ofChannel.end());
    }
    packSamples(ofTexel, ofRow);
  }
}

NumberImage LodFitter::coordinateImage(std::span<const std::vector<double>> ofRows) const {
  NumberImage image{
      problem_.width, problem_.height, channels_[2].firstCoordinate + channels_[2].coordinates(), {}};
  image.values.resize(image.texels() * image.numbers);
  const std::size_t packed = packedSize(image.numbers);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      unpackSamples(std::span(ofRows[static_cast<std::size_t>(y)])
                        .subspan(static_cast<std::size_t>(x) * packed, packed),
                    {image.at(x, y), image.numbers});
  return image;
}

// From the coarsest on, each from what is left of the one before as it is shown: so that no error
// of a coarser level is left to the picture.
void LodFitter::makeLevels(const NumberImage& coordinates) {
  const std::vector<NumberImage> pyramid =
      gaussianPyramid(coordinates, kTexelsAComponent * channels_[0].components);
  levels_.resize(pyramid.size());
  eigenBrdfs_.resize(pyramid.size());
  NumberImage coarser;
  for (std::size_t level = pyramid.size(); level-- > 0;) {
    NumberImage residual = pyramid[level];
    NumberImage shown = residual;
    if (coarser.values.empty())
      std::ranges::fill(shown.values, 0.0f);
    else
      shown = enlarged(coarser, residual.width, residual.height);
    for (std::size_t i = 0; i < residual.values.size(); ++i) residual.values[i] -= shown.values[i];
    makeLevel(level, residual, shown);
    coarser = std::move(shown);
  }
  makeTables();
}

// Adds what the level shows to what is shown.
void LodFitter::makeLevel(std::size_t level, const NumberImage& residual, NumberImage& shown) {
  levels_[level] = FloatImage(residual.width, residual.height, problem_.model->sharedChannels());
  for (int y = 0; y < residual.height; ++y)
    for (int x = 0; x < residual.width; ++x) std::ranges::fill(levels_[level].texel(x, y).first(3), 1.0f);
  eigenBrdfs_[level].resize(static_cast<Eigen::Index>(pairs()),
                            static_cast<Eigen::Index>(problem_.model->sharedParameters().size()));
  for (const Channel& channel : channels_) makeComponents(level, channel, residual, shown);
}

void LodFitter::makeComponents(std::size_t level, const Channel& channel, const NumberImage& residual,
                               NumberImage& shown) {
  const auto values = coordinatesOf(residual, channel.firstCoordinate, channel.coordinates());
  const Eigen::MatrixXd asDoubles = values.cast<double>();
  const Eigen::MatrixXd components =
      strongestEigenvectors(asDoubles.transpose() * asDoubles, channel.components);
  const Eigen::MatrixXf ofPairs =
      asVector(scales_).cwiseInverse().asDiagonal() * channel.basis * components.cast<float>();
  Eigen::MatrixXf weights = (asDoubles * components).cast<float>();
  for (Eigen::Index k = 0; k < components.cols(); ++k) {
    const float largest = weights.col(k).cwiseAbs().maxCoeff();
    const float scale = largest > 0.0f ? largest : 1.0f;
    const std::size_t number = channel.firstComponent + static_cast<std::size_t>(k);
    eigenBrdfs_[level].col(static_cast<Eigen::Index>(number)) = scale * ofPairs.col(k);
    for (Eigen::Index texel = 0; texel < weights.rows(); ++texel) {
      const float rounded = std::round(127.0f * weights(texel, k) / scale) / 127.0f;
      const std::size_t channels = 3 + problem_.model->sharedParameters().size();
      levels_[level].values()[static_cast<std::size_t>(texel) * channels + 3 + number] = rounded;
      weights(texel, k) = scale * rounded;
    }
  }
  const Eigen::MatrixXf added = weights * components.cast<float>().transpose();
  for (Eigen::Index texel = 0; texel < added.rows(); ++texel)
    for (Eigen::Index i = 0; i < added.cols(); ++i)
      shown.values[static_cast<std::size_t>(texel) * shown.numbers + channel.firstCoordinate +
                   static_cast<std::size_t>(i)] += added(texel, i);
}

void LodFitter::makeTables() {
  FloatImage mean(1, 1, problem_.model->tables()[1].channels);
  std::ranges::copy(std::array{phong_.ambient, phong_.diffuse, phong_.specular, phong_.exponent, chroma_[0],
                               chroma_[1], static_cast<float>(levels_.size())},
                    mean.texel(0, 0).begin());
  tables_["mean"] = std::move(mean);
  tables_["eigen_brdfs"] = eigenBrdfTable();
  const FloatImage& maps = tables_["eigen_brdfs"];
  const auto channels = static_cast<std::size_t>(maps.channelCount());
  tables_["light_polynomials"] =
      lightPolynomialTable(maps, static_cast<int>(levels_.size()), channels, channels);
  tables_["mean_polynomials"] = meanPolynomialTable();
}

// Without n.l, unless the model is to contain it.
FloatImage LodFitter::eigenBrdfTable() const {
  const std::vector<std::string> channels = problem_.model->sharedParameters();
  const LightMaps maps(problem_.lights);
  const std::size_t lights = problem_.lights.size(), numbers = channels.size();
  const int size = maps.size(), views = static_cast<int>(problem_.views.size());
  FloatImage table(size * views, size * static_cast<int>(levels_.size()), channels);
  tbb::parallel_for(0, views * static_cast<int>(levels_.size()), [&](int i) {
    const int view = i % views, level = i / views;
    const Eigen::MatrixXf& ofLevel = eigenBrdfs_[static_cast<std::size_t>(level)];
    std::vector<float> values(lights * numbers);
    for (std::size_t light = 0; light < lights; ++light) {
      const std::size_t pair = static_cast<std::size_t>(view) * lights + light;
      for (std::size_t k = 0; k < numbers; ++k)
        values[light * numbers + k] =
            ofLevel(static_cast<Eigen::Index>(pair), static_cast<Eigen::Index>(k)) / cosineOf(pair);
    }
    const std::vector<float> map = maps.filled(values, numbers);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        std::copy_n(map.data() + static_cast<std::size_t>(y * size + x) * numbers, numbers,
                    table.texel(view * size + x, level * size + y).begin());
  });
  table.roundToHalf();
  return table;
}

FloatImage LodFitter::meanPolynomialTable() const {
  const LightMaps maps(problem_.lights);
  const int size = maps.size();
  FloatImage ofViews(size * static_cast<int>(problem_.views.size()), size, {"Y"});
  for (int view = 0; view < static_cast<int>(problem_.views.size()); ++view) {
    std::vector<float> values;
    for (const glm::vec3 light : problem_.lights)
      values.push_back(phong_.value(light, problem_.views[static_cast<std::size_t>(view)]));
    const std::vector<float> map = maps.filled(values, 1);
    for (int i = 0; i < size * size; ++i)
      ofViews.at(view * size + i % size, i / size, 0) = map[static_cast<std::size_t>(i)];
  }
  return lightPolynomialTable(ofViews, 1, 1, 1);
}

void LodFitter::fit(TexelRun& texels, RunParameters& parameters) const {
  for (int i = 0; i < texels.size(); ++i)
    std::ranges::copy(levels_[0].texel(texels.x() + i, texels.y()), parameters.shared(i).begin());
}

std::vector<FieldLevel> LodFitter::levels(FieldLevel finest) const {
  std::vector<FieldLevel> levels;
  const Precision precision = finest.shared.precision();
  levels.push_back(std::move(finest));
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    FloatImage shared = levels_[i];
    if (precision == Precision::Half) shared.roundToHalf();
    levels.push_back({std::move(shared), {}});
  }
  return levels;
}

}  // namespace weft
