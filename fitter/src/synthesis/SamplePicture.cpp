#include "weft/synthesis/SamplePicture.h"

#include <algorithm>

#include "weft/core/Contract.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

FloatImage emptyPicture(int width, int height) {
  return FloatImage(width, height, {"R", "G", "B"});
}

void putColor(FloatImage& picture, int x, int y, glm::vec3 color) {
  for (int c = 0; c < 3; ++c) picture.at(x, y, c) = color[c];
}

/// Of the texel itself, wherever a view sees it.
glm::vec3 registeredValue(const ReflectanceField& field, int x, int y, const DirectionWeights& layers,
                          const PictureDirections& d) {
  glm::vec3 sum(0.0f);
  for (int i = 0; i < 3; ++i) {
    if (layers.weight[i] <= 0.0f) continue;
    const int layer = layers.index[static_cast<std::size_t>(i)];
    sum += layers.weight[i] * field.formula().evaluate(field.shared().texel(x, y),
                                                       field.model().commonLayer(layer), d.light, d.view);
  }
  return sum;
}

}  // namespace

FloatImage samplePicture(const ReflectanceField& field, const PictureDirections& directions) {
  const DirectionWeights layers = field.formula().layersAround(directions.light, directions.view);
  const bool isRegistered = !field.model().registration().empty();
  FloatImage picture = emptyPicture(field.width(), field.height());
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x)
      putColor(picture, x, y,
               isRegistered ? registeredValue(field, x, y, layers, directions)
                            : field.evaluate(x, y, layers, directions.light, directions.view));
  return picture;
}

Result<std::vector<FloatImage>> samplePictures(const BtfSource& source,
                                               std::span<const PictureDirections> directions,
                                               std::size_t memory) {
  const BtfDescription& measured = source.description();
  std::vector<FloatImage> pictures(directions.size(), emptyPicture(measured.width, measured.height));
  const int atOnce = std::clamp(source.rowsWithin(memory), 1, measured.height);
  SampleRows rows;
  for (int first = 0; first < measured.height; first += atOnce) {
    const int count = std::min(atOnce, measured.height - first);
    WEFT_TRY_VOID(source.readRows(first, count, rows));
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const std::size_t pair = nearestDirection(measured.views, directions[i].view) * measured.lights.size() +
                               nearestDirection(measured.lights, directions[i].light);
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < measured.width; ++x) {
          glm::vec3 color;
          rows.linear(y, x, {&color, 1}, pair);
          putColor(pictures[i], x, first + y, color);
        }
    }
  }
  return pictures;
}

FloatImage mappedPicture(const FloatImage& sample, const CoordinateMap& map, int mostASide) {
  WEFT_EXPECT(sample.width() == map.sampleWidth() && sample.height() == map.sampleHeight(),
              "the map is of this sample");
  FloatImage picture(std::min(map.width(), mostASide), std::min(map.height(), mostASide), sample.channels());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const glm::ivec2 texel = map.at(x, y);
      std::ranges::copy(sample.texel(texel.x, texel.y), picture.texel(x, y).begin());
    }
  return picture;
}

}  // namespace weft
