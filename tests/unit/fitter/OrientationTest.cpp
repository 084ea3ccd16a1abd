// That images are the right way round, proved on measured materials and on what is fitted to them:
// columns run along +x, rows against +y (docs/conventions.md says what each score means and what it
// came to).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "Relief.h"
#include "Samples.h"
#include "SomeViews.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::Axis;
using test::correlation;
using test::printed;
using test::valueOf;

constexpr double kPi = std::numbers::pi;

int indexOf(const std::vector<glm::vec3>& directions, double theta, double phi) {
  const glm::vec3 wanted = directionFromDegrees(theta, phi);
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (glm::distance(directions[i], wanted) < 1e-3f) return static_cast<int>(i);
  ADD_FAILURE() << "no direction " << theta << ", " << phi;
  return 0;
}

/// The indices of all directions of a polar angle, by azimuth.
std::vector<int> ring(const std::vector<glm::vec3>& directions, double theta) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (std::abs(degreesFromDirection(directions[i]).x - theta) < 0.5) indices.push_back(static_cast<int>(i));
  return indices;
}

double azimuth(glm::vec3 direction) {
  return std::atan2(static_cast<double>(direction.y), static_cast<double>(direction.x));
}

/// The luminance of a material in pictures: measured or fitted, 64 x 64 texels, for every view and
/// light.
struct Material {
  std::vector<glm::vec3> views;
  std::vector<glm::vec3> lights;
  std::function<FloatImage(int view, int light)> image;
};

Material measured(std::shared_ptr<const BtfSource> source) {
  const BtfDescription& d = source->description();
  const auto samples = std::make_shared<const SampleRows>(test::allRows(*source));
  return {d.views, d.lights, [samples, lights = d.lights.size()](int view, int light) {
            const std::size_t pair =
                static_cast<std::size_t>(view) * lights + static_cast<std::size_t>(light);
            FloatImage image(samples->columns(), samples->rows(), {"Y"});
            for (int y = 0; y < image.height(); ++y)
              for (int x = 0; x < image.width(); ++x)
                image.at(x, y, 0) = luminance(test::linearSample(*samples, x, y, pair));
            return image;
          }};
}

/// What is fitted to the top view and the views of polar angle 60.
Material fitted(std::shared_ptr<const BtfSource> source, const FitOptions& options) {
  std::vector<int> views = ring(source->description().views, 60);
  views.insert(views.begin(), 0);
  const test::SomeViews some(std::move(source), std::move(views));
  const auto field =
      std::make_shared<const ReflectanceField>(valueOf(fitReflectanceField(some, options)).field);
  return {field->description().views, field->description().lights, [field](int view, int light) {
            FloatImage image(field->width(), field->height(), {"Y"});
            const glm::vec3 l = field->description().lights[static_cast<std::size_t>(light)];
            for (int y = 0; y < image.height(); ++y)
              for (int x = 0; x < image.width(); ++x)
                image.at(x, y, 0) = luminance(field->evaluateLayer(x, y, view, l, {0, 0, 1}));
            return image;
          }};
}

FloatImage topView(const Material& material, double theta, double phi) {
  return material.image(0, indexOf(material.lights, theta, phi));
}

// --- Ribs, lights against views, shadows ---

/// The flank score with +x for growing columns, or with +y for growing rows: negative where rows
/// run against y.
double ribScore(const Material& material, Axis axis) {
  const bool columns = axis == Axis::Columns;
  return test::flankScore(topView(material, 30, columns ? 0 : 90), topView(material, 30, columns ? 180 : 270),
                          axis);
}

/// How the brightness of the top view under a ring of lights agrees with that of the ring of views
/// under the light from the top, their azimuths p exchanged for `turn` + `sign` p: light may travel
/// either way.
double reciprocity(const Material& material, double theta, int sign, double turn) {
  std::vector<double> byLight, byView;
  for (const int light : ring(material.lights, theta)) {
    const double phi = degreesFromDirection(material.lights[static_cast<std::size_t>(light)]).y;
    byLight.push_back(test::meanOf(material.image(0, light)));
    byView.push_back(test::meanOf(material.image(indexOf(material.views, theta, turn + sign * phi), 0)));
  }
  return correlation(byLight, byView);
}

