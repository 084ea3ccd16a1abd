#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Image.h"
#include "weft/core/Result.h"
#include "weft/report/ColorMap.h"

namespace weft {

/// A table whose first column names the rows; the others are numbers, which stand at the right.
struct ReportTable {
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< as long as the header
};

/// A picture as it is stored; small ones are shown enlarged by a whole number, texel by texel.
struct ReportPicture {
  Image image;
  std::string caption;
  std::optional<ColorScale> scale{};  ///< drawn below pictures in false colours
  int width = 280;                    ///< up to which it is enlarged, screen pixels
};

struct PlotSeries {
  enum class Style { Line, Dots };
  std::string name;
  std::vector<glm::dvec2> points;
  Style style = Style::Line;
};

struct ReportPlot {
  std::string caption;
  std::string xLabel, yLabel;
  std::vector<PlotSeries> series;
  bool logarithmicX = false;  ///< for x > 0
};

/// A report on one HTML page that needs nothing beside it: pictures are PNG data URIs, plots inline
/// SVG, without scripts. All texts are plain and are escaped.
class HtmlReport {
 public:
  explicit HtmlReport(std::string_view title);

  void heading(std::string_view text);
  void paragraph(std::string_view text);
  void table(const ReportTable& table);
  /// Pictures beside each other, in rows as the window is wide. Fails where there is no memory.
  Result<void> pictures(std::span<const ReportPicture> pictures);
  /// Points that are not finite are left out. The y axis begins at 0 where no value is negative.
  void plot(const ReportPlot& plot);

  /// The page as it is so far.
  std::string html() const;
  Result<void> write(const std::filesystem::path& path) const;

 private:
  std::string html_;
};

}  // namespace weft
