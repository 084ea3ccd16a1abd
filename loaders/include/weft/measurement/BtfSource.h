#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "weft/core/Color.h"
#include "weft/core/Result.h"
#include "weft/measurement/SampleRows.h"

namespace weft {

/// What a measurement is, known before any pixel is read.
struct BtfDescription {
  int width = 0;
  int height = 0;
  /// unit, tangent frame (Direction.h), sorted by polar angle, then azimuth
  std::vector<glm::vec3> views;
  std::vector<glm::vec3> lights;         ///< likewise; fits leave out those on or below the horizon
  Encoding encoding = Encoding::Linear;  ///< of the stored values
  bool storedAsBytes = false;            ///< 8 bits a channel; else linear floats
  /// values contain the foreshortening n.l, as photographs do
  bool cosineInData = true;
  std::string name;  ///< for people: the file's or folder's name
  /// what is left out, or not as the source says, a sentence each
  std::vector<std::string> warnings{};

  std::size_t texels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  /// Of the samples of one row, all its pairs, in SampleRows.
  std::size_t rowBytes() const;
  /// Of all but the name.
  std::uint64_t checksum() const;
};

/// A measured or baked bidirectional texture function: how everything in Weft reads measurements.
///
/// Reading is `const`, and is parallel inside; calls may come from any thread.
class BtfSource {
 public:
  virtual ~BtfSource() = default;

  virtual const BtfDescription& description() const = 0;

  /// All pairs of some rows, row 0 at the top. Costs a pass over the whole measurement, so ask for
  /// as many rows as memory allows (rowsWithin()); decoded images take 128 MiB besides. Rows that
  /// are read one after another into the same `out` share its memory.
  virtual Result<void> readRows(int firstRow, int rowCount, SampleRows& out) const = 0;

  /// Tells measurements apart by what was measured, directions and values, and not by what they are
  /// called. Costs a pass over the measurement where a source knows nothing quicker. Fails where it
  /// cannot be read.
  virtual Result<std::uint64_t> checksum() const;

  /// How many rows fit into `bytes` when read by readRows(); at least 1.
  int rowsWithin(std::size_t bytes) const;
};

/// How a measurement is opened.
struct BtfOptions {
  /// Of a light list: the n-th image, in the order of their names, is that of the n-th light,
  /// whatever the list calls it.
  bool imagesInOrder = false;
};

/// Opens a folder or a zip of angle-named images (UBO2003's names), or a `.lp`
/// (docs/conventions.md) with its images, also as the folder or zip that holds it. Reads names and
/// the first image. Fails, naming file and reason, on missing or duplicate directions, an empty
/// folder, a broken zip or a file of another kind.
Result<std::unique_ptr<BtfSource>> openBtf(const std::filesystem::path& path, const BtfOptions& options = {});

}  // namespace weft