/// The logarithm of how much darker than its middle an image is where it is dark.
double darkness(const FloatImage& image) {
  std::vector<float> values(image.values().begin(), image.values().end());
  const auto at = [&](double share) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), nth, values.end());
    return static_cast<double>(*nth);
  };
  return std::log(at(0.1) / at(0.5) + 1e-3);
}

/// By how much shadows are paler seen from the light than from opposite, for views near one axis;
/// what is typical of a view and of a light is taken off.
double hiddenShadows(const Material& material, Axis axis) {
  const std::vector<int> views = ring(material.views, 60);
  const std::vector<int> lights = ring(material.lights, 60);  // of the same directions
  const std::size_t n = views.size();
  std::vector<std::vector<double>> depth(n, std::vector<double>(n));
  std::vector<double> ofView(n), ofLight(n);
  for (std::size_t v = 0; v < n; ++v)
    for (std::size_t l = 0; l < n; ++l) {
      depth[v][l] = darkness(material.image(views[v], lights[l]));
      ofView[v] += depth[v][l] / static_cast<double>(n);
      ofLight[l] += depth[v][l] / static_cast<double>(n);
    }
  double sum = 0.0;
  int count = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const glm::vec3 d = material.views[static_cast<std::size_t>(views[v])];
    if (std::abs(axis == Axis::Columns ? d.x : d.y) < 0.8f * std::sqrt(1.0f - d.z * d.z)) continue;
    const std::size_t opposite = (v + n / 2) % n;
    sum += (depth[v][v] - ofLight[v]) - (depth[v][opposite] - ofLight[opposite]);
    ++count;
  }
  return sum / count;
}

// --- Parallax ---

constexpr int kMargin = 14;  // of the images' interior, which every shift leaves inside

/// The mean over (2 radius + 1)^2 texels, periodic.
FloatImage boxFiltered(const FloatImage& image, int radius) {
  const int w = image.width();
  const int h = image.height();
  FloatImage across(w, h, {"Y"});
  FloatImage result(w, h, {"Y"});
  const float scale = 1.0f / static_cast<float>(2 * radius + 1);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int i = -radius; i <= radius; ++i) across.at(x, y, 0) += scale * image.at((x + i + w) % w, y, 0);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int i = -radius; i <= radius; ++i) result.at(x, y, 0) += scale * across.at(x, (y + i + h) % h, 0);
  return result;
}

/// What is left of a view when brightness and slow changes are taken off, under 17 lights from all
/// around.
std::vector<FloatImage> detail(const Material& material, int view) {
  std::vector<int> lights{0};
  for (int k = 0; k < 6; ++k) lights.push_back(indexOf(material.lights, 30, 60 * k));
  for (int k = 0; k < 10; ++k) lights.push_back(indexOf(material.lights, 60, 36 * k));
  std::vector<FloatImage> details;
  for (const int light : lights) {
    FloatImage image = material.image(view, light);
    for (float& value : image.values()) value = std::log(std::max(value, 1e-3f));
    FloatImage fine = boxFiltered(image, 1);
    const FloatImage coarse = boxFiltered(image, 5);
    for (std::size_t i = 0; i < fine.values().size(); ++i) fine.values()[i] -= coarse.values()[i];
    details.push_back(std::move(fine));
  }
  return details;
}

/// The cosine between the interior of `top`, some columns of it, and `other` moved there from (dx,
/// dy) texels away.
float match(const FloatImage& top, const FloatImage& other, const std::vector<int>& columns, int dx, int dy) {
  float ab = 0.0f, aa = 0.0f, bb = 0.0f;
  const float* a = top.values().data();
  const float* b = other.values().data();
  for (int y = kMargin; y < top.height() - kMargin; ++y)
    for (const int x : columns) {
      const float p = a[y * top.width() + x];
      const float q = b[(y + dy) * top.width() + x + dx];
      ab += p * q;
      aa += p * p;
      bb += q * q;
    }
  return ab / std::sqrt(aa * bb);
}

