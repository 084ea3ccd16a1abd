#include "TestImages.h"

#include <gtest/gtest.h>
#include <png.h>
#include <zip.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace weft::test {

namespace fs = std::filesystem;

Bytes bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(stream), {});
}

void writeBytes(const fs::path& file, const Bytes& bytes) {
  fs::create_directories(file.parent_path());
  fs::remove(file);  // some file systems wait for the disk when a file is rewritten in place
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Image imageOf(int width, int height, const std::function<int(int, int, int)>& value) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<std::uint8_t>(value(x, y, c));
  return image;
}

Bytes widePng(int width, int height, const std::function<int(int, int, int)>& value) {
  std::vector<std::uint16_t> words;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) words.push_back(static_cast<std::uint16_t>(value(x, y, c)));
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = PNG_FORMAT_LINEAR_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  Bytes bytes(size);
  EXPECT_NE(png_image_write_to_memory(&png, bytes.data(), &size, 0, words.data(), 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

void zipFolder(const fs::path& folder, const fs::path& zip, bool deflate) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  int code = 0;
  zip_t* archive = zip_open(zip.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  ASSERT_NE(archive, nullptr);
  for (const fs::path& file : files) {
    zip_source_t* source = zip_source_file(archive, file.c_str(), 0, -1);
    const zip_int64_t index =
        zip_file_add(archive, file.lexically_relative(folder).c_str(), source, ZIP_FL_ENC_UTF_8);
    ASSERT_GE(index, 0);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(index),
                             deflate ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0);
  }
  ASSERT_EQ(zip_close(archive), 0);
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace weft::test
