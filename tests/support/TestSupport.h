#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "weft/core/Result.h"

namespace weft::test {

/// A file of the measured data that `$WEFT_DATA` names; empty where that is not set. Use
/// WEFT_DATA_FILE, which skips.
std::filesystem::path dataFile(const std::string& name);

/// The root of the source tree, and the folder in which the programs were built.
std::filesystem::path sourceFolder();
std::filesystem::path programFolder();

/// A fresh, empty folder for the files of the running test; kept, so that a failing test leaves its
/// pictures behind.
std::filesystem::path testFolder();

/// The most bytes of memory that the process has held until now.
std::uint64_t peakMemory();

/// The value of a Result, or a test failure with its message.
template <class T>
T valueOf(Result<T> result) {
  if (!result) {
    ADD_FAILURE() << result.error().message();
    throw std::runtime_error(result.error().message());
  }
  return std::move(*result);
}

/// A test failure with its message where work that has no value fails.
inline void requireDone(const Result<void>& result) {
  if (!result) {
    ADD_FAILURE() << result.error().message();
    throw std::runtime_error(result.error().message());
  }
}

}  // namespace weft::test

/// Declares the path of a measured file, or skips the test where the data are not installed.
#define WEFT_DATA_FILE(variable, name)                               \
  const std::filesystem::path variable = weft::test::dataFile(name); \
  if (variable.empty()) GTEST_SKIP() << "set WEFT_DATA to test with the measured data"