float match(const std::vector<FloatImage>& top, const std::vector<FloatImage>& other,
            const std::vector<int>& columns, int dx, int dy) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < top.size(); ++i) sum += match(top[i], other[i], columns, dx, dy);
  return sum / static_cast<float>(top.size());
}

std::vector<int> interiorColumns(int width) {
  std::vector<int> columns;
  for (int x = kMargin; x < width - kMargin; ++x) columns.push_back(x);
  return columns;
}

/// How well the displacement of views of theta 60 against the top view follows what stands above
/// the plane of the texels: -tan theta (cos p, sin p), with x along the columns times `columnSign`,
/// y along the rows times `rowSign`.
class Parallax {
 public:
  explicit Parallax(const Material& material) {
    const std::vector<FloatImage> top = detail(material, 0);
    const std::vector<int> columns = interiorColumns(top[0].width());
    for (const int view : ring(material.views, 60)) {
      const std::vector<FloatImage> other = detail(material, view);
      float best = -1.0f;
      glm::vec2 shift(0.0f);
      for (int dy = -8; dy <= 8; ++dy)
        for (int dx = -8; dx <= 8; ++dx)
          if (const float value = match(top, other, columns, dx, dy); value > best) {
            best = value;
            shift = {dx, dy};
          }
      const glm::vec3 v = material.views[static_cast<std::size_t>(view)];
      shifts_.push_back(shift);
      expected_.push_back({-v.x / v.z, -v.y / v.z});
    }
  }

  double score(float columnSign, float rowSign) const {
    double ue = 0.0, uu = 0.0, ee = 0.0;
    for (std::size_t i = 0; i < shifts_.size(); ++i) {
      const glm::vec2 u = shifts_[i];
      const glm::vec2 e = expected_[i] * glm::vec2(columnSign, rowSign);
      ue += static_cast<double>(glm::dot(u, e));
      uu += static_cast<double>(glm::dot(u, u));
      ee += static_cast<double>(glm::dot(e, e));
    }
    return ue / std::sqrt(uu * ee);
  }

 private:
  std::vector<glm::vec2> shifts_, expected_;
};

/// The height above the plane of texels, in texels, at which some columns look alike in the top
/// view and in the views of polar angle `theta` from near +y and -y, columns running along +x and
/// rows against +y.
double heightOf(const Material& material, const std::vector<int>& columns, double theta) {
  constexpr int kSteps = 4;  // a texel
  constexpr int kHighest = 6;
  std::vector<double> agreement(2 * kHighest * kSteps + 1);
  const std::vector<FloatImage> top = detail(material, 0);
  for (const int view : ring(material.views, theta)) {
    const glm::vec3 v = material.views[static_cast<std::size_t>(view)];
    if (std::abs(std::sin(azimuth(v))) < 0.9) continue;
    const std::vector<FloatImage> other = detail(material, view);
    std::map<std::pair<int, int>, float> known;
    const auto at = [&](int dx, int dy) {
      const auto [entry, isNew] = known.try_emplace({dx, dy}, 0.0f);
      if (isNew) entry->second = match(top, other, columns, dx, dy);
      return entry->second;
    };
    for (std::size_t i = 0; i < agreement.size(); ++i) {
      const float height = static_cast<float>(i) / kSteps - static_cast<float>(kHighest);
      const glm::vec2 shift = glm::vec2(-v.x, v.y) * (height / v.z);
      const glm::vec2 corner = glm::floor(shift);
      const glm::vec2 t = shift - corner;
      const int x = static_cast<int>(corner.x);
      const int y = static_cast<int>(corner.y);
      agreement[i] += static_cast<double>(glm::mix(glm::mix(at(x, y), at(x + 1, y), t.x),
                                                   glm::mix(at(x, y + 1), at(x + 1, y + 1), t.x), t.y));
    }
  }
  const auto best = std::max_element(agreement.begin(), agreement.end());
  return static_cast<double>(best - agreement.begin()) / kSteps - kHighest;
}

