#include "weft/evaluation/FitErrors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "weft/core/Color.h"

namespace weft {
namespace {

// One pair.
void add(TexelErrors& texel, glm::vec3 data, glm::vec3 model, Encoding encoding, bool grazing) {
  const glm::vec3 storedData = encode(encoding, data);
  const glm::vec3 storedModel = encode(encoding, model);
  texel.add({{&data, 1}, {&storedData, 1}}, {{&model, 1}, {&storedModel, 1}}, grazing);
}

TEST(FitErrors, AreTheMeanAbsoluteDifferencesOfEquation2) {
  // Two texels of two pairs. Linear luminance errors: .1 and .3, then .2 and .2.
  TexelErrors first;
  add(first, glm::vec3(0.5f), glm::vec3(0.4f), Encoding::Linear, false);
  add(first, glm::vec3(0.5f), glm::vec3(0.8f), Encoding::Linear, true);
  TexelErrors second;
  add(second, glm::vec3(1.0f), glm::vec3(0.8f), Encoding::Linear, false);
  add(second, glm::vec3(0.2f), glm::vec3(0.0f), Encoding::Linear, true);
  const FitErrors errors = summarize(std::array{first, second});
  const ErrorStatistics& linear = errors.of(ErrorSpace::Linear, ErrorMeasure::Luminance);
  EXPECT_NEAR(linear.average, 0.2, 1e-6);
  EXPECT_NEAR(linear.minimum, 0.2, 1e-6);
  EXPECT_NEAR(linear.maximum, 0.2, 1e-6);
  const double rms = std::sqrt((0.01 + 0.09 + 0.04 + 0.04) / 4.0);
  EXPECT_NEAR(linear.rootMeanSquare, rms, 1e-6);
  EXPECT_NEAR(linear.psnr, -20.0 * std::log10(rms), 1e-4);  // the largest value of the data is 1
  EXPECT_NEAR(errors.grazing, 0.25, 1e-6);
}

TEST(FitErrors, StoredLuminanceIsTheLuminanceOfEncodedValues) {
  const glm::vec3 data(0.8f, 0.1f, 0.0f);
  const glm::vec3 model(0.2f, 0.3f, 0.5f);
  TexelErrors texel;
  add(texel, data, model, Encoding::Gamma22, false);
  const auto stored = [](glm::vec3 c) {
    return 0.2126 * std::pow(c.x, 1 / 2.2) + 0.7152 * std::pow(c.y, 1 / 2.2) +
           0.0722 * std::pow(c.z, 1 / 2.2);
  };
  const FitErrors errors = summarize(std::array{texel});
  EXPECT_NEAR(errors.of(ErrorSpace::Stored, ErrorMeasure::Luminance).average,
              std::abs(stored(data) - stored(model)), 1e-5);
  EXPECT_NEAR(errors.of(ErrorSpace::Linear, ErrorMeasure::Rgb).average, (0.6 + 0.2 + 0.5) / 3.0, 1e-6);
}

TEST(FitErrors, ExtremesAreOverTexels) {
  std::array<TexelErrors, 3> texels;
  for (int i = 0; i < 3; ++i)
    add(texels[static_cast<std::size_t>(i)], glm::vec3(0.5f), glm::vec3(0.5f + 0.1f * static_cast<float>(i)),
        Encoding::Linear, false);
  const ErrorStatistics statistics = summarize(texels).of(ErrorSpace::Linear, ErrorMeasure::Rgb);
  EXPECT_NEAR(statistics.minimum, 0.0, 1e-7);
  EXPECT_NEAR(statistics.maximum, 0.2, 1e-6);
  EXPECT_NEAR(statistics.average, 0.1, 1e-6);
}

}  // namespace
}  // namespace weft
