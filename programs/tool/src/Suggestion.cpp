#include "Suggestion.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace weft {
namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

std::size_t editDistance(const std::string& a, const std::string& b) {
  // Row i holds the distances from the first i letters of a to all beginnings of b.
  std::vector<std::size_t> beforeLast, last, row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    beforeLast = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row.back();
}

std::string didYouMean(const std::string& mistyped, const std::vector<std::string>& words) {
  const std::string typed = lower(mistyped);
  const std::string* best = nullptr;
  std::size_t smallest = typed.size() / 3 + 1;  // more, and another word was meant
  for (const std::string& word : words) {
    const std::size_t distance = editDistance(typed, lower(word));
    if (distance >= smallest) continue;
    smallest = distance;
    best = &word;
  }
  return best ? " (did you mean " + *best + "?)" : "";
}

}  // namespace weft