/// By how many texels the crests, which are lit from both sides, stand above the valleys.
double reliefOf(const Material& material) {
  const std::vector<double> plus = test::profile(topView(material, 75, 0), Axis::Columns);
  const std::vector<double> minus = test::profile(topView(material, 75, 180), Axis::Columns);
  std::vector<double> both(plus.size());
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = std::min(plus[i], minus[i]);
  both = test::smoothed(both);
  std::vector<int> columns = interiorColumns(static_cast<int>(both.size()));
  std::sort(columns.begin(), columns.end(), [&](int a, int b) {
    return both[static_cast<std::size_t>(a)] < both[static_cast<std::size_t>(b)];
  });
  const auto third = static_cast<std::ptrdiff_t>(3 * columns.size() / 10);
  const std::vector<int> valleys(columns.begin(), columns.begin() + third);
  const std::vector<int> crests(columns.end() - third, columns.end());
  double relief = 0.0;
  for (const double theta : {45.0, 60.0})
    relief += 0.5 * (heightOf(material, crests, theta) - heightOf(material, valleys, theta));
  return relief;
}

// --- Blur by foreshortening ---

/// Where power spectra are compared: frequencies of 0.03 to 0.3 cycles a texel, as multiples of
/// 1/64.
struct Frequency {
  int x;  // along the columns
  int y;  // down the rows
  double squared() const { return x * x + y * y; }
};

std::vector<Frequency> comparedFrequencies(int size) {
  const int highest = static_cast<int>(0.3 * size);
  std::vector<Frequency> frequencies;
  for (int y = -highest; y <= highest; ++y)
    for (int x = -highest; x <= highest; ++x) {
      const double length = std::sqrt(x * x + y * y) / size;
      if (length > 0.03 && length < 0.3) frequencies.push_back({x, y});
    }
  return frequencies;
}

/// The power of an image's relative contrast at the frequencies, under a Hann window, for a
/// variance of 1.
class PowerSpectrum {
 public:
  explicit PowerSpectrum(int size)
      : size_(size), highest_(static_cast<int>(0.3 * size)), frequencies_(comparedFrequencies(size)) {
    for (int i = 0; i < size; ++i) {
      window_.push_back(0.5 - 0.5 * std::cos(2.0 * kPi * i / (size - 1)));
      wave_.push_back(std::polar(1.0, -2.0 * kPi * i / size));
    }
  }

  const std::vector<Frequency>& frequencies() const { return frequencies_; }

  std::vector<double> of(const FloatImage& image) const {
    const double mean = test::meanOf(image);
    double variance = 0.0;
    const int count = highest_ + 1;  // the spectrum of a real image is symmetric: x >= 0 is enough
    std::vector<std::complex<double>> rows(static_cast<std::size_t>(size_ * count));
    for (int y = 0; y < size_; ++y)
      for (int x = 0; x < size_; ++x) {
        const double contrast = static_cast<double>(image.at(x, y, 0)) / mean - 1.0;
        variance += contrast * contrast / (size_ * size_);
        const double windowed = contrast * window(x) * window(y);
        for (int k = 0; k < count; ++k) rows[index(y, k)] += windowed * wave(k * x);
      }
    std::map<std::pair<int, int>, double> power;
    for (int ky = -highest_; ky <= highest_; ++ky)
      for (int kx = 0; kx < count; ++kx) {
        std::complex<double> sum = 0.0;
        for (int y = 0; y < size_; ++y) sum += rows[index(y, kx)] * wave(ky * y);
        power[{kx, ky}] = power[{-kx, -ky}] = std::norm(sum) / variance;
      }
    std::vector<double> result;
    for (const Frequency f : frequencies_) result.push_back(power[{f.x, f.y}]);
    return result;
  }

