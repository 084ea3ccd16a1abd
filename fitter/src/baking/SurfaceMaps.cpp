#include "weft/baking/SurfaceMaps.h"

#include <algorithm>
#include <cmath>

#include "weft/io/PictureFile.h"

namespace weft {
namespace {

constexpr float kDielectric = 0.04f;   // what glTF's mirrors head-on
constexpr float kLeastAlpha = 0.05f;   // sharper highlights hide between the lights
constexpr double kSteepestSeam = 4.0;  // over the mean step between pixels

std::string sizeOf(const FloatImage& image) {
  return std::to_string(image.width()) + " x " + std::to_string(image.height());
}

Result<Picture> readMap(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  std::vector<std::string> own;
  WEFT_TRY(Picture picture, readPicture(path, own));
  for (const std::string& warning : own) warnings.push_back(path.string() + ": " + warning);
  return picture;
}

/// One of the maps beside the heights, which must be as large.
Result<Picture> readMapOf(const HeightField& field, const std::filesystem::path& path,
                          std::vector<std::string>& warnings) {
  WEFT_TRY(Picture picture, readMap(path, warnings));
  if (picture.image.width() == field.columns && picture.image.height() == field.rows) return picture;
  return fail("the picture has " + sizeOf(picture.image) + " pixels, that of the heights " +
                  std::to_string(field.columns) + " x " + std::to_string(field.rows),
              path.string(), "scale one of them");
}

void warnOfColor(const FloatImage& image, const std::filesystem::path& path,
                 std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < image.values().size(); i += 3)
    if (std::abs(image.values()[i] - image.values()[i + 1]) > 0.02f)
      return warnings.push_back(path.string() + ": the map is not grey; its red is taken");
}

/// Where a surface that is laid side by side has a step.
void warnOfSeams(const HeightField& field, const std::filesystem::path& path,
                 std::vector<std::string>& warnings) {
  double within = 0.0, seam = 0.0;
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column) {
      const float here = field.at(column, row).height;
      const double across = std::abs(field.atPeriodic(column + 1, row).height - here);
      const double down = std::abs(field.atPeriodic(column, row + 1).height - here);
      (column + 1 == field.columns ? seam : within) += across / field.rows;
      (row + 1 == field.rows ? seam : within) += down / field.columns;
    }
  const double steps = field.columns + field.rows - 2;
  if (steps > 0.0 && seam / 2.0 > kSteepestSeam * within / steps)
    warnings.push_back(path.string() +
                       ": the surface is to repeat, but its borders do not continue each other");
}

Result<void> readRoughness(HeightField& field, const std::filesystem::path& path,
                           std::vector<std::string>& warnings) {
  WEFT_TRY(const Picture map, readMapOf(field, path, warnings));
  warnOfColor(map.image, path, warnings);
  bool tooSmooth = false;
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    const float roughness = map.image.values()[3 * i], alpha = roughness * roughness;
    tooSmooth = tooSmooth || alpha < kLeastAlpha;
    field.samples[i].specular = kDielectric;
    field.samples[i].roughness = std::clamp(alpha, kLeastAlpha, 1.0f);
  }
  if (tooSmooth) warnings.push_back(path.string() + ": what is smoother than 0.22 is taken for that");
  return {};
}

Result<void> readAlbedo(HeightField& field, const std::filesystem::path& path,
                        std::vector<std::string>& warnings) {
  WEFT_TRY(const Picture map, readMapOf(field, path, warnings));
  bool tooBright = false;
  for (std::size_t i = 0; i < field.samples.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float value = decode(map.encoding, map.image.values()[3 * i + static_cast<std::size_t>(c)]);
      tooBright = tooBright || !(value >= 0.0f && value <= 1.0f);
      field.samples[i].albedo[c] = std::clamp(value, 0.0f, 1.0f);
    }
  if (tooBright)
    warnings.push_back(path.string() + ": an albedo lies between 0 and 1; what does not is cut off");
  return {};
}

}  // namespace

Result<HeightField> readSurfaceMaps(const SurfaceMaps& maps, std::vector<std::string>& warnings) {
  WEFT_TRY(const Picture heights, readMap(maps.height, warnings));
  warnOfColor(heights.image, maps.height, warnings);
  HeightField field(heights.image.width(), heights.image.height(),
                    1.0f / static_cast<float>(heights.image.width()));
  for (std::size_t i = 0; i < field.samples.size(); ++i)
    field.samples[i] = {maps.depth * heights.image.values()[3 * i], glm::vec3(0.5f)};
  if (!maps.roughness.empty()) WEFT_TRY_VOID(readRoughness(field, maps.roughness, warnings));
  if (!maps.albedo.empty()) WEFT_TRY_VOID(readAlbedo(field, maps.albedo, warnings));
  // What is mirrored does not get into the surface.
  for (HeightField::Sample& sample : field.samples) sample.albedo *= 1.0f - sample.specular;
  warnOfSeams(field, maps.height, warnings);
  field.centre();
  return field;
}

}  // namespace weft
