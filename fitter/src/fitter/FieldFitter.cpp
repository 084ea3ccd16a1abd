#include "weft/fitter/FieldFitter.h"

#include <utility>

#include "weft/core/Contract.h"

namespace weft {

void FieldFitter::gather(int, TexelRun&, std::vector<double>&) const {}

Result<void> FieldFitter::endPass(int, std::span<const std::vector<double>>) {
  return {};
}

std::vector<FieldLevel> FieldFitter::levels(FieldLevel finest) const {
  std::vector<FieldLevel> levels;
  levels.push_back(std::move(finest));
  return levels;
}

std::vector<double> addedUp(std::span<const std::vector<double>> ofRows) {
  std::vector<double> sum(ofRows.empty() ? 0 : ofRows.front().size());
  for (const std::vector<double>& row : ofRows) {
    WEFT_EXPECT(row.size() == sum.size(), "rows give sums of one length");
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += row[i];
  }
  return sum;
}

}  // namespace weft