 private:
  std::size_t index(int row, int k) const { return static_cast<std::size_t>(row * (highest_ + 1) + k); }
  double window(int i) const { return window_[static_cast<std::size_t>(i)]; }
  std::complex<double> wave(int i) const {
    return wave_[static_cast<std::size_t>((i % size_ + size_) % size_)];
  }

  int size_;
  int highest_;
  std::vector<Frequency> frequencies_;
  std::vector<double> window_;
  std::vector<std::complex<double>> wave_;
};

/// A view at 75 degrees is squeezed along its azimuth and stretched again when it is rectified, so
/// that its detail is missing along that direction.
class Foreshortening {
 public:
  explicit Foreshortening(const Material& material) {
    const PowerSpectrum spectrum(64);
    const std::vector<int> views = ring(material.views, 75);
    std::vector<std::vector<double>> logPower;
    for (const int view : views) {
      std::vector<double> sum(spectrum.frequencies().size());
      for (int light = 0; light < static_cast<int>(material.lights.size()); light += 3) {
        const std::vector<double> one = spectrum.of(material.image(view, light));
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i];
      }
      for (double& value : sum) value = std::log(value);
      logPower.push_back(std::move(sum));
      azimuths_.push_back(azimuth(material.views[static_cast<std::size_t>(view)]));
    }
    std::vector<double> mean(spectrum.frequencies().size());
    for (const auto& one : logPower)
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += one[i] / static_cast<double>(views.size());
    for (const auto& one : logPower) fit(spectrum.frequencies(), one, mean);
  }

  /// 1 where power is missing exactly along the azimuth of every view; y runs along the rows times
  /// `rowSign`.
  double score(double rowSign) const {
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < azimuths_.size(); ++i) {
      sum -= along_[i] * std::cos(2.0 * azimuths_[i]) + rowSign * across_[i] * std::sin(2.0 * azimuths_[i]);
      squares += along_[i] * along_[i] + across_[i] * across_[i];
    }
    return sum / std::sqrt(squares * static_cast<double>(azimuths_.size()));
  }

 private:
  // Least squares on kx^2 - ky^2 and 2 kx ky, which are orthogonal to each other and to all that is
  // round.
  void fit(const std::vector<Frequency>& frequencies, const std::vector<double>& power,
           const std::vector<double>& mean) {
    double along = 0.0, across = 0.0, alongSquares = 0.0, acrossSquares = 0.0;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const auto [x, y] = frequencies[i];
      const double a = x * x - y * y;
      const double b = 2 * x * y;
      along += a * (power[i] - mean[i]);
      across += b * (power[i] - mean[i]);
      alongSquares += a * a;
      acrossSquares += b * b;
    }
    along_.push_back(along / alongSquares);
    across_.push_back(across / acrossSquares);
  }

  std::vector<double> azimuths_, along_, across_;
};

// --- Tests ---

void expectParallax(const Material& material) {
  const Parallax parallax(material);
  EXPECT_GT(printed("parallax.rowsAgainstY", parallax.score(1, -1)), 0.9);
  EXPECT_LT(std::abs(printed("parallax.rowsAlongY", parallax.score(1, 1))), 0.4);
}

// Cast shadows fall away from the light: seen from the light they hide behind what casts them.
void expectHiddenShadows(const Material& material) {
  EXPECT_GT(printed("shadows.x", hiddenShadows(material, Axis::Columns)), 0.12);
  EXPECT_GT(printed("shadows.y", hiddenShadows(material, Axis::Rows)), 0.12);
}

void expectLitRibs(const Material& wool) {
  EXPECT_GT(printed("ribs.columns", ribScore(wool, Axis::Columns)), 0.7);
  EXPECT_LT(printed("ribs.rows", ribScore(wool, Axis::Rows)), -0.2);
}

