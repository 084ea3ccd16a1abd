#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "weft/measurement/BtfSource.h"
#include "weft/tool/Tool.h"

namespace weft {

/// What every program that reads a measurement has: the words for it in --help, --in-order, and its
/// warnings.

constexpr const char* kMeasurementHelp =
    "a folder or zip of angle-named images, or a light list (.lp) with its images";

inline void addMeasurementOptions(CLI::App& app, BtfOptions& options) {
  app.add_flag(
      "--in-order", options.imagesInOrder,
      "give the lights of a light list its images in the order of their names, whatever it calls them");
}

inline void tellWarnings(const Tool& tool, const std::filesystem::path& input,
                         const BtfDescription& measured) {
  for (const std::string& warning : measured.warnings) tool.warn(input.string() + ": " + warning);
}

}  // namespace weft
