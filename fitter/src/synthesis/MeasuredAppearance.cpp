#include <glm/vec3.hpp>

#include "BorderTexels.h"
#include "TexelValues.h"

namespace weft {
namespace {

/// Stored RGB of all lights of some views.
class MeasuredAppearance : public TexelValues {
 public:
  MeasuredAppearance(const BtfSource& source, std::vector<int> views, std::size_t memory)
      : source_(source), views_(std::move(views)), memory_(memory) {}

  int width() const override { return source_.description().width; }
  int height() const override { return source_.description().height; }
  int count() const override { return static_cast<int>(3 * views_.size() * lights()); }
  int rowsAtOnce() const override { return source_.rowsWithin(memory_); }

  Result<void> load(int firstRow, int rows) override {
    if (firstRow == first_ && rows == rows_.rows()) return {};
    first_ = firstRow;
    return source_.readRows(firstRow, rows, rows_);
  }

  void read(int x, int y, std::span<float> out) const override {
    std::vector<glm::vec3> colors(lights());
    std::size_t next = 0;
    for (const int view : views_) {
      rows_.stored(y - first_, x, colors, static_cast<std::size_t>(view) * lights());
      for (const glm::vec3 color : colors)
        for (int c = 0; c < 3; ++c) out[next++] = color[c];
    }
  }

 private:
  std::size_t lights() const { return source_.description().lights.size(); }

  const BtfSource& source_;
  std::vector<int> views_;
  std::size_t memory_;
  SampleRows rows_;
  int first_ = -1;
};

}  // namespace

Result<AppearanceSample> appearanceOf(const BtfSource& source, std::size_t memory, const Progress& progress,
                                      const PolarRange& range) {
  const BtfDescription& measured = source.description();
  std::vector<int> views = viewsWithin(measured.views, range);
  if (views.empty()) return fail("no view lies in the range of polar angles", measured.name);
  MeasuredAppearance values(source, std::move(views), memory);
  WEFT_TRY(AppearanceSample sample, principalAppearance(values, progress));
  sample.name = measured.name;
  sample.repeats = repeats(sample.vectors);
  return sample;
}

}  // namespace weft
