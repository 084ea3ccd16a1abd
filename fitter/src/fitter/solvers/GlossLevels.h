#pragma once

#include <functional>
#include <vector>

#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// All levels of a field whose shared numbers are a base colour, those of a GlossLobe, and others:
/// `levelsOfOthers` makes the levels of the field without the lobes.
///
/// The lobe of a coarser texel has the mean amount and the mean slope of its finest ones, and is
/// wider by how much these slopes differ, as [Toksvig 2005] widens Phong's.
std::vector<FieldLevel> glossLevels(const FieldLevel& finest,
                                    const std::function<std::vector<FieldLevel>(FieldLevel)>& levelsOfOthers);

}  // namespace weft
