#pragma once

#include <memory>
#include <string>

#include "FileCollection.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

/// Whether any file is an image that is named by its angles (AngleName.h).
bool hasAngleImages(const FileCollection& files);

/// A BTF with a JPEG or PNG a pair of directions, named by its angles: UBO2003 and UTIA. Fails on a
/// missing or duplicate pair. `where` names the collection in failures, `name` the material.
Result<std::unique_ptr<BtfSource>> openAngleImages(std::unique_ptr<FileCollection> files, std::string where,
                                                   std::string name);

}  // namespace weft