/// Corduroy's pile leans: it is several times brighter from one side than from the other.
void expectLeaningPile(const Material& corduroy) {
  EXPECT_GT(
      printed("pile", test::meanOf(topView(corduroy, 60, 72)) / test::meanOf(topView(corduroy, 60, 252))),
      4.0);
}

void expectSharedFrame(const Material& corduroy, double theta) {
  const double same = printed("reciprocity", reciprocity(corduroy, theta, 1, 0));
  EXPECT_GT(same, 0.95);
  EXPECT_LT(printed("reciprocity.mirroredY", reciprocity(corduroy, theta, -1, 0)), -0.5);
  EXPECT_LT(printed("reciprocity.mirroredX", reciprocity(corduroy, theta, -1, 180)), same);
}

std::unique_ptr<BtfSource> open(const std::filesystem::path& file) {
  return valueOf(openBtf(file));
}

FitOptions optionsOf(const char* model) {
  FitOptions options;
  options.model.name = model;
  return options;
}

class OrientationTest : public testing::TestWithParam<const char*> {
 protected:
  std::string fileName() const { return std::string("ubo2003/") + GetParam() + ".zip"; }
};

TEST_P(OrientationTest, WhatStandsHighMovesAgainstTheView) {
  WEFT_DATA_FILE(file, fileName());
  expectParallax(measured(open(file)));
}

// A surface below the plane of its texels would move like one above it in a picture turned by 180
// degrees; so ask how crests move against valleys.
TEST_P(OrientationTest, CrestsMoveMoreThanValleys) {
  WEFT_DATA_FILE(file, fileName());
  EXPECT_GT(printed("relief", reliefOf(measured(open(file)))), 0.6);
}

TEST_P(OrientationTest, DetailIsMissingAlongTheAzimuthOfAView) {
  WEFT_DATA_FILE(file, fileName());
  const Foreshortening foreshortening(measured(open(file)));
  EXPECT_GT(printed("blur.rowsAgainstY", foreshortening.score(-1)), 0.85);
  EXPECT_LT(std::abs(printed("blur.rowsAlongY", foreshortening.score(1))), 0.3);
}

TEST_P(OrientationTest, ShadowsHideWhereTheViewIsTheLight) {
  WEFT_DATA_FILE(file, fileName());
  expectHiddenShadows(measured(open(file)));
}

INSTANTIATE_TEST_SUITE_P(Materials, OrientationTest, testing::Values("UBO_WOOL64", "UBO_CORDUROY64"),
                         [](const auto& test) { return std::string(test.param); });

TEST(OrientationOfWool, RibsAreBrightOnTheSideThatFacesTheLight) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_WOOL64.zip");
  expectLitRibs(measured(open(file)));
}

TEST(OrientationOfCorduroy, LightsAndViewsShareAFrameAndThePileLeans) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_CORDUROY64.zip");
  const Material corduroy = measured(open(file));
  expectSharedFrame(corduroy, 75);
  expectLeaningPile(corduroy);
}

TEST(OrientationOfFit, Wool) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_WOOL64.zip");
  const Material wool = fitted(open(file), optionsOf("rfp"));
  expectLitRibs(wool);
  expectParallax(wool);
  expectHiddenShadows(wool);
}

TEST(OrientationOfFit, WoolInLobes) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_WOOL64.zip");
  FitOptions options = optionsOf("rfnl");
  options.crop = Crop{0, 30, 64, 4};
  EXPECT_GT(printed("ribs.columns", ribScore(fitted(open(file), options), Axis::Columns)), 0.7);
}

TEST(OrientationOfFit, Corduroy) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_CORDUROY64.zip");
  const Material corduroy = fitted(open(file), optionsOf("rfp"));
  expectSharedFrame(corduroy, 60);
  expectLeaningPile(corduroy);
  expectParallax(corduroy);
  expectHiddenShadows(corduroy);
}

}  // namespace
}  // namespace weft
