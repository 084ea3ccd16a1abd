#pragma once

#include <string>
#include <vector>

namespace weft {

/// How many letters must be added, removed, replaced or swapped with their neighbour to make one
/// word the other.
std::size_t editDistance(const std::string& a, const std::string& b);

/// " (did you mean WORD?)" with the word that is most like `mistyped`, or nothing where none is
/// alike.
std::string didYouMean(const std::string& mistyped, const std::vector<std::string>& words);

}  // namespace weft
