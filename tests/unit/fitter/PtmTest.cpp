// Polynomial texture maps of real photographs, against least squares by another route.
#include <gtest/gtest.h>

#include <Eigen/QR>

#include "TestSupport.h"
#include "weft/core/Color.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::valueOf;

Eigen::MatrixXd basisOf(const std::vector<glm::vec3>& lights) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(lights.size()), 6);
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const glm::dvec3 l = lights[static_cast<std::size_t>(i)];
    basis.row(i) << l.x * l.x, l.y * l.y, l.x * l.y, l.x, l.y, 1.0;
  }
  return basis;
}

class PtmOfRealPhotographs : public testing::TestWithParam<const char*> {};

TEST_P(PtmOfRealPhotographs, EqualsLeastSquaresByAHouseholderDecomposition) {
  WEFT_DATA_FILE(file, std::string("rti/") + GetParam() + "/dirs.lp");
  const auto source = valueOf(openBtf(file));
  const BtfDescription& measured = source->description();
  const Crop crop{measured.width / 3, measured.height / 2, 40, 3};
  SampleRows rows;
  ASSERT_TRUE(source->readRows(crop.y, crop.height, rows));
  // One of item 7's lights lies below the horizon; it is the last, as lights are sorted.
  std::vector<glm::vec3> lights = measured.lights;
  while (lights.back().z <= 0.0f) lights.pop_back();
  const Eigen::MatrixXd basis = basisOf(lights);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition(basis);

  FitOptions options;
  options.model.name = "ptm";
  options.space = FitSpace::Stored;
  options.precision = Precision::Float;
  options.crop = crop;
  const FitResult luminanceFit = valueOf(fitReflectanceField(*source, options));
  options.model.options["color"] = "rgb";
  const FitResult rgbFit = valueOf(fitReflectanceField(*source, options));

  std::vector<glm::vec3> stored(rows.pairs());
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x) {
      rows.stored(y, crop.x + x, stored);
      // A column for luminance, then one for each colour.
      Eigen::MatrixXd samples(basis.rows(), 4);
      for (Eigen::Index i = 0; i < basis.rows(); ++i) {
        const glm::vec3 sample = stored[static_cast<std::size_t>(i)];
        samples.row(i) << luminance(sample), sample.x, sample.y, sample.z;
      }
      const Eigen::MatrixXd expected = basis * decomposition.solve(samples);
      for (Eigen::Index i = 0; i < basis.rows(); ++i) {
        const glm::vec3 light = lights[static_cast<std::size_t>(i)];
        const auto value = [&](const FitResult& fit) {
          return fit.field.model().evaluateColor(fit.field.shared().texel(x, y),
                                                 fit.field.layers().texel(x, y), light, {0, 0, 1});
        };
        ASSERT_NEAR(luminance(value(luminanceFit)), std::max(expected(i, 0), 0.0), 1e-4)
            << x << " " << y << " " << i;
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(value(rgbFit)[c], std::max(expected(i, 1 + c), 0.0), 1e-4) << x << " " << y << " " << i;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(RealRti, PtmOfRealPhotographs, testing::Values("item7", "item9"));

}  // namespace
}  // namespace weft
