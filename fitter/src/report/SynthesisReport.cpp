#include "weft/report/SynthesisReport.h"

#include <fmt/format.h>

#include <array>

#include "weft/io/ImageFile.h"
#include "weft/synthesis/SamplePicture.h"

namespace weft {
namespace {

/// Larger surfaces are shown in part.
constexpr int kLargestPicture = 1024;

FloatImage topLeft(const FloatImage& image) {
  const int width = std::min(image.width(), kLargestPicture),
            height = std::min(image.height(), kLargestPicture);
  FloatImage part(width, height, image.channels());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) std::ranges::copy(image.texel(x, y), part.texel(x, y).begin());
  return part;
}

Result<ReportPicture> pictureOf(const FloatImage& linear, std::string caption) {
  WEFT_TRY(Image image, displayImage(topLeft(linear)));
  const int width = image.width;
  return ReportPicture{.image = std::move(image), .caption = std::move(caption), .width = width};
}

}  // namespace

ReportTable synthesisTable(const AppearanceSample& sample, const std::vector<NamedMap>& maps) {
  ReportTable table{
      "Seams: how unlike the texels at jumps are, for the texels themselves and for means of 4 x 4 and 16 x "
      "16; "
      "1 is as smooth as the sample. Repetition: the highest autocorrelation beyond a quarter of the sample, "
      "what of it exceeds the sample's own, and the largest share of texels that are copies at one shift.",
      {"", "jumps", "seams", "4 x 4", "16 x 16", "repetition", "beyond the sample", "copies"},
      {}};
  for (const NamedMap& named : maps) {
    const SeamVisibility seams = seamVisibility(sample, named.map);
    const Repetition repeated = repetition(sample, named.map);
    std::vector<std::string> row{named.name};
    for (const double value : {seams.jumps, seams.mean[0], seams.mean[1], seams.mean[2], repeated.correlation,
                               repeated.beyondSample(), repeated.copied})
      row.push_back(fmt::format("{:.2f}", value));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Result<void> writeSynthesisReport(const AppearanceSample& sample, const CoordinateMap& map,
                                  const std::vector<FloatImage>& pictures,
                                  const std::vector<std::string>& captions,
                                  const std::filesystem::path& path) {
  WEFT_TRY(const CoordinateMap tiled, tiledMap(map.width(), map.height(), sample));
  HtmlReport report(fmt::format("{}: {} x {} texels of {} x {}", sample.name, map.width(), map.height(),
                                map.sampleWidth(), map.sampleHeight()));
  for (const std::string& warning : sample.warnings) report.paragraph(warning + ".");
  report.table(synthesisTable(sample, {{"tiled", tiled}, {"synthesised", map}}));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    report.heading(captions[i]);
    WEFT_TRY(ReportPicture own, pictureOf(pictures[i], "The sample."));
    WEFT_TRY(ReportPicture side, pictureOf(mappedPicture(pictures[i], tiled, kLargestPicture), "Tiled."));
    WEFT_TRY(ReportPicture result,
             pictureOf(mappedPicture(pictures[i], map, kLargestPicture), "Synthesised."));
    WEFT_TRY_VOID(report.pictures(std::array{std::move(own), std::move(side), std::move(result)}));
  }
  return report.write(path);
}

}  // namespace weft
